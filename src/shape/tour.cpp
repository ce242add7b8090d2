#include "shape/tour.hpp"

#include <algorithm>
#include <array>
#include <initializer_list>
#include <utility>

namespace vspring {
namespace {

/// Gains below this share of the lengths compared are rounding.
constexpr double least_gain = 1e-12;

}  // namespace

Tour::Tour(std::span<const Vector3> points, std::vector<Index> order, bool closed, std::vector<Index> neighbours,
           std::size_t neighbour_count)
    : points_(points),
      stop_(closed ? -1 : static_cast<Index>(points.size())),
      order_(std::move(order)),
      places_(points.size() + 1),
      neighbours_(std::move(neighbours)),
      neighbour_count_(neighbour_count),
      queued_(points.size() + 1, 0) {
  if (!closed) order_.push_back(stop_);
  for (Index place = 0; place < size(); ++place) put(place, at(place));
}

double Tour::distance(Index a, Index b) const {
  if (a == stop_ || b == stop_) return 0;
  return (points_[static_cast<std::size_t>(a)] - points_[static_cast<std::size_t>(b)]).norm();
}

Index Tour::along(Index point, Index count) const {
  Index place = place_of(point) + count;
  if (place < 0) place += size();
  if (place >= size()) place -= size();
  return at(place);
}

std::span<const Index> Tour::neighbours_of(Index point) const {
  if (point == stop_) return {};
  return std::span(neighbours_).subspan(static_cast<std::size_t>(point) * neighbour_count_, neighbour_count_);
}

void Tour::put(Index place, Index point) {
  order_[static_cast<std::size_t>(place)] = point;
  places_[static_cast<std::size_t>(point)] = place;
}

void Tour::look_at(std::initializer_list<Index> points) {
  for (const Index point : points) {
    std::uint8_t& queued = queued_[static_cast<std::size_t>(point)];
    if (queued == 0) queue_.push_back(point);
    queued = 1;
  }
}

void Tour::improve() {
  constexpr Index fewest = 5;
  if (size() < fewest) return;
  constexpr std::int64_t work_per_point = 200;
  work_ = work_per_point * size();
  for (Index place = 0; place < size(); ++place) look_at({at(place)});
  while (!queue_.empty() && work_ > 0) {
    const Index point = queue_.front();
    queue_.pop_front();
    queued_[static_cast<std::size_t>(point)] = 0;
    while (work_ > 0 && shorten_at(point)) {
    }
  }
  queue_.clear();
  std::fill(queued_.begin(), queued_.end(), std::uint8_t{0});
}

bool Tour::shorten_at(Index point) {
  --work_;
  for (const Index step : {1, -1}) {
    if (turn_at(point, step)) return true;
    constexpr Index longest = 3;
    for (Index count = 1; count <= longest; ++count) {
      if (move_from(point, step, count)) return true;
    }
  }
  return false;
}

/// Replaces the steps from `point` and from a neighbour of it by one that joins the two.
bool Tour::turn_at(Index point, Index step) {
  const Index next = along(point, step);
  const double length = distance(point, next);
  for (const Index other : neighbours_of(point)) {
    const double joined = distance(point, other);
    if (!(joined < length)) return false;
    const Index behind = along(other, step);
    const double before = length + distance(other, behind);
    if (!(joined + distance(next, behind) < before * (1 - least_gain))) continue;
    if (step > 0)
      turn(place_of(next), place_of(other));
    else
      turn(place_of(point), place_of(behind));
    look_at({point, next, other, behind});
    return true;
  }
  return false;
}

/// Moves the piece of `count` points from `point` on to between a neighbour of it and the point beside that.
bool Tour::move_from(Index point, Index step, Index count) {
  const Index last = along(point, (count - 1) * step);
  const Index before = along(point, -step);
  const Index behind = along(last, step);
  const double here = distance(before, point) + distance(last, behind);
  const double without = here - distance(before, behind);
  const auto in_piece = [&](Index other) {
    Index steps = (place_of(other) - place_of(point)) * step;
    if (steps < 0) steps += size();
    return steps < count;
  };
  for (const Index other : neighbours_of(point)) {
    const double joined = distance(point, other);
    if (!(joined < without)) return false;
    if (in_piece(other)) continue;
    for (const Index side : {1, -1}) {
      const Index beside = along(other, side);
      if (in_piece(beside)) continue;
      const double gap = distance(other, beside);
      if (!(joined + distance(last, beside) - gap < without - least_gain * (here + gap))) continue;
      // The piece goes before the later one of the two, and is reversed if its direction there differs.
      move(place_of(step > 0 ? point : last), count, side > 0 ? beside : other, (side > 0) != (step > 0));
      look_at({point, last, before, behind, other, beside});
      return true;
    }
  }
  return false;
}

/// Reverses the points from one place to another, or all others, which gives the same tour.
void Tour::turn(Index first, Index last) {
  Index count = last - first + 1;
  if (count <= 0) count += size();
  if (2 * count > size()) {
    std::swap(first, last);
    first = first + 1 < size() ? first + 1 : 0;
    last = last > 0 ? last - 1 : size() - 1;
    count = size() - count;
  }
  work_ -= count;
  for (Index k = 0; k < count / 2; ++k) {
    const Index a = at(first);
    put(first, at(last));
    put(last, a);
    first = first + 1 < size() ? first + 1 : 0;
    last = last > 0 ? last - 1 : size() - 1;
  }
}

/// Moves `count` points, from a place on, to before another point.
void Tour::move(Index first, Index count, Index before, bool turned) {
  std::array<Index, 3> piece{};
  const auto wrapped = [&](Index place) {
    return place < 0 ? place + size() : place >= size() ? place - size() : place;
  };
  for (Index k = 0; k < count; ++k) piece[static_cast<std::size_t>(k)] = at(wrapped(first + k));
  if (turned) std::reverse(piece.begin(), piece.begin() + count);
  // The points between the piece and its new place shift, on the side with fewer of them.
  Index between = place_of(before) - (first + count);
  while (between < 0) between += size();
  const Index others = size() - count - between;
  if (between <= others) {
    for (Index k = 0; k < between; ++k) put(wrapped(first + k), at(wrapped(wrapped(first + k) + count)));
    first = wrapped(first + between);
  } else {
    for (Index k = 0; k < others; ++k) put(wrapped(first + count - 1 - k), at(wrapped(first - 1 - k)));
    first = wrapped(first - others);
  }
  for (Index k = 0; k < count; ++k) put(wrapped(first + k), piece[static_cast<std::size_t>(k)]);
  work_ -= std::min(between, others) + count;
}

void Tour::open_at_longest_step() {
  if (stop_ < 0 || size() < 4) return;
  Index longest = -1;
  double most = distance(along(stop_, -1), along(stop_, 1)) * (1 + least_gain);
  for (Index place = 0; place < size(); ++place) {
    const double length = distance(at(place), along(at(place), 1));
    if (length > most) {
      most = length;
      longest = at(place);
    }
  }
  if (longest >= 0) move(place_of(stop_), 1, along(longest, 1), false);
}

std::vector<Index> Tour::order() const {
  std::vector<Index> order = order_;
  if (stop_ < 0) return order;
  std::rotate(order.begin(), order.begin() + place_of(stop_), order.end());
  order.erase(order.begin());
  return order;
}

}  // namespace vspring
