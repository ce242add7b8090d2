#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace vspring::bench {

/// Prints the figures of fairness of what vspring and other programs make of the same starts: caps, the annulus of
/// the paper, and for each mesh named (of triangles) regions of it.
void compare_figures(const std::filesystem::path& drivers, const std::vector<std::string>& meshes);

/// Cuts two holes into each mesh named, fills each by vspring, fair by curvature and by bending, and by CGAL, and
/// prints the figures of the patches, their distances from what was cut out, and the times as shares of vspring's.
void compare_holes(const std::filesystem::path& drivers, const std::vector<std::string>& meshes);

/// Ten regions of each mesh by vspring, fair by curvature and by bending, and CGAL: prints in how many each is next to
/// the best of the three by every figure, and the rows in which vspring is not. shapes: a folder that keeps the starts
/// and what becomes of them, as MESH-NODE-start.ply and so on, or empty.
void compare_regions(const std::filesystem::path& drivers, const std::vector<std::string>& meshes,
                     const std::filesystem::path& shapes);

}  // namespace vspring::bench
