#include "vspring/version.hpp"

#if defined(__unix__) || defined(__APPLE__)
#include <sys/resource.h>
#endif

namespace vspring {

const char* version() noexcept { return VSPRING_VERSION; }

long long peak_memory_bytes() noexcept {
#if defined(__unix__) || defined(__APPLE__)
  rusage usage{};
  if (getrusage(RUSAGE_SELF, &usage) != 0) return 0;
#if defined(__APPLE__)
  return usage.ru_maxrss;
#else
  return usage.ru_maxrss * 1024LL;
#endif
#else
  return 0;
#endif
}

}  // namespace vspring
