#pragma once

// Pseudo-normals (§4.2). All are sums over the faces around a node, computed from its link alone: within one face the
// cross products of successive edge vectors to the face's nodes add up to twice its vector area.
//
// Link: Nelson Max, "Weights for computing vertex normals from facet normals", Journal of Graphics Tools 4(2), 1999.
// With u = e/|e|² in place of e (the inversion that takes a sphere through the node to a plane) the sum around a closed
// loop of points of a sphere is exactly normal to it, whatever the loop.

#include <Eigen/Geometry>
#include <cmath>
#include <span>

#include "shape/direction.hpp"
#include "shape/fan.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Max's weights around the link.
struct LinkNormal {
  template <typename Positions>
  Vector3 operator()(const Vector3& centre, std::span<const Link> links, const Positions& positions) const {
    if (links.empty()) return Vector3::Zero();
    Vector3 sum = Vector3::Zero();
    double scale = 0;
    const auto inverted = [&](Link link) -> Vector3 {
      const Vector3 e = positions[link.node()] - centre;
      const double length2 = e.dot(e);
      if (!(length2 > 0)) return Vector3::Zero();
      const double inverse = 1 / length2;
      scale += inverse;
      return e * inverse;
    };
    const Vector3 first = inverted(links.front());
    Vector3 previous = first;
    for (std::size_t k = 1; k < links.size(); ++k) {
      const Vector3 next = inverted(links[k]);
      if (!links[k].start()) sum += previous.cross(next);
      previous = next;
    }
    if (!links.front().start()) sum += previous.cross(first);
    return direction(sum, scale);
  }
};

/// The sum of the vector areas of the adjoining faces, each weighted by Weight::of(vector area, first edge, last edge).
/// whole(first, last, area): twice the vector area of the face between these neighbours, given that of its part in the
/// link.
template <typename Weight>
struct FaceNormal {
  template <typename Positions>
  Vector3 operator()(const Vector3& centre, std::span<const Link> links, const Positions& positions) const {
    return (*this)(centre, links, positions, [](std::size_t, std::size_t, const Vector3& area) { return area; });
  }

  template <typename Positions, typename Whole>
  Vector3 operator()(const Vector3& centre, std::span<const Link> links, const Positions& positions,
                     const Whole& whole) const {
    if (links.empty()) return Vector3::Zero();
    Vector3 sum = Vector3::Zero();
    double scale = 0;
    Vector3 first_edge = positions[links.front().node()] - centre;
    const Vector3 closing_edge = first_edge;
    Vector3 previous = first_edge;
    std::size_t first = links.front().node();
    Vector3 area = Vector3::Zero();
    const auto step = [&](std::size_t node, const Vector3& edge, bool face_ends) {
      area += previous.cross(edge);
      previous = edge;
      if (!face_ends) return;
      area = whole(first, node, area);
      const double weight = Weight::of(area, first_edge, edge);
      sum += weight * area;
      scale += weight * std::sqrt(area.dot(area));
      first_edge = edge;
      first = node;
      area.setZero();
    };
    for (std::size_t k = 1; k < links.size(); ++k) {
      const Vector3 edge = positions[links[k].node()] - centre;
      if (links[k].start()) {
        first_edge = previous = edge;
        first = links[k].node();
        area.setZero();
      } else {
        // A closed chain repeats its first node without the mark of a spoke.
        const bool chain_ends = k + 1 == links.size() ? links.front().start() : links[k + 1].start();
        step(links[k].node(), edge, links[k].spoke() || chain_ends);
      }
    }
    if (!links.front().start()) step(links.front().node(), closing_edge, true);
    return direction(sum, scale);
  }
};

/// The paper's plain average of unit normals.
struct AverageWeight {
  static double of(const Vector3& area, const Vector3&, const Vector3&) {
    const double length = std::sqrt(area.dot(area));
    return length > 0 ? 1 / length : 0;
  }
};

struct AreaWeight {
  static double of(const Vector3&, const Vector3&, const Vector3&) { return 1; }
};

struct AngleWeight {
  static double of(const Vector3& area, const Vector3& first_edge, const Vector3& last_edge) {
    const double angle = std::atan2(first_edge.cross(last_edge).norm(), first_edge.dot(last_edge));
    return angle * AverageWeight::of(area, first_edge, last_edge);
  }
};

using AverageNormal = FaceNormal<AverageWeight>;
using AreaNormal = FaceNormal<AreaWeight>;
using AngleNormal = FaceNormal<AngleWeight>;

}  // namespace vspring
