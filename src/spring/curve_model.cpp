#include <type_traits>

#include "shape/planarity.hpp"
#include "spring/curve_force.hpp"
#include "spring/model_of.hpp"
#include "spring/shares.hpp"
#include "spring/tangent.hpp"

namespace vspring {

namespace {

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
    const Vector3& normal = net.normals[i];
    if (net.normal_given(i)) {
      // A given normal takes one direction out of those that the tangent may have.
      net.tangents[i] = direction(tangent - tangent.dot(normal) * normal, 1);
      return;
    }
    net.tangents[i] = tangent;
    if (on_circle && !net.curvatures.empty())
      net.curvatures[i] = circle_curvature(net.positions[i], links, net.positions, tangent);
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const {
    return curve_force<Weight>(net, i, [&](std::size_t j) { return curve_spring(net, i, j); });
  }

  /// Nothing for a node without a tangent.
  [[nodiscard]] Vector3 sprung(const Net& net, std::size_t i, const Vector3& d) const {
    const Vector3& tangent = net.tangents[i];
    return tangent.squaredNorm() * d - d.dot(tangent) * tangent;
  }

  /// By the lengths of the edges, which noise does not turn round as it does the edges themselves.
  void present_laplacian_weights(const Net& net, std::size_t i, std::span<double> shares) const {
    share_by_length(net, i, net.positions, shares);
  }
};

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
    return curve_force<Weight>(net, i, [&](std::size_t j) -> Vector3 {
      // A neighbour without a principal normal (an end, a node of a straight run) takes this one's, carried over; as
      // printed, ends alone, of which the paper says nothing.
      const bool is_end = j >= net.computed || net.rings.links(j).size() < 2;
      const double difference = net.normals[j].isZero(0) && (is_end || forces_ == Forces::steady)
                                    ? normal.dot(curve_spring(net, i, j))
                                    : spring_difference(net.positions[j] - net.positions[i], normal, net.normals[j]);
      return difference * normal;
    });
  }

  /// A node of a straight run, without a principal normal, may be pulled to all sides; as printed, to none.
  [[nodiscard]] Vector3 sprung(const Net& net, std::size_t i, const Vector3& d) const {
    const Vector3& normal = net.normals[i];
    if (normal.isZero(0) && forces_ == Forces::steady) return CurveRulesOf<Tangent, Weight>::sprung(net, i, d);
    return d.dot(normal) * normal;
  }

 private:
  Forces forces_;
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

/// Whether everything lies in one plane, so that normals in the plane are all there is. Given directions count as far
/// as nodes do: a straight start lies in the plane of its end tangents.
bool is_planar(const Net& net) {
  std::vector<Vector3> points = net.positions;
  for (std::size_t i = 0; i < net.node.size(); ++i) {
    if (net.tangent_given(i)) points.emplace_back(net.positions[i] + net.tangents[i]);
    if (net.normal_given(i)) points.emplace_back(net.positions[i] + net.normals[i]);
  }
  return plane_normal(points).has_value();
}

}  // namespace

std::unique_ptr<const Model> curve_model(const CurveRules& rules, Forces forces) {
  if (rules.tangents == CurveTangents::chord) return model_with<ChordTangent>(rules, forces);
  return model_with<CircleTangent>(rules, forces);
}

std::unique_ptr<const Model> curve_model_for(const Net& net, CurveRules rules, Forces forces) {
  if (forces == Forces::steady && is_planar(net)) rules.normal_plane = NormalPlane::full;
  return curve_model(rules, forces);
}

}  // namespace vspring
