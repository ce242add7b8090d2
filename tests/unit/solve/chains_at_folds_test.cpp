#include "solve/chains_at_folds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace vspring::chains_at_folds_test {
namespace {

constexpr int columns = 9;

Index node(int column, int row) { return row * columns + column; }

/// Two rows of squares, the sides of a roof that turns by so many degrees at its ridge.
PolygonMesh roof(double turn) {
  std::vector<Vector3> positions;
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  for (int row = 0; row < 3; ++row) {
    for (int column = 0; column < columns; ++column) {
      const double slope = std::tan(turn / 2 * std::numbers::pi / 180);
      positions.emplace_back(column, row - 1, -slope * std::abs(row - 1));
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
  for (int column = 1; column < columns; ++column) edges.emplace_back(node(column - 1, 1), node(column, 1));
  return edges;
}

TEST(ChainsAtFolds, AreThoseThatTurnByMuchMoreThanInTheMesh) {
  EXPECT_EQ(chains_at_folds(roof(40), roof(100).positions(), ridge()), ridge());
  EXPECT_TRUE(chains_at_folds(roof(40), roof(88).positions(), ridge()).empty()) << "no right angle";
  EXPECT_TRUE(chains_at_folds(roof(70), roof(100).positions(), ridge()).empty()) << "may be noise";
  EXPECT_TRUE(chains_at_folds(roof(140), roof(140).positions(), ridge()).empty());
}

TEST(ChainsAtFolds, AreThoseBesideFacesThatTurnOver) {
  const PolygonMesh mesh = roof(40);
  std::vector<Vector3> positions = mesh.positions();
  for (int column = 4; column < 6; ++column) positions[static_cast<std::size_t>(node(column, 0))] += Vector3(0, 2, 0);
  EXPECT_EQ(chains_at_folds(mesh, positions, ridge()), ridge());
  PolygonMesh folded = mesh;
  folded.set_positions(positions);
  EXPECT_TRUE(chains_at_folds(folded, positions, ridge()).empty()) << "none has moved";
}

}  // namespace
}  // namespace vspring::chains_at_folds_test
