#include "vspring/order.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <numbers>
#include <numeric>
#include <random>
#include <vector>

#include "shape/point_tree.hpp"
#include "shape/spanning_tree.hpp"
#include "unit/io/scratch.hpp"

namespace vspring::order_test {
namespace {

/// Of parameters from 0 to 1.
struct Shape {
  const char* name;
  std::function<Vector3(double)> at;
  bool closed = false;
};

std::vector<Shape> shapes() {
  constexpr double round = 2 * std::numbers::pi;
  return {{"circle", [](double t) { return Vector3(std::cos(round * t), std::sin(round * t), 0); }, true},
          {"arc", [](double t) { return Vector3(std::cos(5 * t), std::sin(5 * t), 0); }},
          {"spiral",
           [](double t) { return Vector3((0.2 + t) * Vector3(std::cos(2 * round * t), std::sin(2 * round * t), 0)); }},
          {"S", [](double t) { return Vector3(2 * t, std::sin(round * t), 0); }},
          {"helix", [](double t) { return Vector3(std::cos(4 * round * t), std::sin(4 * round * t), 2 * t); }},
          {"trefoil",
           [](double t) {
             return Vector3(std::sin(round * t) + 2 * std::sin(2 * round * t),
                            std::cos(round * t) - 2 * std::cos(2 * round * t), -std::sin(3 * round * t));
           },
           true}};
}

/// Points at even distances along the shape, and that far off it at most, across it, as a share of their distance.
std::vector<Vector3> points_along(const Shape& shape, int count, double noise, unsigned seed) {
  const int fine = 50 * count;
  std::vector<double> length(1, 0);
  const auto at = [&](int k) { return shape.at(static_cast<double>(k) / fine); };
  for (int k = 1; k <= fine; ++k) length.push_back(length.back() + (at(k) - at(k - 1)).norm());
  const double step = length.back() / (shape.closed ? count : count - 1);
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> share(-noise, noise);
  std::vector<Vector3> points;
  for (int k = 0; k < count; ++k) {
    const auto found = std::lower_bound(length.begin(), length.end() - 1, k * step * (1 - 1e-12));
    const int place = static_cast<int>(found - length.begin());
    const Vector3 along = (at(place + 1) - at(place - 1)).normalized();
    Vector3 off(share(generator), share(generator), shape.at(0.1).z() == 0 ? 0 : share(generator));
    off -= along * along.dot(off);
    points.push_back(at(place) + step * off);
  }
  return points;
}

/// Points in a random order, and which ones they were.
struct Shuffled {
  explicit Shuffled(const std::vector<Vector3>& points, unsigned seed = 1) : from(points.size()) {
    std::iota(from.begin(), from.end(), 0);
    std::mt19937 generator(seed);
    std::shuffle(from.begin(), from.end(), generator);
    for (const Index k : from) places.push_back(points[static_cast<std::size_t>(k)]);
  }
  /// The numbers before in an order.
  [[nodiscard]] std::vector<Index> before(const std::vector<Index>& order) const {
    std::vector<Index> numbers;
    numbers.reserve(order.size());
    for (const Index k : order) numbers.push_back(from[static_cast<std::size_t>(k)]);
    return numbers;
  }

