#include "shape/node_graph.hpp"

#include <cstdint>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

enum class State : std::uint8_t { outside, waiting, probed, ordered };

/// Appends the component of `first` to `order`, breadth first, changing `from` to `to`.
void append_component(const NodeGraph& graph, Index first, State from, State to, std::vector<State>& state,
                      std::vector<Index>& order) {
  std::size_t next = order.size();
  order.push_back(first);
  state[static_cast<std::size_t>(first)] = to;
  for (; next < order.size(); ++next) {
    end_if_cancelled_at(next);
    graph.for_each_neighbour(order[next], [&](Index j) {
      State& reached = state[static_cast<std::size_t>(j)];
      if (reached != from) return;
      reached = to;
      order.push_back(j);
    });
  }
}

}  // namespace

std::vector<Index> order_for_locality(const NodeGraph& graph, std::span<const Index> nodes) {
  std::vector<State> state(static_cast<std::size_t>(graph.size()), State::outside);
  for (const Index i : nodes) state[static_cast<std::size_t>(i)] = State::waiting;
  std::vector<Index> order;
  order.reserve(nodes.size());
  for (const Index i : nodes) {
    if (state[static_cast<std::size_t>(i)] != State::waiting) continue;
    // The node that a first search reaches last lies at the rim; fronts from there are short.
    const std::size_t begin = order.size();
    append_component(graph, i, State::waiting, State::probed, state, order);
    const Index rim = order.back();
    order.resize(begin);
    append_component(graph, rim, State::probed, State::ordered, state, order);
  }
  return order;
}

}  // namespace vspring
