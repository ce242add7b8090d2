// How far shapes are expected to be from the true one, and what is chosen by that.

#include "noise/risk.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "noise/low_pass.hpp"
#include "support/surfaces.hpp"

namespace vspring::risk_test {
namespace {

using namespace support;

struct Torus {
  static constexpr int columns = 64;
  static constexpr int rows = 48;
  PolygonMesh mesh = generate::torus({.columns = columns, .rows = rows, .faces = generate::Faces::quads}, 1, 0.5);
  Net net = gather_net(mesh, Constraints(mesh.node_count()));
  ScanMesh scan = scan_mesh(net, mesh);
  ThreadTeam team{1};

  /// The mean diagonal of a low pass: all nodes' is the same, as neighbours are those of a closed grid.
  static double followed(const Band& band) {
    double sum = 0;
    for (int a = 0; a < columns; ++a) {
      for (int b = 0; b < rows; ++b) {
        const double e =
            1 - (std::cos(2 * std::numbers::pi * a / columns) + std::cos(2 * std::numbers::pi * b / rows)) / 2;
        sum += 1 / (1 + std::pow(e / band.half, band.order));
      }
    }
    return sum / (columns * rows);
  }
};

TEST(Risk, IsTheSquareOfTheDistanceFromTheTrueShapeAndAConstant) {
  Torus torus;
  const Places& exact = torus.net.positions;
  const std::vector<Vector3> normals = node_normals(torus.scan, exact, torus.team);
  constexpr double deviation = 0.02;
  Random random(3);
  Places noisy = exact;
  for (std::size_t i = 0; i < noisy.size(); ++i) noisy[i] += deviation * random.normal() * normals[i];
  const std::array bands = {Band{1.6, 4}, Band{0.4, 4}, Band{0.05, 4}, Band{0.01, 4}};
  const auto shapes = LowPass(bands).filter(torus.scan, noisy, torus.team);
  std::vector<const Places*> pointers = {&noisy};
  for (const Places& shape : shapes) pointers.push_back(&shape);
  std::vector<double> of_node = {1};
  for (const Band& band : bands) of_node.push_back(Torus::followed(band));
  std::vector<double> followed;
  for (std::size_t i = 0; i < torus.scan.moving; ++i) followed.insert(followed.end(), of_node.begin(), of_node.end());
  const Risks risks = risks_of(torus.scan, pointers, noisy, normals, followed, deviation, torus.team);
  // Of 3,072 nodes the mean square of the noise itself is known to 2.6 %.
  const double noise2 = deviation * deviation;
  for (std::size_t k = 0; k < pointers.size(); ++k) {
    double squares = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const double off = ((*pointers[k])[i] - exact[i]).dot(normals[i]);
      squares += off * off / static_cast<double>(exact.size());
    }
    EXPECT_NEAR(risks.means[k] - noise2, squares, 0.06 * noise2) << k;
  }
}

TEST(Risk, ShapesCountByTheirRisks) {
  Torus torus;
  const Places a(torus.scan.nodes, Vector3::Zero());
  const Places b(torus.scan.nodes, Vector3::UnitX());
  constexpr double deviation = 0.5;
  Risks risks{.shapes = 2, .values = std::vector<double>(2 * torus.scan.moving, 0.1), .means = {0.1, 0.1}};
  const std::size_t node = 70;
  risks.values[2 * node + 1] = 0.4;
  constexpr double weight = 3;
  const std::array choices = {Choice{0, 0, weight}, Choice{1, 0, weight}};
  const auto results = choose(torus.scan, {&a, &b}, risks, choices, deviation, torus.team);
  const auto share = [&](double more) { return 1 / (1 + std::exp(weight * more / (deviation * deviation))); };
  EXPECT_NEAR(results[0][node].x(), share(0.3), 1e-12);
  EXPECT_NEAR(results[1][node].x(), share(0.15), 1e-12);
  const auto neighbours = torus.scan.neighbours.of(node);
  ASSERT_EQ(neighbours.size(), 4U);
  for (const std::uint32_t j : neighbours) {
    EXPECT_NEAR(results[0][j].x(), 0.5, 1e-12);
    EXPECT_NEAR(results[1][j].x(), share(0.3 / 8), 1e-12);
  }
}

}  // namespace
}  // namespace vspring::risk_test
