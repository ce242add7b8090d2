// A noisy surface without its noise.

#include "noise/denoise.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/surfaces.hpp"

namespace vspring::denoise_test {
namespace {

using namespace support;

struct Scan {
  explicit Scan(const PolygonMesh& mesh) : net(gather_net(mesh, held_boundary(mesh))), scan(scan_mesh(net, mesh)) {}

  Places smoothed(double deviation, const std::vector<std::uint8_t>& known = {}) {
    ThreadTeam team(1);
    return without_noise(
        scan, net.positions, known, deviation, [] { return false; }, team);
  }

  Net net;
  ScanMesh scan;
};

double greatest_move(const Places& a, const Places& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
  return greatest;
}

TEST(Denoise, APlaneOfEvenCellsStaysWhateverNoiseItIsSaidToHave) {
  Scan plane(generate::plane({.columns = 12, .rows = 9, .faces = generate::Faces::quads}));
  for (const double deviation : {1e-12, 0.01, 1e6})
    EXPECT_LT(greatest_move(plane.smoothed(deviation), plane.net.positions), 1e-9) << deviation;
}

TEST(Denoise, NoiseFarLessThanThatOfTheNodesMovesNothingAndFarMoreLeavesAShape) {
  Scan noisy(generate::add_noise(generate::saddle({.columns = 12, .rows = 12}), 0.05, 1));
  EXPECT_LT(greatest_move(noisy.smoothed(1e-12), noisy.net.positions), 1e-4);
  const Places smooth = noisy.smoothed(1e6);
  for (std::size_t i = 0; i < smooth.size(); ++i) {
    EXPECT_TRUE(smooth[i].allFinite());
    EXPECT_LT(smooth[i].norm(), 1);
    if (i >= noisy.net.moving) {
      EXPECT_EQ(smooth[i], noisy.net.positions[i]);
    }
  }
}

TEST(Denoise, AThinPlateIsNotTurnedInsideOut) {
  // Its sides are nearer than the noise that it is said to have: low passes take its rim through itself.
  PolygonMesh plate = generate::genus({.holes = 0, .cells = 8});
  std::vector<Vector3> positions = plate.positions();
  for (Vector3& p : positions) p.z() *= 0.01;
  plate.set_positions(positions);
  Scan scan(plate);
  const Places smooth = scan.smoothed(0.05);
  EXPECT_GT(greatest_move(smooth, scan.net.positions), 0.001);
  for (std::size_t i = 0; i < smooth.size(); ++i) positions[static_cast<std::size_t>(scan.net.node[i])] = smooth[i];
  PolygonMesh after = plate;
  after.set_positions(positions);
  EXPECT_LE(measure(after).greatest_turn, measure(plate).greatest_turn + 0.01);
}

TEST(Denoise, WhatIsNotKnownIsTakenFromItsNeighbours) {
  Scan plane(generate::plane({.columns = 16, .rows = 16}));
  std::vector<std::uint8_t> known(plane.net.moving, 1);
  const std::size_t node = plane.net.moving / 2;
  known[node] = 0;
  plane.net.positions[node].z() += 0.7;
  EXPECT_LT(std::abs(plane.smoothed(0.005, known)[node].z()), 1e-3);
  EXPECT_GT(std::abs(plane.smoothed(0.005)[node].z()), 0.1);
}

}  // namespace
}  // namespace vspring::denoise_test
