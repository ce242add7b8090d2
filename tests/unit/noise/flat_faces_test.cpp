// Faces that are flat up to sharp edges.

#include "noise/flat_faces.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <vector>

#include "base/random.hpp"
#include "noise/low_pass.hpp"
#include "support/surfaces.hpp"

namespace vspring::flat_faces_test {
namespace {

using namespace support;

struct Block {
  static constexpr int cells = 6;
  PolygonMesh mesh = generate::genus({.holes = 0, .cells = cells});
  Net net = gather_net(mesh, Constraints(mesh.node_count()));
  ScanMesh scan = scan_mesh(net, mesh);
  double edge = mean_edge(net);
  ThreadTeam team{1};
};

double greatest_distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double greatest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) greatest = std::max(greatest, (a[i] - b[i]).norm());
  return greatest;
}

TEST(FlatFaces, ABlockStaysAsItIs) {
  Block block;
  for (const auto& shape : with_flat_faces(block.scan, block.net.positions, std::array{6, 15}, block.team))
    EXPECT_LT(greatest_distance(shape, block.net.positions), 1e-3 * block.edge);
}

TEST(FlatFaces, NoiseGoesAndEdgesStaySharp) {
  Block block;
  Random random(1);
  std::vector<Vector3> noisy = block.net.positions;
  for (Vector3& p : noisy) p += 0.1 * block.edge * Vector3(random.normal(), random.normal(), random.normal());
  const auto off = [&](const std::vector<Vector3>& places) {
    Net net = block.net;
    net.positions = places;
    const Constraints none(block.mesh.node_count());
    return distance(scatter_positions(net, block.mesh.positions(), none, 1), block.mesh);
  };
  const auto flat = with_flat_faces(block.scan, noisy, std::array{10}, block.team);
  EXPECT_LT(off(flat[0]).rms, 0.4 * off(noisy).rms);
  const auto smooth = LowPass(std::array{Band{0.4, 4}}).filter(block.scan, noisy, block.team);
  EXPECT_LT(off(flat[0]).rms, 0.5 * off(smooth[0]).rms);
  EXPECT_LT(off(flat[0]).greatest, 0.7 * off(smooth[0]).greatest);
}

TEST(FlatFaces, HeldNodesStay) {
  const PolygonMesh mesh =
      generate::add_noise(generate::plane({.columns = 8, .rows = 8, .faces = generate::Faces::mixed}), 0.03, 1, true);
  const Net net = gather_net(mesh, held_boundary(mesh));
  ThreadTeam team(1);
  const auto flat = with_flat_faces(scan_mesh(net, mesh), net.positions, std::array{4}, team);
  for (std::size_t i = net.moving; i < net.positions.size(); ++i) EXPECT_EQ(flat[0][i], net.positions[i]);
}

}  // namespace
}  // namespace vspring::flat_faces_test
