// Normals between places where they are known.

#include "span/end_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace vspring::end_normals_test {
namespace {

constexpr std::size_t count = 41;

double angle_at(double x) { return 0.1 * x + 0.06 * x * x; }

Vector3 normal_at(double x) { return {0, std::cos(angle_at(x)), std::sin(angle_at(x))}; }

struct Line {
  std::vector<Vector3> places;
  std::vector<Vector3> tangents = std::vector<Vector3>(count, Vector3::UnitX());
  std::vector<Vector3> known = std::vector<Vector3>(count, Vector3::Zero());
  Line() {
    for (std::size_t k = 0; k < count; ++k) places.emplace_back(0.1 * static_cast<double>(k), 0, 0);
  }
};

TEST(EndNormals, TurnAboutTheEndAsACubic) {
  Line line;
  // In either sense.
  for (const std::size_t k : {std::size_t{0}, std::size_t{9}, std::size_t{25}, count - 1})
    line.known[k] = normal_at(line.places[k].x()) * (k == 9 ? -1 : 1);
  const std::vector<Vector3> normals = normals_along(line.places, line.tangents, line.known);
  ASSERT_EQ(normals.size(), count);
  // Slopes by parabolas are exact for one.
  for (std::size_t k = 0; k < count; ++k) EXPECT_LT((normals[k] - normal_at(line.places[k].x())).norm(), 1e-12) << k;
}

TEST(EndNormals, KeepTheirAngleBeyondTheLastKnownOneAndAreNoneWithoutAny) {
  Line line;
  EXPECT_TRUE(normals_along(line.places, line.tangents, line.known).empty());
  line.known[7] = normal_at(1);
  for (const Vector3& normal : normals_along(line.places, line.tangents, line.known))
    EXPECT_LT((normal - normal_at(1)).norm(), 1e-12);
}

}  // namespace
}  // namespace vspring::end_normals_test
