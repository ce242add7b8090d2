// Estimates the tangents and normals of a curve, for constraints "as in the input".

#include <Eigen/Geometry>
#include <algorithm>

#include "shape/direction.hpp"
#include "shape/frame.hpp"
#include "shape/planarity.hpp"
#include "vspring/constraints.hpp"

namespace vspring {

namespace {

struct Place {
  Index chain = -1;
  std::size_t index = 0;
};

/// The first place of every node in the chains.
std::vector<Place> places_of(const PolygonCurve& curve) {
  std::vector<Place> places(static_cast<std::size_t>(curve.node_count()));
  for (std::size_t c = 0; c < curve.chains().size(); ++c) {
    const auto& nodes = curve.chains()[c].nodes;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      Place& place = places[static_cast<std::size_t>(nodes[k])];
      if (place.chain < 0) place = {static_cast<Index>(c), k};
    }
  }
  return places;
}

class TangentEstimate {
 public:
  TangentEstimate(const PolygonCurve& curve, std::span<const std::uint8_t> usable)
      : curve_(curve), usable_(usable), places_(places_of(curve)) {
    Eigen::AlignedBox<double, 3> box;
    for (const Vector3& position : curve.positions()) {
      if (position.allFinite()) box.extend(position);
    }
    frame_ = Frame(box);
  }

  [[nodiscard]] Vector3 tangent(Index node) const {
    const auto forward = edges(node, 1);
    const auto backward = edges(node, -1);
    if (forward.empty() && backward.empty()) return Vector3::Zero();
    if (!forward.empty() && !backward.empty()) return along(inverted(forward[0]) - inverted(backward[0]));
    return forward.empty() ? -one_sided(backward) : one_sided(forward);
  }

  /// The tangent from one side; zero if there is nothing.
  [[nodiscard]] Vector3 tangent(Index node, NodeSide side) const {
    const bool after = side == NodeSide::after;
    const auto found = edges(node, after ? 1 : -1);
    if (found.empty()) return Vector3::Zero();
    return after ? one_sided(found) : Vector3(-one_sided(found));
  }

  /// Across the plane of the circle through the node and its neighbours; zero where they lie on a line.
  [[nodiscard]] Vector3 binormal(Index node) const {
    const auto forward = edges(node, 1);
    const auto backward = edges(node, -1);
    if (forward.empty() && backward.empty()) return Vector3::Zero();
    const bool inside = !forward.empty() && !backward.empty();
    const auto& side = forward.empty() ? backward : forward;
    if (!inside && side.size() < 2) return Vector3::Zero();
    const Vector3 a = inside ? Vector3(-backward[0]) : side[0];
    const Vector3 b = inside ? forward[0] : Vector3(side[1] - side[0]);
    return direction(a.cross(b), a.norm() * b.norm());
  }

 private:
  /// The vectors from the node to the next two on one side that are usable and lie elsewhere.
  [[nodiscard]] std::vector<Vector3> edges(Index node, int step) const {
    std::vector<Vector3> found;
    const Place place = places_[static_cast<std::size_t>(node)];
    if (place.chain < 0) return found;
    const auto& chain = curve_.chains()[static_cast<std::size_t>(place.chain)];
    const auto count = static_cast<std::ptrdiff_t>(chain.nodes.size());
    auto k = static_cast<std::ptrdiff_t>(place.index);
    const Vector3 centre = frame_.to_local(curve_.position(node));
    while (found.size() < 2) {
      k += step;
      if (chain.closed) k = (k + count) % count;
      if (k < 0 || k >= count) break;
      const Index next = chain.nodes[static_cast<std::size_t>(k)];
      if (next == node || (!usable_.empty() && usable_[static_cast<std::size_t>(next)] == 0)) break;
      const Vector3 edge = frame_.to_local(curve_.position(next)) - centre;
      if (!edge.allFinite() || edge.isZero(0)) break;
      found.push_back(edge);
    }
    return found;
  }

  /// The inversion that takes circles through the node to lines along their tangents.
  static Vector3 inverted(const Vector3& edge) { return edge / edge.dot(edge); }
  static Vector3 along(const Vector3& sum) { return sum.isZero(0) ? sum : Vector3(sum.normalized()); }

