#include "shape/tour.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "shape/point_tree.hpp"

namespace vspring::tour_test {
namespace {

std::vector<Vector3> cloud(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Vector3> points;
  points.reserve(static_cast<std::size_t>(count));
  for (int k = 0; k < count; ++k) {
    const double x = number(generator);
    points.emplace_back(x, number(generator), 0);
  }
  return points;
}

/// A tour in which every point knows all others.
Tour tour_of(const std::vector<Vector3>& points, std::vector<Index> order, bool closed) {
  const PointTree tree(points);
  std::vector<Index> neighbours;
  std::vector<PointTree::Near> near;
  for (Index point = 0; point < static_cast<Index>(points.size()); ++point) {
    tree.nearest(point, points.size() - 1, near);
    for (const PointTree::Near& other : near) neighbours.push_back(other.point);
  }
  return {points, std::move(order), closed, std::move(neighbours), points.size() - 1};
}

double length_of(const std::vector<Vector3>& points, const std::vector<Index>& order, bool closed) {
  double length = 0;
  for (std::size_t k = closed ? 0 : 1; k < order.size(); ++k)
    length += (points[static_cast<std::size_t>(order[k])] -
               points[static_cast<std::size_t>(order[k > 0 ? k - 1 : order.size() - 1])])
                  .norm();
  return length;
}

/// The shortest of those that come of turning any piece round.
double shortest_turned(const std::vector<Vector3>& points, const std::vector<Index>& order, bool closed) {
  double least = length_of(points, order, closed);
  for (auto first = order.begin(); first != order.end(); ++first) {
    for (auto end = first + 1; end != order.end() + 1; ++end) {
      std::vector<Index> turned = order;
      std::reverse(turned.begin() + (first - order.begin()), turned.begin() + (end - order.begin()));
      least = std::min(least, length_of(points, turned, closed));
    }
  }
  return least;
}

/// The shortest of those that come of moving any of up to three points anywhere, turned round or not.
double shortest_moved(const std::vector<Vector3>& points, const std::vector<Index>& order, bool closed) {
  double least = length_of(points, order, closed);
  for (auto first = order.begin(); first != order.end(); ++first) {
    for (auto end = first + 1; end - first <= 3 && end != order.end() + 1; ++end) {
      std::vector<Index> rest(order.begin(), first);
      rest.insert(rest.end(), end, order.end());
      for (std::ptrdiff_t place = 0; place <= std::ssize(rest); ++place) {
        std::vector<Index> moved = rest;
        moved.insert(moved.begin() + place, first, end);
        least = std::min(least, length_of(points, moved, closed));
        std::reverse(moved.begin() + place, moved.begin() + place + (end - first));
        least = std::min(least, length_of(points, moved, closed));
      }
    }
  }
  return least;
}

TEST(Tour, EndsWhereSmallChangesMakeItNoShorter) {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const bool closed = seed % 2 == 1;
    const std::vector<Vector3> points = cloud(30, seed);
    std::vector<Index> start(points.size());
    std::iota(start.begin(), start.end(), 0);
    Tour tour = tour_of(points, start, closed);
    // What changes at one place may make a change possible at another, which is looked at again by the next call.
    for (int k = 0; k < 3; ++k) tour.improve();
    const std::vector<Index> order = tour.order();
    std::vector<Index> sorted = order;
    std::sort(sorted.begin(), sorted.end());
    ASSERT_EQ(sorted, start);
    const double length = length_of(points, order, closed);
    EXPECT_LT(length, 0.6 * length_of(points, start, closed));
    EXPECT_GE(shortest_turned(points, order, closed), length * (1 - 1e-9)) << seed;
    // Of moves only those that join a point to one nearer than what is saved are looked at.
    EXPECT_GE(shortest_moved(points, order, closed), 0.97 * length) << seed;
  }
}

TEST(Tour, OpensAtTheLongestStep) {
  // A ring with a gap between points 7 and 8, begun elsewhere.
  std::vector<Vector3> points;
  points.reserve(20);
  for (int k = 0; k < 20; ++k)
    points.emplace_back(std::cos(0.3 * k + (k > 7 ? 0.2 : 0)), std::sin(0.3 * k + (k > 7 ? 0.2 : 0)), 0);
  std::vector<Index> start(points.size());
  std::iota(start.begin(), start.end(), 0);
  Tour tour = tour_of(points, start, false);
  tour.open_at_longest_step();
  const std::vector<Index> order = tour.order();
  EXPECT_EQ(order.front(), 8);
  EXPECT_EQ(order.back(), 7);
  EXPECT_EQ(order[12], 0);
  // One that is closed has no ends, and one whose ends are further apart keeps them.
  Tour ring = tour_of(points, start, true);
  ring.open_at_longest_step();
  EXPECT_EQ(ring.order(), start);
  for (Vector3& point : points) point.x() *= point.y() < 0 ? 1 : 3;
  points.pop_back();
  points.pop_back();
  points.pop_back();
  start.resize(points.size());
  Tour apart = tour_of(points, start, false);
  apart.open_at_longest_step();
  EXPECT_EQ(apart.order(), start);
}

}  // namespace
}  // namespace vspring::tour_test
