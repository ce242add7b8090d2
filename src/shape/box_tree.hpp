#pragma once

// A tree of boxes for nearest-item queries. Our own, because Debian's permissively licensed libraries handle points
// only (nanoflann) or render scenes (Embree). The layout follows from the number of items alone, so the tree needs no
// pointers and is built level by level in parallel, with the same bits on any number of threads.

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "base/threads.hpp"
#include "vspring/types.hpp"

namespace vspring {

using Box = Eigen::AlignedBox<double, 3>;

/// Numbered boxes in a balanced binary tree. The leaves hold runs of up to four of them.
class BoxTree {
 public:
  struct Nearest {
    double square = std::numeric_limits<double>::infinity();  ///< of the distance
    Index item = -1;
  };

  /// Boxes must be finite and not empty. Cost: n log n.
  BoxTree(std::vector<Box> boxes, ThreadTeam& team);

  [[nodiscard]] std::size_t leaf_count() const noexcept { return boxes_.empty() ? 0 : leaves_; }
  [[nodiscard]] std::span<const Index> leaf_items(std::size_t leaf) const {
    const std::size_t begin = first_item(leaf, leaves_);
    return std::span(items_).subspan(begin, first_item(leaf + 1, leaves_) - begin);
  }
  [[nodiscard]] const Box& leaf_box(std::size_t leaf) const { return tree_[leaves_ - 1 + leaf]; }
  [[nodiscard]] const Box& box(Index item) const { return boxes_[static_cast<std::size_t>(item)]; }

  /// The box around all of them.
  [[nodiscard]] const Box& whole() const { return tree_.front(); }

  /// Calls use(leaf) for every leaf from `first_leaf` on whose box overlaps `box`, in ascending order.
  template <typename Use>
  void for_each_overlapping_leaf(const Box& box, std::size_t first_leaf, const Use& use) const {
    for_each_leaf([&](const Box& other) { return other.intersects(box); }, first_leaf, use);
  }

  /// Calls use(leaf) for every leaf whose box passes `meets`, in ascending order. meets(box): may be false only if
  /// nothing in the box is wanted.
  template <typename Meets, typename Use>
  void for_each_leaf(const Meets& meets, std::size_t first_leaf, const Use& use) const {
    if (boxes_.empty()) return;
    std::array<Place, most_levels> stack;
    std::size_t height = 0;
    stack[height++] = {0, 0, leaves_};
    while (height > 0) {
      const Place place = stack[--height];
      if (place.leaf + place.leaves <= first_leaf || !meets(tree_[place.node])) continue;
      if (place.leaves == 1) {
        use(place.leaf);
      } else {
        stack[height++] = place.right();
        stack[height++] = place.left();
      }
    }
  }

  /// The item nearest to `point`: square(item) is the square of its distance; of equally near ones the smallest number.
  /// None (−1) if none is nearer than the root of `below`.
  template <typename Square>
  [[nodiscard]] Nearest nearest(const Vector3& point, const Square& square,
                                double below = std::numeric_limits<double>::infinity()) const {
    Nearest best{.square = below};
    if (boxes_.empty()) return best;
    std::array<Waiting, most_levels> stack;
    std::size_t height = 0;
    stack[height++] = {{0, 0, leaves_}, 0.0};
    while (height > 0) {
      auto [place, from_box] = stack[--height];
      // Visits the nearer child first.
      while (from_box <= best.square && place.leaves > 1) {
        Waiting near{place.left(), square_outside(tree_[place.left().node], point)};
        Waiting far{place.right(), square_outside(tree_[place.right().node], point)};
        if (far.square < near.square) std::swap(near, far);
        if (far.square <= best.square) stack[height++] = far;
        place = near.place;
        from_box = near.square;
      }
      if (from_box > best.square) continue;
      for (const Index item : leaf_items(place.leaf)) {
        const double distance2 = square(item);
        if (distance2 < best.square || (distance2 == best.square && item < best.item)) best = {distance2, item};
      }
    }
    return best;
  }

 private:
  static constexpr std::size_t items_per_leaf = 4;
  static constexpr std::size_t most_levels = 64;

  /// A node of the tree and the run of leaves under it. Children of node k are 2k + 1 and 2k + 2.
  struct Place {
    std::size_t node;
    std::size_t leaf;
    std::size_t leaves;
    [[nodiscard]] Place left() const { return {2 * node + 1, leaf, leaves / 2}; }
    [[nodiscard]] Place right() const { return {2 * node + 2, leaf + leaves / 2, leaves / 2}; }
  };

  /// A part of the tree to visit later, and the square of the distance of its box.
  struct Waiting {
    Place place;
    double square;
  };

  /// The first item of part `part` of `parts` (a power of two).
  [[nodiscard]] std::size_t first_item(std::size_t part, std::size_t parts) const {
    // In 64 bits also where addresses have 32.
    return static_cast<std::size_t>(std::uint64_t{boxes_.size()} * part / parts);
  }
  void split(std::size_t part, std::size_t parts);

  /// Box::squaredExteriorDistance without branches, which cannot be predicted.
  [[nodiscard]] static double square_outside(const Box& box, const Vector3& point) {
    double sum = 0;
    for (int k = 0; k < 3; ++k) {
      const double outside = std::max(std::max(box.min()[k] - point[k], point[k] - box.max()[k]), 0.0);
      sum += outside * outside;
    }
    return sum;
  }

  std::vector<Box> boxes_;
  std::vector<Index> items_;
  std::vector<Box> tree_;
  std::size_t leaves_ = 1;
};

}  // namespace vspring
