#include "fairness/extrema.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace vspring {

namespace {

/// A pass: the node between two summits.
struct Pass {
  double value;
  Index node;
  Index from;  ///< the summits
  Index to;
};

/// Summits in connected groups; the highest represents a group.
class PersistenceMerge {
 public:
  explicit PersistenceMerge(std::vector<Index> summits) : above_(std::move(summits)) {}

  /// above: per node a higher one, or itself if it is a summit.
  [[nodiscard]] Index summit(Index node) {
    while (above(node) != node) {
      above(node) = above(above(node));
      node = above(node);
    }
    return node;
  }
  void join(Index lower_summit, Index summit) { above(lower_summit) = summit; }

 private:
  Index& above(Index node) { return above_[static_cast<std::size_t>(node)]; }
  std::vector<Index> above_;
};

}  // namespace

Index count_maxima(const NodeGraph& graph, std::span<const double> values, std::span<const std::uint8_t> used,
                   std::span<const std::uint8_t> inside, double threshold) {
  const auto value = [&](Index node) { return values[static_cast<std::size_t>(node)]; };
  const auto is_used = [&](Index node) { return used[static_cast<std::size_t>(node)] != 0; };
  const auto higher = [&](Index a, Index b) { return value(a) != value(b) ? value(a) > value(b) : a < b; };
  const auto counts = [&](Index summit, double low) {
    return inside[static_cast<std::size_t>(summit)] != 0 && value(summit) - low > threshold;
  };
  std::vector<Index> above(values.size());
  for (Index i = 0; i < graph.size(); ++i) {
    Index highest = i;
    if (is_used(i)) {
      graph.for_each_neighbour(i, [&](Index j) {
        if (is_used(j) && higher(j, highest)) highest = j;
      });
    }
    above[static_cast<std::size_t>(i)] = highest;
  }
  // A hill is a summit with the nodes whose steepest ascent leads there. Hills are joined at their passes, the highest
  // first; other nodes need no step, and there are far fewer hills than nodes.
  PersistenceMerge hills(std::move(above));
  std::vector<Pass> passes;
  std::vector<double> low(values.begin(), values.end());
  for (Index i = 0; i < graph.size(); ++i) {
    if (!is_used(i)) continue;
    const Index from = hills.summit(i);
    double& lowest = low[static_cast<std::size_t>(from)];
    lowest = std::min(lowest, value(i));
    Index last = from;
    graph.for_each_neighbour(i, [&](Index j) {
      if (!is_used(j) || !higher(j, i)) return;
      const Index to = hills.summit(j);
      if (to != from && to != last) passes.push_back({value(i), i, from, to});
      last = to;
    });
  }
  std::sort(passes.begin(), passes.end(),
            [](const Pass& a, const Pass& b) { return a.value != b.value ? a.value > b.value : a.node < b.node; });
  Index count = 0;
  for (const Pass& pass : passes) {
    const Index a = hills.summit(pass.from);
    const Index b = hills.summit(pass.to);
    if (a == b) continue;
    const auto [lower, summit] = higher(a, b) ? std::pair(b, a) : std::pair(a, b);
    hills.join(lower, summit);
    double& lowest = low[static_cast<std::size_t>(summit)];
    lowest = std::min(lowest, low[static_cast<std::size_t>(lower)]);
    if (counts(lower, pass.value)) ++count;
  }
  // A summit that was never exceeded stands out over the lowest node of its group.
  for (Index i = 0; i < graph.size(); ++i) {
    if (is_used(i) && hills.summit(i) == i && counts(i, low[static_cast<std::size_t>(i)])) ++count;
  }
  return count;
}

namespace {

/// How often the values rise and fall in turn, each time by more than the threshold, once around from place `begin`.
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
  // A closed line starts and ends at its lowest place, so the first rise follows the last fall.
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
