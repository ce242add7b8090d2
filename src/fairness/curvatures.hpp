#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fairness/neighbourhood.hpp"
#include "shape/fan.hpp"
#include "vspring/curvature.hpp"

namespace vspring {

/// Positions times a power of two that makes their size about 1. They are not moved to an origin, as their last digits
/// would depend on it; only differences are used.
class ScaledPositions {
 public:
  /// The positions must outlive it.
  ScaledPositions(std::span<const Vector3> positions, double scale) : positions_(positions), scale_(scale) {}
  [[nodiscard]] Vector3 operator[](std::size_t node) const { return positions_[node] * scale_; }

 private:
  std::span<const Vector3> positions_;
  double scale_;
};

/// Curvatures at nodes, one by one, of a mesh with any positions. Holds buffers, so use one per task.
class CurvatureFitter {
 public:
  explicit CurvatureFitter(const FaceNeighbours& neighbours);
  ~CurvatureFitter();
  CurvatureFitter(const CurvatureFitter&) = delete;
  CurvatureFitter& operator=(const CurvatureFitter&) = delete;

  /// Finds the nodes around a node, which do not depend on positions. links: of the walk around it; they must last
  /// until the next call.
  void go_to(Index node, std::span<const Link> links);
  /// The curvature there, of the mesh with these positions, in their units. The bits do not depend on the scale, except
  /// for its factor.
  NodeCurvature at(const ScaledPositions& positions);

 private:
  class Points;

  Neighbourhood neighbourhood_;
  Index node_ = 0;
  std::span<const Link> links_;
  std::unique_ptr<Points> points_;
};

/// The curvatures of a mesh that is `scale` times as large.
NodeCurvature scaled(NodeCurvature at, double scale);

}  // namespace vspring