  static Vector3 one_sided(const std::vector<Vector3>& side) {
    return along(side.size() < 2 ? side[0] : Vector3(inverted(side[0]) - inverted(side[1])));
  }

  const PolygonCurve& curve_;
  std::span<const std::uint8_t> usable_;
  std::vector<Place> places_;
  Frame frame_;
};

}  // namespace

std::vector<Vector3> estimate_tangents(const PolygonCurve& curve, std::span<const Index> nodes,
                                       std::span<const std::uint8_t> usable_node) {
  const TangentEstimate estimate(curve, usable_node);
  std::vector<Vector3> tangents;
  tangents.reserve(nodes.size());
  for (const Index node : nodes) tangents.push_back(estimate.tangent(node));
  return tangents;
}

std::vector<Vector3> estimate_tangents(const PolygonCurve& curve, std::span<const Index> nodes, NodeSide side) {
  const TangentEstimate estimate(curve, {});
  std::vector<Vector3> tangents;
  tangents.reserve(nodes.size());
  for (const Index node : nodes) tangents.push_back(estimate.tangent(node, side));
  return tangents;
}

std::vector<Vector3> estimate_normals(const PolygonCurve& curve, std::span<const Index> nodes) {
  const TangentEstimate estimate(curve, {});
  const auto plane = plane_normal(curve.positions());
  std::vector<Vector3> normals;
  normals.reserve(nodes.size());
  for (const Index node : nodes) {
    const Vector3 binormal = plane ? *plane : estimate.binormal(node);
    normals.emplace_back(direction(binormal.cross(estimate.tangent(node)), 1));
  }
  return normals;
}

bool lies_in_a_plane(const PolygonCurve& curve, const Constraints& constraints) {
  std::vector<Vector3> points;
  for (Index i = 0; i < curve.node_count(); ++i) {
    const Vector3& place = constraints.position_fixed(i) ? constraints.position(i) : curve.position(i);
    if (!place.allFinite()) continue;
    points.push_back(place);
    for (const NodeSide side : node_sides) {
      if (constraints.tangent_fixed(i, side)) points.emplace_back(place + constraints.tangent(i, side));
    }
    if (constraints.normal_fixed(i)) points.emplace_back(place + constraints.normal(i));
  }
  return !points.empty() && plane_normal(points).has_value();
}

void fix_boundary_tangents(Constraints& constraints, const PolygonCurve& curve) {
  const auto boundary = boundary_nodes(curve);
  std::vector<Index> ends;
  for (Index i = 0; i < curve.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0) ends.push_back(i);
  }
  const auto tangents = estimate_tangents(curve, ends);
  for (std::size_t k = 0; k < ends.size(); ++k) {
    if (!tangents[k].isZero(0)) constraints.fix_tangent(ends[k], tangents[k]);
  }
}

void restrict_to_region(Constraints& constraints, const PolygonCurve& curve, std::span<const Index> region) {
  Constraints restricted = constraints;
  std::vector<std::uint8_t> outside(static_cast<std::size_t>(curve.node_count()), 1);
  for (const Index i : region) outside[static_cast<std::size_t>(i)] = restricted.position_fixed(i) ? 1 : 0;
  std::vector<std::uint8_t> rim(outside.size(), 0);
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      if (k + 1 == count && !chain.closed) break;
      const auto a = static_cast<std::size_t>(chain.nodes[k]);
      const auto b = static_cast<std::size_t>(chain.nodes[(k + 1) % count]);
      if (outside[a] != outside[b]) rim[outside[a] != 0 ? a : b] = 1;
    }
  }
  std::vector<Index> rim_nodes;
  for (Index i = 0; i < curve.node_count(); ++i) {
    const auto n = static_cast<std::size_t>(i);
    if (outside[n] != 0 && !restricted.position_fixed(i)) restricted.fix_position(i, curve.position(i));
    const bool has_directions = restricted.tangent_fixed(i) || restricted.normal_fixed(i) || restricted.corner(i);
    if (rim[n] != 0 && !has_directions) rim_nodes.push_back(i);
  }
  const auto tangents = estimate_tangents(curve, rim_nodes, outside);
  for (std::size_t k = 0; k < rim_nodes.size(); ++k) {
    if (!tangents[k].isZero(0)) restricted.fix_tangent(rim_nodes[k], tangents[k]);
  }
  constraints = std::move(restricted);
}

}  // namespace vspring
