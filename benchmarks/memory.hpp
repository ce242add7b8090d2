#pragma once

#include <fstream>
#include <string>

/// Memory of this process as Linux counts it; 0 on other systems.
namespace vspring::bench {

/// Of a line of /proc/self/status.
inline double status_mebibytes(const std::string& field) {
  std::ifstream status("/proc/self/status");
  std::string word;
  while (status >> word) {
    if (word != field) continue;
    double kibibytes = 0;
    status >> kibibytes;
    return kibibytes / 1024;
  }
  return 0;
}

inline double resident_mebibytes() { return status_mebibytes("VmRSS:"); }
inline double peak_memory_mebibytes() { return status_mebibytes("VmHWM:"); }

/// Peak memory is counted from here on.
inline void forget_peak_memory() { std::ofstream("/proc/self/clear_refs") << 5; }

}  // namespace vspring::bench
