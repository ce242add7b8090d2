#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vspring::bench {

/// Prints the figures of fairness of what vspring and other programs make of the same starts: caps, the annulus of
/// the paper, and for each mesh named (of triangles) regions of it.
void compare_figures(const std::filesystem::path& drivers, const std::vector<std::string>& meshes);

}  // namespace vspring::bench
