#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// A way through points that becomes shorter by local changes: a piece is turned round (2-opt), or one of up to three
/// points moved elsewhere (Or-opt). An open way is one round with a last stop that is at no distance from any point.
class Tour {
 public:
  /// order: every point once. neighbours: `neighbour_count` of each point, the nearest first.
  Tour(std::span<const Vector3> points, std::vector<Index> order, bool closed, std::vector<Index> neighbours,
       std::size_t neighbour_count);

  /// Changes it until none of the changes that it looks at, to neighbours, makes it shorter, or 200 n points are moved.
  void improve();
  /// Opens an open way at its longest step, where joining its ends is shorter.
  void open_at_longest_step();

  /// The points in order, an open way from one end to the other.
  [[nodiscard]] std::vector<Index> order() const;

 private:
  [[nodiscard]] double distance(Index a, Index b) const;
  [[nodiscard]] Index size() const { return static_cast<Index>(order_.size()); }
  [[nodiscard]] Index at(Index place) const { return order_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] Index place_of(Index point) const { return places_[static_cast<std::size_t>(point)]; }
  /// The stop so many after a point, or before it.
  [[nodiscard]] Index along(Index point, Index count) const;
  [[nodiscard]] std::span<const Index> neighbours_of(Index point) const;
  void put(Index place, Index point);
  void look_at(std::initializer_list<Index> points);

  bool shorten_at(Index point);
  bool turn_at(Index point, Index step);
  bool move_from(Index point, Index step, Index count);
  void turn(Index first, Index last);
  void move(Index first, Index count, Index before, bool turned);

  std::span<const Vector3> points_;
  Index stop_;  ///< the number of the last stop of an open way; else one that no point has
  std::vector<Index> order_;
  std::vector<Index> places_;
  std::vector<Index> neighbours_;
  std::size_t neighbour_count_;
  std::deque<Index> queue_;  ///< points that are still to be looked at
  std::vector<std::uint8_t> queued_;
  std::int64_t work_ = 0;
};

}  // namespace vspring
