#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <string>
#include <vector>

#include "run_driver.hpp"

namespace vspring::bench {

/// Settings of VTK's windowed sinc filter, of which the best counts: iterations and pass band.
inline std::vector<std::string> sinc_variants() {
  std::vector<std::string> variants;
  for (const int count : {10, 20, 50, 200}) {
    for (const double pass_band : {0.001, 0.003, 0.01, 0.03, 0.05, 0.07, 0.1, 0.15, 0.2, 0.3, 0.4, 0.5, 0.8, 1.2})
      variants.push_back(fmt::format("{}, {}", count, pass_band));
  }
  return variants;
}

/// use(variant, positions, cost) for each variant of a driver that succeeds.
template <typename Use>
void for_each_variant(const std::filesystem::path& driver, const PolygonMesh& mesh,
                      const std::vector<std::string>& variants, const Use& use) {
  const TemporaryFolder folder;
  const std::string start = folder.file("start.ply");
  const std::string result = folder.file("result.ply");
  write_surface(start, mesh);
  for (const std::string& variant : variants) {
    const auto cost = run_driver(driver, start, result, 1, variant);
    if (cost) use(variant, read_surface(result).mesh.positions(), *cost);
  }
}

/// run(name, mesh) for each surface of a folder, by name. One that is refused gets a row of the table that says why.
template <typename Run>
void for_each_surface(const std::filesystem::path& folder, const Run& run) {
  std::vector<std::filesystem::path> paths;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (surface_format(entry.path().extension().string())) paths.push_back(entry.path());
  }
  std::sort(paths.begin(), paths.end());
  for (const std::filesystem::path& path : paths) {
    try {
      run(path.filename().string(), read_surface(path.string()).mesh);
    } catch (const std::exception& error) {
      fmt::print("| {} | refused: {} |\n", path.filename().string(), error.what());
    }
  }
}

}  // namespace vspring::bench
