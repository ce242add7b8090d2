#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The greatest value() of the moving nodes, 0 without any; infinite where one is not finite. value() is called on all
/// threads of the team.
template <typename Value>
double greatest_over_nodes(const Net& net, ThreadTeam& team, const Value& value) {
  const auto find = [&](std::size_t begin, std::size_t end, double& of_range) {
    bool finite = true;
    for (std::size_t i = begin; i < end; ++i) {
      const double one = value(i);
      finite = finite && std::isfinite(one);
      of_range = std::max(of_range, one);
    }
    if (!finite) of_range = std::numeric_limits<double>::infinity();
  };
  const std::vector<double> greatest = parallel_parts(team, net.moving, nodes_per_task, 0.0, find);
  return greatest.empty() ? 0 : *std::max_element(greatest.begin(), greatest.end());
}

struct EdgeTurns {
  double largest = 0;   ///< turn or stretch of an edge by a step, as a share of its length
  double shortest = 0;  ///< edge of a moving node before it; infinite without any
};

/// The largest turn or stretch of an edge by a step of the moving nodes: how far from linear the equations are over it.
/// Cost: linear.
EdgeTurns edge_turns(const Net& net, std::span<const Vector3> step, ThreadTeam& team);

/// Measures by how much edges turn in successive steps. Looks at the edges only where the steps are so long that edges
/// may turn by much.
class TurnLimit {
 public:
  /// limit: steps in which edges turn by no more are not shortened.
  TurnLimit(const Net& net, double limit, ThreadTeam& team) : net_(&net), limit_(limit), team_(&team) {}

  /// The largest turn by a step whose longest way of a node is so long, or a bound for it within the limit.
  double turn(std::span<const Vector3> step, double longest);
  /// No node has moved by more than that since.
  void moved(double longest) { shortest_ -= 2 * longest; }

 private:
  const Net* net_;
  double limit_;
  ThreadTeam* team_;
  double shortest_ = 0;  // no edge is shorter
};

}  // namespace vspring
