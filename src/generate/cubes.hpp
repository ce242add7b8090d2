#pragma once

#include <array>
#include <functional>
#include <unordered_map>
#include <utility>

#include "vspring/generate.hpp"

namespace vspring::generate {

/// A point of an integer lattice.
using LatticePoint = std::array<int, 3>;

/// Nodes at points of a lattice, one for each point.
class LatticeNodes {
 public:
  using Place = std::function<Vector3(const LatticePoint&)>;

  LatticeNodes(MeshBuilder& builder, Place place) : builder_(&builder), place_(std::move(place)) {}

  Index at(const LatticePoint& point);

 private:
  MeshBuilder* builder_;
  Place place_;
  std::unordered_map<std::uint64_t, Index> numbers_;
};

/// One side of a cube of cells × cells × cells lattice steps.
class CubeSide {
 public:
  /// corner: the point of the cube with the least coordinates.
  CubeSide(Side side, const LatticePoint& corner, int cells);

  /// The directions of columns, rows and of the outward normal: a right-handed frame.
  [[nodiscard]] Vector3 column_direction() const { return Vector3::Unit(column_axis_); }
  [[nodiscard]] Vector3 row_direction() const { return Vector3::Unit(row_axis_); }
  [[nodiscard]] Vector3 outward() const { return positive_ ? Vector3::Unit(axis_) : Vector3(-Vector3::Unit(axis_)); }

  /// The lattice point at the lower left corner of a cell seen from outside.
  [[nodiscard]] LatticePoint point(int column, int row) const;

  /// Point k of the 4 × cells around the side, counter-clockwise seen from outside, from the point (0, 0) on.
  [[nodiscard]] LatticePoint around(int k) const;

 private:
  int axis_;
  int column_axis_;
  int row_axis_;
  bool positive_;
  LatticePoint origin_;
  int cells_;
};

}  // namespace vspring::generate
