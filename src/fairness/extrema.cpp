#include "fairness/extrema.hpp"

#include <algorithm>
#include <numeric>
#include <vector>

namespace vspring {

namespace {

/// The nodes seen so far, in groups that hang together; each is known by its highest node.
class PersistenceMerge {
 public:
  explicit PersistenceMerge(std::size_t nodes) : parent_(nodes, -1) {}

  [[nodiscard]] bool seen(Index node) const { return parent_[at(node)] >= 0; }
  void raise(Index node) { parent_[at(node)] = node; }
  void join(Index lower_summit, Index summit) { parent_[at(lower_summit)] = summit; }

  [[nodiscard]] Index summit(Index node) {
    while (parent_[at(node)] != node) {
      parent_[at(node)] = parent_[at(parent_[at(node)])];
      node = parent_[at(node)];
    }
    return node;
  }

 private:
  static std::size_t at(Index node) { return static_cast<std::size_t>(node); }
  std::vector<Index> parent_;
};

}  // namespace

Index count_maxima(const NodeGraph& graph, std::span<const double> values, std::span<const std::uint8_t> used,
                   std::span<const std::uint8_t> inside, double threshold) {
  const auto value = [&](Index node) { return values[static_cast<std::size_t>(node)]; };
  const auto higher = [&](Index a, Index b) { return value(a) != value(b) ? value(a) > value(b) : a < b; };
  std::vector<Index> order;
  order.reserve(values.size());
  for (Index i = 0; i < graph.size(); ++i) {
    if (used[static_cast<std::size_t>(i)] != 0) order.push_back(i);
  }
  std::sort(order.begin(), order.end(), higher);

  PersistenceMerge hills(values.size());
  Index count = 0;
  const auto counts = [&](Index summit, double low) {
    return inside[static_cast<std::size_t>(summit)] != 0 && value(summit) - low > threshold;
  };
  for (const Index node : order) {
    hills.raise(node);
    graph.for_each_neighbour(node, [&](Index j) {
      if (!hills.seen(j)) return;
      const Index a = hills.summit(node);
      const Index b = hills.summit(j);
      if (a == b) return;
      const Index lower = higher(a, b) ? b : a;
      hills.join(lower, lower == a ? b : a);
      if (lower != node && counts(lower, value(node))) ++count;
    });
  }
  // What was never overtopped stands over the lowest node that it leads to.
  std::vector<double> low(values.begin(), values.end());
  for (const Index node : order) low[static_cast<std::size_t>(hills.summit(node))] = value(node);
  for (const Index node : order) {
    if (hills.summit(node) == node && counts(node, low[static_cast<std::size_t>(node)])) ++count;
  }
  return count;
}

namespace {

/// How often the values rise and fall in turn, each time by more than the threshold, from place `begin` on around.
std::size_t count_swings(std::span<const double> values, std::size_t begin, std::size_t count, double threshold) {
  std::size_t swings = 0;
  int direction = 0;
  double low = values[begin];
  double high = values[begin];
  for (std::size_t k = 1; k < count; ++k) {
    const double value = values[(begin + k) % values.size()];
    low = std::min(low, value);
    high = std::max(high, value);
    if (direction <= 0 && value - low > threshold) {
      direction = 1;
      high = value;
      ++swings;
    } else if (direction >= 0 && high - value > threshold) {
      direction = -1;
      low = value;
      ++swings;
    }
  }
  return swings;
}

}  // namespace

Index count_extrema(std::span<const double> values, bool closed, double threshold) {
  if (values.size() < 3) return 0;
  // Around a closed line, from its lowest place back to it: the last fall is followed by the first rise.
  const auto lowest = static_cast<std::size_t>(std::min_element(values.begin(), values.end()) - values.begin());
  if (closed) return static_cast<Index>(count_swings(values, lowest, values.size() + 1, threshold));
  const std::size_t swings = count_swings(values, 0, values.size(), threshold);
  return swings > 0 ? static_cast<Index>(swings - 1) : 0;
}

Index count_sign_changes(std::span<const double> values, bool closed, double threshold) {
  Index changes = 0;
  int first = 0;
  int last = 0;
  for (const double value : values) {
    const int sign = value > threshold ? 1 : value < -threshold ? -1 : 0;
    if (sign == 0) continue;
    if (first == 0) first = sign;
    if (last * sign < 0) ++changes;
    last = sign;
  }
  if (closed && first * last < 0) ++changes;
  return changes;
}

}  // namespace vspring
