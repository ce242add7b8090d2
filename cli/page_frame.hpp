#pragma once

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <span>
#include <vector>

#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Maps the box around all shapes to one of side 1. Computes with halves, so that huge coordinates do not overflow.
class Frame {
 public:
  void add(const PolygonMesh& mesh) {
    for (Index f = 0; f < mesh.face_count(); ++f) add(mesh.positions(), mesh.face(f));
  }
  void add(const PolygonCurve& curve) {
    for (const PolygonCurve::Chain& chain : curve.chains()) add(curve.positions(), chain.nodes);
  }

  [[nodiscard]] double half_side() const {
    const double side = box_.isEmpty() ? 0 : box_.sizes().maxCoeff();
    return side > 0 ? side : 1;
  }
  [[nodiscard]] double side() const { return 2 * std::min(half_side(), std::numeric_limits<double>::max() / 2); }
  [[nodiscard]] double diagonal() const { return box_.isEmpty() ? 0 : (box_.sizes() / half_side()).norm(); }

  /// Nodes of no face or chain may lie anywhere; they are not shown.
  [[nodiscard]] std::vector<Vector3> inside(const std::vector<Vector3>& positions) const {
    std::vector<Vector3> points(positions.size(), Vector3::Zero());
    if (box_.isEmpty()) return points;
    const Vector3 centre = box_.center();
    for (std::size_t n = 0; n < positions.size(); ++n) {
      if (positions[n].allFinite()) points[n] = (positions[n] / 2 - centre) / half_side();
    }
    return points;
  }

 private:
  void add(const std::vector<Vector3>& positions, std::span<const Index> nodes) {
    for (const Index node : nodes) {
      const Vector3& position = positions[static_cast<std::size_t>(node)];
      if (position.allFinite()) box_.extend(position / 2);
    }
  }

  Eigen::AlignedBox<double, 3> box_;
};

}  // namespace vspring::cli
