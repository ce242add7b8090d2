// Low passes of fields over the nodes of a surface.

#include "noise/low_pass.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "support/surfaces.hpp"

namespace vspring::low_pass_test {
namespace {

using namespace support;

constexpr Band bands[] = {{1.6, 4}, {0.4, 4}, {0.05, 4}, {0.009, 6}, {0.3, 2}};

TEST(LowPass, EigenvectorsOfTheMeanOverNeighboursKeepTheirResponse) {
  constexpr int columns = 24;
  constexpr int rows = 16;
  const PolygonMesh torus = generate::torus({.columns = columns, .rows = rows, .faces = generate::Faces::quads});
  const Net net = gather_net(torus, Constraints(torus.node_count()));
  const ScanMesh mesh = scan_mesh(net, torus);
  ThreadTeam team(1);
  const LowPass low_pass(bands);
  for (const auto& [across, along] : {std::pair(0, 0), {1, 0}, {0, 1}, {2, 3}, {6, 4}, {12, 0}, {12, 8}}) {
    SCOPED_TRACE(::testing::Message() << across << " " << along);
    const double a = 2 * std::numbers::pi * across / columns;
    const double b = 2 * std::numbers::pi * along / rows;
    std::vector<double> wave(mesh.nodes);
    for (std::size_t i = 0; i < wave.size(); ++i) {
      const Index row = net.node[i] / columns;
      wave[i] = std::cos(a * static_cast<double>(net.node[i] - row * columns) + b * static_cast<double>(row));
    }
    const auto filtered = low_pass.filter(mesh, wave, team);
    const double eigenvalue = 1 - (std::cos(a) + std::cos(b)) / 2;
    for (std::size_t k = 0; k < std::size(bands); ++k) {
      const double kept = 1 / (1 + std::pow(eigenvalue / bands[k].half, bands[k].order));
      for (std::size_t i = 0; i < wave.size(); ++i) EXPECT_NEAR(filtered[k][i], kept * wave[i], 1e-3) << k;
    }
  }
}

TEST(LowPass, WhatIsTheMeanOfItsNeighboursStaysWhereRimsHold) {
  const PolygonMesh plane = generate::plane({.columns = 12, .rows = 9, .faces = generate::Faces::quads});
  const Net net = gather_net(plane, held_boundary(plane));
  ThreadTeam team(1);
  const auto filtered = LowPass(bands).filter(scan_mesh(net, plane), net.positions, team);
  for (const std::vector<Vector3>& places : filtered) {
    for (std::size_t i = 0; i < places.size(); ++i) EXPECT_LT((places[i] - net.positions[i]).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace vspring::low_pass_test
