#pragma once

#include <memory>
#include <span>
#include <vector>

#include "fairness/neighbourhood.hpp"
#include "shape/fan.hpp"
#include "vspring/curvature.hpp"

namespace vspring {

/// Positions times a power of two that makes their size about 1. Only differences of them matter: were they moved to
/// the origin, their last digits would depend on where it is.
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

  /// Looks around a node: what is the same wherever the nodes are. links: of the walk around it, which must last as
  /// long as it is looked at.
  void go_to(Index node, std::span<const Link> links);
  /// There, of the mesh with these positions, in their units. The bits do not depend, but for its factor, on the scale.
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
