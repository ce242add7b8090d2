#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// Points in a k-d tree (J. L. Bentley 1975), to find nearest points. Unlike BoxTree it finds several, and skips boxes
/// whose points all belong to one group.
class PointTree {
 public:
  struct Near {
    double square = std::numeric_limits<double>::infinity();  ///< of the distance
    Index point = -1;

    bool operator<(const Near& other) const { return std::pair(square, point) < std::pair(other.square, other.point); }
  };

  /// Points must be finite and outlive the tree. Cost: n log n.
  explicit PointTree(std::span<const Vector3> points);

  /// The `count` points nearest to one of the points, without itself, the nearest first; of equally near ones the
  /// smallest numbers. Fewer if there are no more.
  void nearest(Index point, std::size_t count, std::vector<Near>& found) const;

  /// The points at most `radius` from a place, in no particular order.
  void within(const Vector3& place, double radius, std::vector<Index>& found) const;

  /// Sets which points belong together. groups: one number per point. Cost: linear.
  void set_groups(std::span<const Index> groups);

  /// Updates `best` if a point of another group is at least as near.
  void nearest_of_others(Index point, Near& best) const;

 private:
  static constexpr Index points_per_leaf = 8;
  static constexpr Index many = -1;  ///< groups in a box

  struct Box {
    Vector3 low;
    Vector3 high;
    Index begin;
    Index end;
    Index group = many;  ///< of all points in the box, if they share one
  };

  void build(std::size_t box, Index begin, Index end);
  [[nodiscard]] double square_to(const Box& box, const Vector3& place) const;
  /// Visits leaves, the nearer child first. bound: boxes further away are passed over.
  template <typename Passes, typename Use>
  void visit(const Vector3& place, const double& bound, const Passes& passes, const Use& use) const;

  std::span<const Vector3> points_;
  std::vector<Index> order_;
  std::vector<Box> boxes_;  ///< children of box k are 2k + 1 and 2k + 2
  std::span<const Index> groups_;
};

}  // namespace vspring
