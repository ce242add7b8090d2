#include "spring/curve_force.hpp"
#include "spring/model_of.hpp"
#include "spring/tangent.hpp"

namespace vspring {

namespace {

/// Tangents, and V-Spring in the whole normal plane.
template <typename Tangent, typename Weight>
struct CurveRulesOf {
  void update_direction(Net& net, std::size_t i) const {
    if (net.tangent_given(i)) return;
    const Vector3 tangent = Tangent()(net.positions[i], net.rings.links(i), net.positions);
    const Vector3& normal = net.normals[i];
    // A given normal takes one direction out of those that the tangent may have.
    net.tangents[i] = net.normal_given(i) ? direction(tangent - tangent.dot(normal) * normal, 1) : tangent;
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const {
    const Vector3& tangent = net.tangents[i];
    return curve_force<Weight>(
        i, net.rings.links(i), net.positions, tangent, net.shares_of(i), net.tiny,
        [&](std::size_t j, const Vector3& d) { return curve_spring(d, tangent, net.tangents[j]); });
  }

  /// By the lengths of the edges, which noise does not turn round as it does the edges themselves.
  void present_shares(const Net& net, std::size_t i, std::span<double> shares) const {
    const auto links = net.rings.links(i);
    double whole = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      const Vector3 d = net.positions[links[k].node()] - net.positions[i];
      shares[k] = std::sqrt(d.dot(d) + net.tiny);
      whole += shares[k];
    }
    for (double& share : shares) share = links.size() > 1 ? 1 - share / whole : 1;
  }
};

/// The paper's own variant for space curves: V-Spring along the principal normal only (§4.8).
template <typename Tangent, typename Weight>
struct PrincipalRulesOf : CurveRulesOf<Tangent, Weight> {
  void update_direction(Net& net, std::size_t i) const {
    CurveRulesOf<Tangent, Weight>::update_direction(net, i);
    if (!net.normal_given(i))
      net.normals[i] = principal_normal(net.positions[i], net.rings.links(i), net.positions, net.tangents[i]);
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const {
    const Vector3& tangent = net.tangents[i];
    const Vector3& normal = net.normals[i];
    const auto spring = [&](std::size_t j, const Vector3& d) -> Vector3 {
      // A neighbour without a principal normal (an end, a node of a straight run) takes this one's, carried over.
      const double difference = net.normals[j].isZero(0) ? normal.dot(curve_spring(d, tangent, net.tangents[j]))
                                                         : spring_difference(d, normal, net.normals[j]);
      return difference * normal;
    };
    return curve_force<Weight>(i, net.rings.links(i), net.positions, tangent, net.shares_of(i), net.tiny, spring);
  }
};

template <typename Tangent, typename Weight>
std::unique_ptr<const Model> model_along(NormalPlane plane) {
  if (plane == NormalPlane::principal) return std::make_unique<ModelOf<PrincipalRulesOf<Tangent, Weight>>>();
  return std::make_unique<ModelOf<CurveRulesOf<Tangent, Weight>>>();
}

template <typename Tangent>
std::unique_ptr<const Model> model_with(const CurveRules& rules) {
  return rules.weights == CurveWeights::inverse ? model_along<Tangent, InverseWeight>(rules.normal_plane)
                                                : model_along<Tangent, InverseCubeWeight>(rules.normal_plane);
}

}  // namespace

std::unique_ptr<const Model> curve_model(const CurveRules& rules) {
  return rules.tangents == CurveTangents::chord ? model_with<ChordTangent>(rules) : model_with<CircleTangent>(rules);
}

}  // namespace vspring