  std::vector<Index> from;
  std::vector<Vector3> places;
};

/// Whether numbers count up or down, round a closed curve from any one on.
bool counts(std::vector<Index> numbers, bool closed) {
  if (closed) std::rotate(numbers.begin(), std::find(numbers.begin(), numbers.end(), 0), numbers.end());
  if (closed && numbers.size() > 1 && numbers[1] != 1) std::reverse(numbers.begin() + 1, numbers.end());
  if (numbers.front() != 0) std::reverse(numbers.begin(), numbers.end());
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    if (numbers[k] != static_cast<Index>(k)) return false;
  }
  return true;
}

bool is_permutation(std::vector<Index> order, std::size_t count) {
  std::sort(order.begin(), order.end());
  std::vector<Index> all(count);
  std::iota(all.begin(), all.end(), 0);
  return order == all;
}

double length_of(const std::vector<Vector3>& points, const std::vector<Index>& order, bool closed) {
  double length = 0;
  for (std::size_t k = closed ? 0 : 1; k < order.size(); ++k)
    length += (points[static_cast<std::size_t>(order[k])] -
               points[static_cast<std::size_t>(order[k > 0 ? k - 1 : order.size() - 1])])
                  .norm();
  return length;
}

std::vector<Vector3> cloud(int count, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> number(0, 1);
  std::vector<Vector3> points;
  for (int k = 0; k < count; ++k) {
    const double x = number(generator);
    const double y = number(generator);
    points.emplace_back(x, y, number(generator));
  }
  return points;
}

TEST(Order, FindsCurvesWithNoiseOfHalfTheDistanceOfPoints) {
  for (const Shape& shape : shapes()) {
    for (const int count : {120, 300, 2000}) {
      for (const double noise : {0.0, 0.25, 0.5}) {
        SCOPED_TRACE(testing::Message() << shape.name << ' ' << count << ' ' << noise);
        const Shuffled shuffled(points_along(shape, count, noise, 7), 3);
        const std::vector<Index> order = order_along_curve(shuffled.places, shape.closed);
        EXPECT_TRUE(is_permutation(order, shuffled.places.size()));
        EXPECT_TRUE(counts(shuffled.before(order), shape.closed));
      }
    }
  }
}

TEST(Order, IsNoLongerThanTheTruthWherePointsPassEachOther) {
  for (const Shape& shape : shapes()) {
    std::vector<Vector3> points = points_along(shape, 500, 0, 1);
    const double step = (points[1] - points[0]).norm();
    const std::vector<Vector3> off = cloud(500, 9);
    for (std::size_t k = 0; k < points.size(); ++k) points[k] += step * (off[k] - Vector3(0.5, 0.5, 0.5));
    const Shuffled shuffled(points);
    const std::vector<Index> order = order_along_curve(shuffled.places, shape.closed);
    std::vector<Index> truth(points.size());
    std::iota(truth.begin(), truth.end(), 0);
    EXPECT_LE(length_of(shuffled.places, order, shape.closed), length_of(points, truth, shape.closed) * (1 + 1e-12));
    const std::vector<Index> before = shuffled.before(order);
    for (std::size_t k = 1; k < before.size(); ++k) {
      const int apart = std::abs(before[k] - before[k - 1]);
      EXPECT_LE(shape.closed ? std::min(apart, 500 - apart) : apart, 3) << shape.name;
    }
  }
}

TEST(Order, LeavesWhatIsInOrderAsItIs) {
  for (const Shape& shape : shapes()) {
    const std::vector<Vector3> points = points_along(shape, 200, 0.25, 5);
    const std::vector<Index> order = order_along_curve(points, shape.closed);
    EXPECT_TRUE(std::is_sorted(order.begin(), order.end())) << shape.name;
  }
  const std::vector<Vector3> corners = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  EXPECT_EQ(order_along_curve(corners, true), (std::vector<Index>{0, 1, 2, 3}));
}

TEST(Order, RunsTheWayInWhichMoreNumbersRise) {
  std::vector<Vector3> points;
  for (const double x : {4.0, 0.0, 1.0, 2.0, 3.0}) points.emplace_back(x, 0, 0);
  EXPECT_EQ(order_along_curve(points, false), (std::vector<Index>{1, 2, 3, 4, 0}));
  std::reverse(points.begin(), points.end());
  EXPECT_EQ(order_along_curve(points, false), (std::vector<Index>{4, 0, 1, 2, 3}));
  // A ring begins with the first point.
  const std::vector<Vector3> ring = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}};
  EXPECT_EQ(order_along_curve(ring, true), (std::vector<Index>{0, 2, 1, 3}));
}

