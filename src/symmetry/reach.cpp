#include "symmetry/reach.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>

#include "vspring/error.hpp"

namespace vspring {

namespace {

// A shape that reaches less than this share as far on one side of the plane as on the other is no whole.
constexpr double share_of_whole = 0.5;

}  // namespace

std::string in_words(const MirrorPlane& plane) {
  return plane.name.empty() ? "the plane" : fmt::format("the plane {}", plane.name);
}

void Reach::measure(const std::vector<Vector3>& positions, const MirrorPlane& plane) {
  if (!(std::abs(plane.normal.norm() - 1) < 1e-9) || !plane.point.allFinite())
    throw Error(ErrorCode::invalid_argument, "a plane of symmetry needs a point, and a normal of length 1");
  distance.assign(positions.size(), 0);
  Eigen::AlignedBox<double, 3> box;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (has_edge[i] == 0) continue;
    if (!positions[i].allFinite())
      throw Error(ErrorCode::unusable_shape,
                  fmt::format("node {}: a coordinate is not finite, so it has no mirror image; correct it", i));
    box.extend(positions[i]);
    const double here = distance[i] = plane.distance(positions[i]);
    const auto node = static_cast<Index>(i);
    const std::size_t side = here >= 0 ? 0 : 1;
    if (nearest < 0 || std::abs(here) < std::abs(distance[static_cast<std::size_t>(nearest)])) nearest = node;
    if (furthest[side] < 0 || std::abs(here) > depth(side)) furthest[side] = node;
  }
  if (nearest < 0) throw Error(ErrorCode::unusable_shape, "the shape has no edge, so there is nothing to be symmetric");
  tolerance = share_on_plane * box.diagonal().norm();
}

bool Reach::is_half(const MirrorPlane& plane) const {
  const std::size_t lesser = depth(0) <= depth(1) ? 0 : 1;
  const double less = depth(lesser);
  const double more = depth(1 - lesser);
  if (!(more > tolerance))
    throw Error(ErrorCode::unusable_shape,
                fmt::format("all of the shape lies in {}: no side of it has a mirror image", in_words(plane)));
  const double gap = std::abs(distance[static_cast<std::size_t>(nearest)]);
  if (less == 0 && gap > tolerance)
    throw Error(ErrorCode::unusable_shape,
                fmt::format("{} misses the shape: node {}, the nearest, is {:.4g} away; give the plane in which a half "
                            "ends, or one through the middle of a whole",
                            in_words(plane), nearest, gap));
  if (less > share_of_whole * more) return false;
  if (less > tolerance)
    throw Error(ErrorCode::unusable_shape,
                fmt::format("node {} lies {:.4g} beyond {}, and the shape reaches {:.4g} on the other side: a half "
                            "ends in its plane, a whole reaches as far on both sides; put the node in the plane, or "
                            "give another plane",
                            furthest[lesser], less, in_words(plane), more));
  return true;
}

}  // namespace vspring
