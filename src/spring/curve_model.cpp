#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "shape/planarity.hpp"
#include "spring/curve_force.hpp"
#include "spring/model_of.hpp"
#include "spring/shares.hpp"
#include "spring/tangent.hpp"

namespace vspring {

namespace {

/// Removes the component along a given normal from a tangent.
Vector3 across_normal(const Vector3& tangent, const Vector3& normal) {
  return direction(tangent - tangent.dot(normal) * normal, 1);
}

/// Tangents, and V-Spring in the whole normal plane.
template <typename Tangent, typename Weight>
struct CurveRulesOf {
  explicit CurveRulesOf(Forces /*forces*/) {}

  static constexpr bool on_circle = std::is_same_v<Tangent, CircleTangent>;

  static void prepare(Net& net) {
    if (on_circle) net.curvatures.resize(net.positions.size(), Vector3::Zero());
  }

  void update_direction(Net& net, std::size_t i) const {
    if (net.tangent_given(i)) return;
    const auto links = net.rings.links(i);
    const Vector3 tangent = Tangent()(net.positions[i], links, net.positions);
    if (net.normal_given(i)) {
      net.tangents[i] = across_normal(tangent, net.normals[i]);
      return;
    }
    net.tangents[i] = tangent;
    if (on_circle && !net.curvatures.empty())
      net.curvatures[i] = circle_curvature(net.positions[i], links, net.positions, tangent);
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const {
    return curve_force<Weight>(net, i, [&](std::size_t j) { return curve_spring(net, i, j); });
  }

  /// Zero for a node without a tangent.
  [[nodiscard]] Vector3 sprung(const Net& net, std::size_t i, const Vector3& d) const {
    const Vector3& tangent = net.tangents[i];
    return tangent.squaredNorm() * d - d.dot(tangent) * tangent;
  }

  /// By the lengths of edges: noise may reverse the edges themselves.
  void present_laplacian_weights(const Net& net, std::size_t i, std::span<double> shares) const {
    share_by_length(net, i, net.positions, shares);
  }
};

/// curve_force() with the regularisation as printed (§4.4): the vector to the mean of the neighbours, without its part
/// along N_i.
template <typename Weight, typename Spring>
NodeForce printed_force(const Net& net, std::size_t i, const Spring& spring) {
  NodeForce force = curve_force<Weight>(net, i, spring);
  if (!net.target_positions.empty() || !net.weights_of(i).empty()) return force;
  const Vector3 way = mean_of_neighbours(net, i) - net.positions[i];
  const Vector3& normal = net.normals[i];
  force.regularisation = way - way.dot(normal) * normal;
  return force;
}

/// The paper's own variant for space curves: V-Spring along the principal normal only (§4.8).
template <typename Tangent, typename Weight>
struct PrincipalRulesOf : CurveRulesOf<Tangent, Weight> {
  explicit PrincipalRulesOf(Forces forces) : CurveRulesOf<Tangent, Weight>(forces), forces_(forces) {}

  void update_direction(Net& net, std::size_t i) const {
    CurveRulesOf<Tangent, Weight>::update_direction(net, i);
    if (!net.normal_given(i))
      net.normals[i] = principal_normal(net.positions[i], net.rings.links(i), net.positions, net.tangents[i]);
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const {
    const Vector3& normal = net.normals[i];
    const auto spring = [&](std::size_t j) -> Vector3 {
      // A neighbour without a principal normal (an end, a node of a straight run) takes this node's, carried over. With
      // printed forces only ends do so, of which the paper says nothing.
      const bool is_end = j >= net.computed || net.rings.links(j).size() < 2;
      const double difference = net.normals[j].isZero(0) && (is_end || forces_ == Forces::steady)
                                    ? normal.dot(curve_spring(net, i, j))
                                    : spring_difference(net.positions[j] - net.positions[i], normal, net.normals[j]);
      return difference * normal;
    };
    return forces_ == Forces::printed ? printed_force<Weight>(net, i, spring) : curve_force<Weight>(net, i, spring);
  }

  /// A node of a straight run has no principal normal: it is pulled in all directions across; with printed forces in
  /// none.
  [[nodiscard]] Vector3 sprung(const Net& net, std::size_t i, const Vector3& d) const {
    const Vector3& normal = net.normals[i];
    if (normal.isZero(0) && forces_ == Forces::steady) return CurveRulesOf<Tangent, Weight>::sprung(net, i, d);
    return d.dot(normal) * normal;
  }

 private:
  Forces forces_;
};

/// Planar curves with printed forces: the normal of a node is the mean of the in-plane normals of its two segments
/// (§4.2); that of an end is the normal of its one segment.
template <typename Weight>
class PlanarRulesOf {
 public:
  explicit PlanarRulesOf(const Vector3& plane) : plane_(plane) {}

