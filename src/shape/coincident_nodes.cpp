#include "shape/coincident_nodes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

#include "base/disjoint_sets.hpp"
#include "base/threads.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

constexpr double widest_group = 2;     // in tolerances, along an axis
constexpr double least_reach = 1e-16;  // in a box of 1 to 2
constexpr double cell_side = 0.577;    // of the reach: places in one cell are within reach of each other

bool comes_before(const Vector3& a, const Vector3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Groups of places: each place is within reach of another of its group. Cells are so small that all places of one
/// belong together, and two cells are compared only until they are joined, so crowded places have no quadratic cost.
class PlaceGroups {
 public:
  PlaceGroups(const std::vector<Vector3>& places, double reach) : places_(places), reach_(reach) {
    std::vector<Vector3> keys;
    keys.reserve(places.size());
    for (const Vector3& place : places) keys.emplace_back((place / (cell_side * reach)).array().floor());
    order_.resize(places.size());
    std::iota(order_.begin(), order_.end(), std::size_t{0});
    std::sort(order_.begin(), order_.end(), [&](std::size_t a, std::size_t b) {
      return keys[a] != keys[b] ? comes_before(keys[a], keys[b]) : a < b;
    });
    for (std::size_t k = 0; k < order_.size(); ++k) {
      if (k == 0 || keys[order_[k]] != keys[order_[k - 1]]) {
        begin_.push_back(k);
        boxes_.emplace_back();
      }
      boxes_.back().extend(places[order_[k]]);
    }
    groups_ = DisjointSets(begin_.size());
    begin_.push_back(order_.size());
  }

  /// Returns whether no group is too wide; stops at the first that is.
  bool join() {
    ThreadTeam team(1);
    const BoxTree tree(boxes_, team);
    std::vector<Box> wide = boxes_;  // of groups, at their roots
    const auto unite = [&](std::size_t a, std::size_t b) {
      const std::size_t low = groups_.join(a, b);
      wide[low].extend(wide[low == a ? b : a]);
      if (wide[low].sizes().maxCoeff() > widest_group * reach_) too_wide_ = low;
    };
    for (std::size_t cell = 0; cell < boxes_.size() && too_wide_ == none; ++cell) {
      const Box around(boxes_[cell].min().array() - reach_, boxes_[cell].max().array() + reach_);
      tree.for_each_overlapping_leaf(around, 0, [&](std::size_t leaf) {
        for (const Index item : tree.leaf_items(leaf)) {
          const auto other = static_cast<std::size_t>(item);
          if (other <= cell || too_wide_ != none || groups_.find(other) == groups_.find(cell) || !touch(cell, other))
            continue;
          unite(groups_.find(cell), groups_.find(other));
        }
      });
    }
    return too_wide_ == none;
  }

  /// Calls use(place, group) for every place; group numbers are below the number of places.
  template <typename Use>
  void for_each(const Use& use) {
    for (std::size_t cell = 0; cell + 1 < begin_.size(); ++cell) {
      for (std::size_t k = begin_[cell]; k < begin_[cell + 1]; ++k) use(order_[k], groups_.find(cell));
    }
  }

  /// The places furthest apart in the group that is too wide, along an axis.
  std::pair<std::size_t, std::size_t> ends() {
    Box box;
    for_each([&](std::size_t place, std::size_t group) {
      if (group == too_wide_) box.extend(places_[place]);
    });
    Eigen::Index axis = 0;
    box.sizes().maxCoeff(&axis);
    std::pair<std::size_t, std::size_t> found;
    for_each([&](std::size_t place, std::size_t group) {
      if (group != too_wide_) return;
      if (places_[place][axis] == box.min()[axis]) found.first = place;
      if (places_[place][axis] == box.max()[axis]) found.second = place;
    });
    return found;
  }

 private:
  static constexpr auto none = static_cast<std::size_t>(-1);

  [[nodiscard]] bool touch(std::size_t a, std::size_t b) const {
    for (std::size_t i = begin_[a]; i < begin_[a + 1]; ++i) {
      const Vector3& place = places_[order_[i]];
      if (boxes_[b].squaredExteriorDistance(place) > reach_ * reach_) continue;
      for (std::size_t k = begin_[b]; k < begin_[b + 1]; ++k) {
        if ((places_[order_[k]] - place).squaredNorm() <= reach_ * reach_) return true;
      }
    }
    return false;
  }

  const std::vector<Vector3>& places_;
  double reach_;
  std::vector<std::size_t> order_;  // the places, cell by cell
  std::vector<std::size_t> begin_;  // of every cell in order_, and the end
  std::vector<Box> boxes_;          // around the places of a cell
  DisjointSets groups_{0};          // of cells
  std::size_t too_wide_ = none;
};

}  // namespace

FaceNodes::FaceNodes(const PolygonMesh& mesh) {
  std::vector<std::uint8_t> used(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Index node : mesh.corners()) used[static_cast<std::size_t>(node)] = 1;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (used[static_cast<std::size_t>(i)] == 0 || !mesh.position(i).allFinite()) continue;
    nodes.push_back(i);
    box.extend(mesh.position(i));
  }
}

double FaceNodes::length(double share) const {
  if (!(share >= 0 && std::isfinite(share)))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("a tolerance for welding must be 0 or more, and finite, not {}", share));
  return box.isEmpty() ? 0 : share * box.sizes().stableNorm();
}

CoincidentNodes coincident_nodes(std::span<const Vector3> positions, std::vector<Index> nodes, const Box& box,
                                 double tolerance) {
  const auto at = [&](Index node) -> const Vector3& { return positions[static_cast<std::size_t>(node)]; };
  CoincidentNodes result{.first = std::vector<Index>(positions.size()), .chained = {-1, -1}};
  std::iota(result.first.begin(), result.first.end(), 0);
  std::sort(nodes.begin(), nodes.end(),
            [&](Index a, Index b) { return at(a) != at(b) ? comes_before(at(a), at(b)) : a < b; });
  const Frame frame(box);
  std::vector<Vector3> places;
  std::vector<Index> first_at;  // the first node at each place
  for (const Index node : nodes) {
    if (places.empty() || at(node) != at(first_at.back())) {
      places.push_back(frame.to_local(at(node)));
      first_at.push_back(node);
    }
    result.first[static_cast<std::size_t>(node)] = first_at.back();
  }
  const double reach = tolerance * frame.scale();
  if (!(reach >= least_reach)) return result;

  PlaceGroups groups(places, reach);
  if (!groups.join()) {
    const auto [one, other] = groups.ends();
    result.chained = std::minmax({first_at[one], first_at[other]});
    return result;
  }
  std::vector<Index> least(places.size(), -1);  // of every group
  groups.for_each([&](std::size_t place, std::size_t group) {
    least[group] = least[group] < 0 ? first_at[place] : std::min(least[group], first_at[place]);
  });
  std::vector<Index> first_of(positions.size(), -1);
  groups.for_each([&](std::size_t place, std::size_t group) {
    first_of[static_cast<std::size_t>(first_at[place])] = least[group];
  });
  for (const Index node : nodes) {
    Index& first = result.first[static_cast<std::size_t>(node)];
    first = first_of[static_cast<std::size_t>(first)];
  }
  return result;
}

}  // namespace vspring
