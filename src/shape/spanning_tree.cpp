#include "shape/spanning_tree.hpp"

#include <algorithm>
#include <numeric>

namespace vspring {
namespace {

/// Which points are connected.
class Groups {
 public:
  explicit Groups(std::size_t count) : above_(count) { std::iota(above_.begin(), above_.end(), 0); }

  Index of(Index point) {
    Index& above = above_[static_cast<std::size_t>(point)];
    while (above != above_[static_cast<std::size_t>(above)]) above = above_[static_cast<std::size_t>(above)];
    return above;
  }
  /// False if they were connected already.
  bool join(Index a, Index b) {
    a = of(a);
    b = of(b);
    above_[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
    return a != b;
  }

 private:
  std::vector<Index> above_;
};

}  // namespace

std::vector<std::pair<Index, Index>> spanning_tree(std::span<const Vector3> points, PointTree& tree) {
  struct Way {
    PointTree::Near to;
    Index from = -1;
  };
  std::vector<std::pair<Index, Index>> edges;
  Groups groups(points.size());
  std::vector<Index> group(points.size());
  while (edges.size() + 1 < points.size()) {
    for (std::size_t k = 0; k < points.size(); ++k) group[k] = groups.of(static_cast<Index>(k));
    tree.set_groups(group);
    std::vector<Way> shortest(points.size());
    for (std::size_t k = 0; k < points.size(); ++k) {
      Way& way = shortest[static_cast<std::size_t>(group[k])];
      PointTree::Near found = way.to;
      tree.nearest_of_others(static_cast<Index>(k), found);
      if (found < way.to) way = {found, static_cast<Index>(k)};
    }
    // Two groups may have chosen different edges of equal length to each other.
    for (const Way& way : shortest) {
      if (way.from >= 0 && groups.join(way.from, way.to.point)) edges.emplace_back(way.from, way.to.point);
    }
  }
  return edges;
}

}  // namespace vspring