  static void prepare(Net& /*net*/) {}

  void update_direction(Net& net, std::size_t i) const {
    if (net.tangent_given(i)) {
      if (!net.normal_given(i)) net.normals[i] = direction(plane_.cross(net.tangents[i]), 1);
      return;
    }
    if (net.normal_given(i)) {
      const Vector3 chord = ChordTangent()(net.positions[i], net.rings.links(i), net.positions);
      net.tangents[i] = across_normal(chord, net.normals[i]);
      return;
    }
    net.normals[i] = mean_normal(net, i);
    net.tangents[i] = direction(net.normals[i].cross(plane_), 1);
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const {
    const Vector3& normal = net.normals[i];
    return printed_force<Weight>(net, i, [&](std::size_t j) -> Vector3 {
      return spring_difference(net.positions[j] - net.positions[i], normal, net.normals[j]) * normal;
    });
  }

  [[nodiscard]] Vector3 sprung(const Net& net, std::size_t i, const Vector3& d) const {
    return d.dot(net.normals[i]) * net.normals[i];
  }

  void present_laplacian_weights(const Net& net, std::size_t i, std::span<double> shares) const {
    share_by_length(net, i, net.positions, shares);
  }

 private:
  [[nodiscard]] Vector3 mean_normal(const Net& net, std::size_t i) const {
    const auto links = net.rings.links(i);
    if (links.empty()) return Vector3::Zero();
    const CurveEdges edges(net.positions[i], links, net.positions);
    Vector3 sum = Vector3::Zero();
    for (const Vector3* edge : {&edges.before, &edges.after}) sum += direction(plane_.cross(*edge), edge->norm());
    return direction(sum, 2);
  }

  Vector3 plane_;  ///< its normal
};

template <typename Tangent, typename Weight>
std::unique_ptr<const Model> model_along(NormalPlane plane, Forces forces) {
  if (plane == NormalPlane::principal) return std::make_unique<ModelOf<PrincipalRulesOf<Tangent, Weight>>>(forces);
  return std::make_unique<ModelOf<CurveRulesOf<Tangent, Weight>>>(forces);
}

template <typename Tangent>
std::unique_ptr<const Model> model_with(const CurveRules& rules, Forces forces) {
  if (rules.weights == CurveWeights::inverse) return model_along<Tangent, InverseWeight>(rules.normal_plane, forces);
  return model_along<Tangent, InverseCubeWeight>(rules.normal_plane, forces);
}

/// The normal of the plane in which everything lies, if there is one; then all normals lie in it. Given directions
/// count as nodes do: a straight start lies in the plane of its end tangents.
std::optional<Vector3> plane_of(const Net& net) {
  std::vector<Vector3> places = net.positions;
  for (std::size_t i = 0; i < net.node.size(); ++i) {
    if (net.tangent_given(i)) places.emplace_back(net.positions[i] + net.tangents[i]);
    if (net.normal_given(i)) places.emplace_back(net.positions[i] + net.normals[i]);
  }
  return plane_normal(places);
}

/// The normal of the plane of a straight line of nodes and the points beside it.
std::optional<Vector3> plane_of(const Net& net, std::span<const Vector3> points) {
  std::vector<Vector3> places = net.positions;
  for (const Vector3& point : points) places.push_back(net.frame.to_local(point));
  return plane_normal(places);
}

std::unique_ptr<const Model> printed_model_in(const Vector3& plane, CurveWeights weights) {
  if (weights == CurveWeights::inverse)
    return std::make_unique<ModelOf<PlanarRulesOf<InverseWeight>>>(PlanarRulesOf<InverseWeight>(plane),
                                                                   Forces::printed);
  return std::make_unique<ModelOf<PlanarRulesOf<InverseCubeWeight>>>(PlanarRulesOf<InverseCubeWeight>(plane),
                                                                     Forces::printed);
}

}  // namespace

std::unique_ptr<const Model> curve_model(const CurveRules& rules, Forces forces) {
  if (rules.tangents == CurveTangents::chord) return model_with<ChordTangent>(rules, forces);
  return model_with<CircleTangent>(rules, forces);
}

std::unique_ptr<const Model> curve_model_for(const Net& net, CurveRules rules, Forces forces,
                                             std::span<const Vector3> points) {
  std::optional<Vector3> plane = plane_of(net);
  if (forces == Forces::steady) {
    if (plane) rules.normal_plane = NormalPlane::full;
    return curve_model(rules, forces);
  }
  if (!plane) plane = plane_of(net, points);
  if (plane && rules.normal_plane == NormalPlane::principal && rules.tangents == CurveTangents::chord)
    return printed_model_in(*plane, rules.weights);
  return curve_model(rules, forces);
}

}  // namespace vspring
