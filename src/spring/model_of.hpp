#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "spring/model.hpp"
#include "spring/point_force.hpp"
#include "spring/sliding.hpp"

namespace vspring {

/// A model made of rules for one node. Rules are constructed from the kind of forces:
///   static void prepare(Net&);
///   void update_direction(Net&, std::size_t node) const;  or, for several at once,
///   void update_directions(Net&, std::size_t begin, std::size_t end) const;
///   NodeForce force(const Net&, std::size_t node) const;
///   Vector3 sprung(const Net&, std::size_t node, const Vector3& d) const;  the part of d along which springs act
///   void present_laplacian_weights(const Net&, std::size_t node, std::span<double> shares) const;
template <typename Rules>
class ModelOf final : public Model {
 public:
  explicit ModelOf(Forces forces) : rules_(forces), forces_(forces) {}
  ModelOf(const Rules& rules, Forces forces) : rules_(rules), forces_(forces) {}

  void prepare(Net& net) const override { Rules::prepare(net); }

  void update_directions(Net& net, std::size_t begin, std::size_t end) const override {
    if constexpr (requires { rules_.update_directions(net, begin, end); }) {
      rules_.update_directions(net, begin, end);
    } else {
      for (std::size_t i = begin; i < end; ++i) rules_.update_direction(net, i);
    }
  }

  [[nodiscard]] std::vector<double> present_laplacian_weights(const Net& net) const override {
    std::vector<double> shares(net.rings.link_count(), 0.0);
    for (std::size_t i = 0; i < net.moving; ++i)
      rules_.present_laplacian_weights(net, i,
                                       std::span(shares).subspan(net.rings.begin(i), net.rings.links(i).size()));
    return shares;
  }

  double move(Net& net, Block block) const override {
    double greatest = 0;
    for (std::size_t i = block.begin; i < block.end; ++i) {
      const NodeForce force = force_with_points(net, i);
      // Points pull at the node's next place. So any weight is stable, small ones act as the paper's, and the iteration
      // ends in the same shape.
      const double divisor = forces_ == Forces::printed ? 1 : 1 + force.stiffness;
      const Vector3 displacement = force.spring / divisor + force.regularisation;
      displace(net, i, displacement);
      if (force.mean_edge == 0) continue;
      // std::max would ignore NaN.
      const double step = displacement.norm() / force.mean_edge;
      greatest = std::max(greatest, std::isfinite(step) ? step : std::numeric_limits<double>::infinity());
    }
    return greatest;
  }

  void find_forces(const Net& net, Block block, std::span<NodeForce> forces) const override {
    for (std::size_t i = block.begin; i < block.end; ++i) forces[i - block.begin] = force_with_points(net, i);
  }

 private:
  NodeForce force_with_points(const Net& net, std::size_t i) const {
    NodeForce force = rules_.force(net, i);
    if (!net.points.empty()) {
      const PointForce points =
          point_force(net, i, force.mean_edge, [&](const Vector3& d) { return rules_.sprung(net, i, d); });
      force.spring += points.displacement;
      force.stiffness = points.stiffness;
    }
    if (net.slides(i)) {
      force.spring = along_support(net, i, force.spring);
      force.regularisation = along_support(net, i, force.regularisation);
    }
    return force;
  }

  Rules rules_;
  Forces forces_;
};

}  // namespace vspring
