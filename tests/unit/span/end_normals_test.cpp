// Normals between places where they are known.

#include "span/end_normals.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
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
  std::vector<Vector3> about = known;
  Line() {
    for (std::size_t k = 0; k < count; ++k) places.emplace_back(0.1 * static_cast<double>(k), 0, 0);
  }
};

TEST(EndNormals, TurnAboutTheEndAsACubic) {
  Line line;
  // In either sense.
  for (const std::size_t k : {std::size_t{0}, std::size_t{9}, std::size_t{25}, count - 1})
    line.known[k] = normal_at(line.places[k].x()) * (k == 9 ? -1 : 1);
  const std::vector<Vector3> normals = normals_along(line.places, line.tangents, line.known, line.about);
  ASSERT_EQ(normals.size(), count);
  // Slopes by parabolas are exact for one.
  for (std::size_t k = 0; k < count; ++k) EXPECT_LT((normals[k] - normal_at(line.places[k].x())).norm(), 1e-12) << k;
}

TEST(EndNormals, KeepTheirAngleBeyondTheLastKnownOneAndAreNoneWithoutAny) {
  Line line;
  EXPECT_TRUE(normals_along(line.places, line.tangents, line.known, line.about).empty());
  line.known[7] = normal_at(1);
  for (const Vector3& normal : normals_along(line.places, line.tangents, line.known, line.about))
    EXPECT_LT((normal - normal_at(1)).norm(), 1e-12);
}

TEST(EndNormals, TurnAsFarAsTheSurfaceDoes) {
  // One and a half times around between two known ones, in either sense.
  Line line;
  const auto turned = [](double angle) { return Vector3(0, std::cos(angle), std::sin(angle)); };
  const double per_node = 3 * std::numbers::pi / (count - 1);
  line.known.front() = turned(0);
  line.known.back() = -turned(per_node * (count - 1));
  for (std::size_t k = 0; k < count; ++k)
    line.about[k] = turned(per_node * static_cast<double>(k) + 0.4 * std::sin(3.0 * static_cast<double>(k)));
  const std::vector<Vector3> normals = normals_along(line.places, line.tangents, line.known, line.about);
  for (std::size_t k = 0; k < count; ++k)
    EXPECT_NEAR(std::abs(normals[k].dot(turned(per_node * static_cast<double>(k)))), 1, 1e-9) << k;
}

}  // namespace
}  // namespace vspring::end_normals_test
