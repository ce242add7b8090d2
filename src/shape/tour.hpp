#pragma once

#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// A tour through points that local changes shorten: a piece is reversed (2-opt), or one of up to three points moved
/// (Or-opt). An open path is a tour with one more stop, at distance 0 from all points.
class Tour {
 public:
  /// order: every point once. neighbours: `neighbour_count` for each point, the nearest first.
  Tour(std::span<const Vector3> points, std::vector<Index> order, bool closed, std::vector<Index> neighbours,
       std::size_t neighbour_count);

  /// Changes the tour until no change towards neighbours shortens it, or 200 n points have been moved.
  void improve();
  /// Opens an open path at its longest step instead, if joining its ends is shorter.
  void open_at_longest_step();

  /// The points in order, of an open path from one end to the other.
  [[nodiscard]] std::vector<Index> order() const;

 private:
  [[nodiscard]] double distance(Index a, Index b) const;
  [[nodiscard]] Index size() const { return static_cast<Index>(order_.size()); }
  [[nodiscard]] Index at(Index place) const { return order_[static_cast<std::size_t>(place)]; }
  [[nodiscard]] Index place_of(Index point) const { return places_[static_cast<std::size_t>(point)]; }
  /// The stop `count` places after a point, or before it if negative.
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
  Index stop_;  ///< the extra stop of an open path; else a number that no point has
  std::vector<Index> order_;
  std::vector<Index> places_;
  std::vector<Index> neighbours_;
  std::size_t neighbour_count_;
  std::deque<Index> queue_;  ///< points still to try
  std::vector<std::uint8_t> queued_;
  std::int64_t work_ = 0;
};

}  // namespace vspring