TEST(Order, KeepsEqualPointsTogether) {
  const std::vector<Vector3> points = {{2, 0, 0}, {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {1, 0, 0}, {3, 0, 0}};
  EXPECT_EQ(order_along_curve(points, false), (std::vector<Index>{1, 2, 4, 0, 3, 5}));
  EXPECT_EQ(order_along_curve(std::vector<Vector3>(5, Vector3(1, 2, 3)), false), (std::vector<Index>{0, 1, 2, 3, 4}));
  // What repeats the first point closes the curve.
  std::vector<Vector3> ring = points_along(shapes()[0], 30, 0, 1);
  std::swap(ring[7], ring[21]);
  ring.push_back(ring.front());
  const std::vector<Index> order = order_along_curve(ring, true);
  EXPECT_EQ(order.front(), 0);
  EXPECT_EQ(order.back(), 30);
  EXPECT_EQ(order[7], 21);
}

TEST(Order, TakesPointsOfAnySize) {
  for (const double size : {1e-310, 1e-200, 1e200, 8e307}) {
    std::vector<Vector3> points;
    for (const double x : {-2.0, 0.0, 2.0, 1.0, -1.0}) points.emplace_back(size * x, -size * x, 0);
    EXPECT_EQ(order_along_curve(points, false), (std::vector<Index>{0, 4, 1, 3, 2})) << size;
  }
  // One that is so far off that the others are at one place beside it.
  const std::vector<Vector3> apart = {{1e300, 0, 0}, {1, 0, 0}, {0, 0, 0}, {2, 0, 0}};
  EXPECT_TRUE(is_permutation(order_along_curve(apart, false), apart.size()));
}

TEST(Order, TakesFewPointsAndRefusesWhatIsNotFinite) {
  EXPECT_TRUE(order_along_curve({}, false).empty());
  for (int count = 1; count < 9; ++count) {
    for (const bool closed : {false, true}) {
      const std::vector<Vector3> points = cloud(count, 4);
      EXPECT_TRUE(is_permutation(order_along_curve(points, closed), points.size()));
    }
  }
  const std::vector<Vector3> points = {{0, 0, 0}, {1, 0, 0}, {NAN, 0, 0}};
  try {
    std::ignore = order_along_curve(points, false);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    EXPECT_EQ(std::string(error.what()).substr(0, 9), "point 2: ");
  }
}

/// The shortest way through few points, all of them tried.
double shortest(const std::vector<Vector3>& points, bool closed) {
  std::vector<Index> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  double least = length_of(points, order, closed);
  while (std::next_permutation(order.begin(), order.end())) least = std::min(least, length_of(points, order, closed));
  return least;
}

TEST(Order, IsNearTheShortestWayThroughAnyPoints) {
  int best = 0;
  constexpr unsigned clouds = 40;
  for (unsigned seed = 0; seed < clouds; ++seed) {
    const bool closed = seed % 2 == 1;
    const std::vector<Vector3> points = cloud(7, seed);
    const double least = shortest(points, closed);
    const double found = length_of(points, order_along_curve(points, closed), closed);
    EXPECT_LT(found, 1.2 * least) << seed;
    if (found < least * (1 + 1e-12)) ++best;
  }
  EXPECT_GT(best, 30);
}

TEST(Order, EndsOnPointsThatAreNoCurve) {
  std::vector<Vector3> grid;
  grid.reserve(2500);
  for (int k = 0; k < 2500; ++k) grid.emplace_back(k % 50, k / 50, 0);
  for (const std::vector<Vector3>& points : {grid, cloud(2500, 1)}) {
    const Shuffled shuffled(points);
    EXPECT_TRUE(is_permutation(order_along_curve(shuffled.places, false), points.size()));
  }
}

TEST(PointTree, FindsTheNearest) {
  std::vector<Vector3> points = cloud(300, 2);
  for (int k = 0; k < 100; ++k) points.emplace_back(k % 10, k / 10, 0);
  PointTree tree(points);
  std::vector<PointTree::Near> found;
  std::vector<Index> group(points.size());
  for (std::size_t k = 0; k < group.size(); ++k) group[k] = points[k].x() < 0.3 ? 1 : 2;
  tree.set_groups(group);
  for (Index point = 0; point < static_cast<Index>(points.size()); ++point) {
    std::vector<PointTree::Near> all;
    PointTree::Near of_others;
    for (Index other = 0; other < static_cast<Index>(points.size()); ++other) {
      const auto [a, b] = std::pair(static_cast<std::size_t>(point), static_cast<std::size_t>(other));
      const PointTree::Near near{(points[a] - points[b]).squaredNorm(), other};
      if (other != point) all.push_back(near);
      if (group[a] != group[b]) of_others = std::min(of_others, near);
    }
    std::sort(all.begin(), all.end());
    tree.nearest(point, 8, found);
    ASSERT_EQ(found.size(), 8U);
    for (std::size_t k = 0; k < found.size(); ++k) EXPECT_EQ(found[k].point, all[k].point);
    PointTree::Near best;
    tree.nearest_of_others(point, best);
    EXPECT_EQ(best.point, of_others.point);
  }
}

TEST(SpanningTree, IsTheShortest) {
  const std::vector<Vector3> points = cloud(400, 3);
  PointTree tree(points);
  double length = 0;
  for (const auto& [a, b] : spanning_tree(points, tree))
    length += (points[static_cast<std::size_t>(a)] - points[static_cast<std::size_t>(b)]).norm();
  // R. C. Prim (1957): the point nearest to those that are joined already, one after the other.
  std::vector<double> away(points.size(), INFINITY);
  double expected = 0;
  std::size_t last = 0;
  for (std::size_t joined = 1; joined < points.size(); ++joined) {
    away[last] = -1;
    std::size_t next = last;
    for (std::size_t k = 0; k < points.size(); ++k) {
      if (away[k] < 0) continue;
      away[k] = std::min(away[k], (points[k] - points[last]).norm());
      if (next == last || away[k] < away[next]) next = k;
    }
    expected += away[next];
    last = next;
  }
  EXPECT_NEAR(length, expected, 1e-9);
}

}  // namespace
}  // namespace vspring::order_test
