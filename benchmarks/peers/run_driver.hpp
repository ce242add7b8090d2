#pragma once

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string>

#include "driver.hpp"
#include "flat_cap.hpp"

namespace vspring::bench {

struct Case {
  std::string name;
  PolygonMesh start;
  bool sphere;  ///< the shape to come is the unit sphere
};

/// A cap of 60° that starts flat, the rim and the ring beside it on the sphere already.
inline Case cap_case(Index nodes, double noise) {
  PolygonMesh exact = exact_cap(nodes);
  const std::vector<std::uint8_t> held = two_outer_rings(exact);
  PolygonMesh start = flat_cap(exact, noise);
  std::vector<Vector3> positions = start.positions();
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (held[i] != 0) positions[i] = exact.positions()[i];
  }
  start.set_positions(std::move(positions));
  return {noise > 0 ? fmt::format("cap, noise {}", noise) : "cap", std::move(start), true};
}

class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "vspring-peers-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder: " + name);
    path_ = name;
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// Runs a driver; nothing where it failed.
inline std::optional<Cost> run_driver(const std::filesystem::path& driver, const std::string& mesh,
                                      const std::string& result, int threads, const std::string& variant) {
  // CHOLMOD's own loops ask OpenMP for four threads whatever it would offer; only its limit keeps them to fewer.
  for (const char* variable : {"OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "OMP_THREAD_LIMIT", "VTK_SMP_MAX_THREADS"})
    setenv(variable, std::to_string(threads).c_str(), 1);
  // Threads of OpenMP that wait in a loop for others multiply CHOLMOD's time on a machine with other work.
  setenv("OMP_WAIT_POLICY", "passive", 1);
  const std::string command = fmt::format("'{}' '{}' '{}' {} '{}'", driver.string(), mesh, result, threads, variant);
  FILE* output = popen(command.c_str(), "r");
  if (output == nullptr) throw std::runtime_error("cannot run " + command);
  Cost cost;
  const int read = fscanf(output, "%lf %lf", &cost.seconds, &cost.mebibytes);
  const bool succeeded = pclose(output) == 0 && read == 2;
  return succeeded ? std::optional(cost) : std::nullopt;
}

}  // namespace vspring::bench
