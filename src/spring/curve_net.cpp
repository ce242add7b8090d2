#include "spring/curve_net.hpp"

#include <algorithm>

namespace vspring {

namespace {

// A node's displacement depends on its neighbours' tangents, and these on the next nodes.
constexpr std::size_t reach = 2;

/// The places of a chain; a closed one is unrolled from a held node on.
std::vector<Index> unrolled(const PolygonCurve::Chain& chain, const Constraints& constraints) {
  std::vector<Index> nodes = chain.nodes;
  if (chain.closed)
    std::rotate(nodes.begin(),
                std::find_if(nodes.begin(), nodes.end(), [&](Index i) { return constraints.position_fixed(i); }),
                nodes.end());
  return nodes;
}

/// Which places of a chain lie within reach of a moving node.
std::vector<std::uint8_t> within_reach(const std::vector<std::uint8_t>& moves, bool closed) {
  const std::size_t count = moves.size();
  std::vector<std::uint8_t> near(count, 0);
  for (std::size_t k = 0; k < count; ++k) {
    if (moves[k] == 0) continue;
    for (std::size_t step = 0; step <= reach; ++step) {
      if (closed || k + step < count) near[(k + step) % count] = 1;
      if (closed || k >= step) near[(k + count - step % count) % count] = 1;
    }
  }
  return near;
}

class Gathering {
 public:
  Gathering(const PolygonCurve& curve, const Constraints& constraints) : curve_(curve), constraints_(constraints) {}

  Net gather() {
    result_.is_curve = true;
    for (const auto& chain : curve_.chains()) cut(chain);
    number_moving();
    number_held();
    add_rings(result_);
    place_net(result_, curve_.positions(), constraints_);
    take_tangents();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool moves(Index node) const { return !constraints_.position_fixed(node); }

  /// Adds the runs of a chain, nodes still by their numbers in the curve.
  void cut(const PolygonCurve::Chain& chain) {
    const std::vector<Index> nodes = unrolled(chain, constraints_);
    if (nodes.size() < 2) return;
    std::vector<std::uint8_t> moving(nodes.size());
    std::transform(nodes.begin(), nodes.end(), moving.begin(), [&](Index i) { return moves(i) ? 1 : 0; });
    const auto near = within_reach(moving, chain.closed);
    if (chain.closed && std::find(near.begin(), near.end(), 0) == near.end()) {
      add_run(nodes, true);
      return;
    }
    // A closed chain begins with a held node, but not always with a gap: the part before the first gap follows the end.
    std::size_t first_gap = 0;
    if (chain.closed) first_gap = static_cast<std::size_t>(std::find(near.begin(), near.end(), 0) - near.begin());
    std::vector<Index> run;
    for (std::size_t step = 0; step < nodes.size(); ++step) {
      const std::size_t k = (first_gap + step) % nodes.size();
      if (near[k] != 0) {
        run.push_back(nodes[k]);
      } else if (!run.empty()) {
        add_run(run, false);
        run.clear();
      }
    }
    if (!run.empty()) add_run(run, false);
  }

  void add_run(const std::vector<Index>& nodes, bool closed) {
    nodes_.push_back(nodes);
    result_.moving_runs.push_back({.nodes = std::vector<std::uint32_t>(nodes.size(), 0), .closed = closed});
  }

  void number(std::size_t moving_run, std::size_t place) {
    result_.moving_runs[moving_run].nodes[place] = static_cast<std::uint32_t>(result_.node.size());
    result_.node.push_back(nodes_[moving_run][place]);
  }

  void for_each_place(const auto& use) {
    for (std::size_t s = 0; s < nodes_.size(); ++s) {
      for (std::size_t k = 0; k < nodes_[s].size(); ++k) use(s, k);
    }
  }

  void number_moving() {
    for_each_place([&](std::size_t s, std::size_t k) {
      if (moves(nodes_[s][k])) number(s, k);
    });
    result_.moving = result_.node.size();
  }

  /// Held neighbours of moving nodes, whose tangents count, before all others.
  void number_held() {
    const auto beside_moving = [&](std::size_t s, std::size_t k) {
      const auto& nodes = nodes_[s];
      const bool closed = result_.moving_runs[s].closed;
      const bool before = (k > 0 || closed) && moves(nodes[(k + nodes.size() - 1) % nodes.size()]);
      const bool after = (k + 1 < nodes.size() || closed) && moves(nodes[(k + 1) % nodes.size()]);
      return before || after;
    };
    for (const bool wanted : {true, false}) {
      for_each_place([&](std::size_t s, std::size_t k) {
        if (!moves(nodes_[s][k]) && beside_moving(s, k) == wanted) number(s, k);
      });
      if (wanted) result_.computed = result_.node.size();
    }
  }

  /// At a corner, where chains end and begin again, the tangent of that side.
  void take_tangents() {
    Net& net = result_;
    net.tangents.assign(net.node.size(), Vector3::Zero());
    for_each_place([&](std::size_t s, std::size_t k) {
      const Index node = nodes_[s][k];
      const NodeSide side = k > 0 ? NodeSide::before : NodeSide::after;
      const bool inside = net.moving_runs[s].closed || (k > 0 && k + 1 < nodes_[s].size());
      if (inside ? !constraints_.tangent_fixed(node) : !constraints_.tangent_fixed(node, side)) return;
      const std::uint32_t i = net.moving_runs[s].nodes[k];
      net.tangents[i] = constraints_.tangent(node, side);
      net.given[i] |= Net::given_tangent;
    });
  }

  const PolygonCurve& curve_;
  const Constraints& constraints_;
  Net result_;
  std::vector<std::vector<Index>> nodes_;  // per run, by their numbers in the curve
};

}  // namespace

void add_rings(Net& net) {
  std::vector<std::vector<Link>> links(net.computed);
  for (const MovingRun& moving_run : net.moving_runs) {
    const auto& nodes = moving_run.nodes;
    const std::size_t count = nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      if (nodes[k] >= net.computed) continue;
      auto& ring = links[nodes[k]];
      if (k > 0 || moving_run.closed)
        ring.push_back({nodes[(k + count - 1) % count] | Link::spoke_bit | Link::start_bit});
      if (k + 1 < count || moving_run.closed) ring.push_back({nodes[(k + 1) % count] | Link::spoke_bit});
    }
  }
  net.rings.reserve(net.computed, 2 * net.computed);
  for (const auto& ring : links) net.rings.add(ring);
}

Net gather_net(const PolygonCurve& curve, const Constraints& constraints) {
  return Gathering(curve, constraints).gather();
}

}  // namespace vspring
