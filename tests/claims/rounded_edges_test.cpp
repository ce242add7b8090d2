// Edges that are said to be sharp, but along which a surface would fold once its noise is off.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "support/curves.hpp"
#include "vspring/vspring.hpp"

namespace vspring::rounded_edges_test {
namespace {

using namespace support;

constexpr int columns = 15;
constexpr int rows = 12;
constexpr int ridge_column = 9;

Index node(int column, int row) { return row * columns + column; }

/// A roof of quads with sides at 40° to the ground and noise of 0.4 edges.
PolygonMesh noisy_roof() {
  Draw draw(1);
  const auto noise = [&] { return 0.4 * std::sqrt(3.0) * draw.uniform(-1, 1); };
  std::vector<Vector3> positions;
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  for (int row = 0; row < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double off = column - ridge_column;
      positions.emplace_back(column + noise(), row + noise(), -0.84 * std::abs(off) + noise());
      if (column == 0 || row == 0) continue;
      corners.insert(corners.end(),
                     {node(column - 1, row - 1), node(column, row - 1), node(column, row), node(column - 1, row)});
      begin.push_back(static_cast<Index>(corners.size()));
    }
  }
  return {positions, begin, corners};
}

MeshEdges ridge() {
  MeshEdges edges;
  for (int row = 1; row < rows; ++row) edges.emplace_back(node(ridge_column, row - 1), node(ridge_column, row));
  return edges;
}

/// Steps in the middle of a side, where nothing is sharp.
MeshEdges steps() {
  MeshEdges edges;
  for (int k = 2; k < 6; ++k) {
    edges.emplace_back(node(k, k), node(k + 1, k));
    edges.emplace_back(node(k + 1, k), node(k + 1, k + 1));
  }
  return edges;
}

/// Edges between two faces, other than the given ones, that turn by more than a right angle.
std::size_t folds(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const MeshEdges& sharp) {
  PolygonMesh moved = mesh;
  moved.set_positions(positions);
  const MeshEdges turned = find_sharp_edges(moved, 90).edges;
  return static_cast<std::size_t>(std::count_if(turned.begin(), turned.end(), [&](const auto& edge) {
    return std::find(sharp.begin(), sharp.end(), edge) == sharp.end();
  }));
}

FitResult without_noise(const PolygonMesh& mesh, const MeshEdges& sharp) {
  FitOptions options{.criterion = Noise{0.4}};
  options.fair.distribution = Distribution::keep;
  options.fair.sharp_edges = sharp;
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  return fit(mesh, constraints, {.positions = mesh.positions()}, options);
}

TEST(RoundedEdges, AreThoseAtFoldsAndOthersStaySharp) {
  const PolygonMesh mesh = noisy_roof();
  MeshEdges all = ridge();
  const MeshEdges more = steps();
  all.insert(all.end(), more.begin(), more.end());
  const FitResult found = without_noise(mesh, all);
  const FairReport& report = found.report.fair;
  EXPECT_TRUE(report.usable());
  EXPECT_EQ(report.rounded_edges, more);
  EXPECT_EQ(report.sharp_edges, static_cast<Index>(ridge().size()));
  EXPECT_EQ(folds(mesh, found.positions, ridge()), 0U);
  EXPECT_TRUE(std::any_of(report.warnings.begin(), report.warnings.end(), [](const Warning& warning) {
    return warning.code == WarningCode::sharp_edges_rounded && warning.text.starts_with("8 of 19 sharp edges");
  }));
  // As if only the others had been given, of which none is rounded.
  const FitResult only = without_noise(mesh, ridge());
  EXPECT_EQ(found.positions, only.positions);
  EXPECT_TRUE(only.report.fair.rounded_edges.empty());
}

}  // namespace
}  // namespace vspring::rounded_edges_test
