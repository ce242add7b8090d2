// Fairs a surface that lies in plain arrays, as other libraries have them, and takes the result as one.
// build/examples/09_arrays OUT
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <span>
#include <string>
#include <vector>
#include <vspring/vspring.hpp>

// The largest height of a node.
double height(std::span<const double> xyz) {
  double most = 0;
  for (std::size_t k = 2; k < xyz.size(); k += 3) most = std::max(most, std::abs(xyz[k]));
  return most;
}

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  // Somebody else's arrays: x, y, z of each node in turn, and the three nodes of each triangle. The sheet is rough
  // inside its flat boundary.
  const int cells = 20;
  std::vector<double> xyz;
  std::vector<std::int32_t> triangles;
  for (int row = 0; row <= cells; ++row) {
    for (int column = 0; column <= cells; ++column) {
      const bool inside = row % cells != 0 && column % cells != 0;
      const int node = row * (cells + 1) + column;
      xyz.insert(xyz.end(), {column * 0.05, row * 0.05, inside ? 0.02 * std::sin(7.0 * node) : 0.0});
      if (row == cells || column == cells) continue;
      const int above = node + cells + 1;
      triangles.insert(triangles.end(), {node, node + 1, above + 1, node, above + 1, above});
    }
  }

  // For a pointer and a count: std::span(pointer, count).
  vspring::PolygonMesh mesh = vspring::PolygonMesh::from_arrays(xyz, triangles);
  vspring::Constraints constraints(mesh.node_count());
  vspring::fix_boundary_positions(constraints, mesh);
  const auto [positions, report] = vspring::fair(mesh, constraints);
  const std::span<const double> fair_xyz = vspring::coordinates(positions);  // a view, without a copy
  std::printf("%s: heights of up to %.4f, before %.4f\n", name(report.outcome), height(fair_xyz), height(xyz));

  mesh.set_positions(fair_xyz);
  vspring::write_surface(out + "/09_arrays.obj", mesh);
  return report.usable() ? 0 : 1;
}
