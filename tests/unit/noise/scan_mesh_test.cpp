// The part of a surface that moves.

#include "noise/scan_mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "support/surfaces.hpp"

namespace vspring::scan_mesh_test {
namespace {

using namespace support;

bool contains(std::span<const std::uint32_t> list, std::size_t item) {
  return std::find(list.begin(), list.end(), item) != list.end();
}

TEST(ScanMesh, SaysWhoTouchesWhom) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(static_cast<int>(faces));
    const PolygonMesh mesh = generate::plane({.columns = 8, .rows = 8, .faces = faces});
    const Net net = gather_net(mesh, held_boundary(mesh));
    const ScanMesh scan = scan_mesh(net, mesh);
    ASSERT_EQ(scan.moving, net.moving);
    for (std::size_t i = 0; i < scan.moving; ++i) {
      std::set<std::size_t> neighbours;
      for (std::size_t f = 0; f < scan.faces.size(); ++f) {
        const auto face = scan.faces.of(f);
        const auto at = std::find(face.begin(), face.end(), i);
        EXPECT_EQ(at != face.end(), contains(scan.faces_of.of(i), f));
        if (at == face.end()) continue;
        const auto k = static_cast<std::size_t>(at - face.begin());
        neighbours.insert({face[(k + 1) % face.size()], face[(k + face.size() - 1) % face.size()]});
        for (const std::uint32_t g : scan.faces_of.of(i)) EXPECT_TRUE(contains(scan.around.of(f), g));
      }
      EXPECT_TRUE(std::ranges::equal(scan.neighbours.of(i), neighbours));
      std::erase_if(neighbours, [&](std::size_t j) { return j >= scan.moving; });
      EXPECT_TRUE(std::ranges::equal(scan.moving_neighbours.of(i), neighbours));
    }
  }
}

TEST(ScanMesh, AreasAndNormals) {
  ThreadTeam team(1);
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh mesh = generate::plane({.columns = 8, .rows = 8, .faces = faces, .jitter = 0.3});
    const Net net = gather_net(mesh, held_boundary(mesh));
    const ScanMesh scan = scan_mesh(net, mesh);
    const std::vector<Vector3> areas = face_areas(scan, net.positions, team);
    ASSERT_EQ(areas.size(), scan.faces.size());
    for (std::size_t f = 0; f < areas.size(); ++f) {
      const auto face = scan.faces.of(f);
      double area = 0;
      for (std::size_t k = 0; k < face.size(); ++k) {
        const Vector3& a = net.positions[face[k]];
        const Vector3& b = net.positions[face[(k + 1) % face.size()]];
        area += (a.x() * b.y() - a.y() * b.x()) / 2;
      }
      EXPECT_LT((areas[f] - Vector3(0, 0, area)).norm(), 1e-12);
    }
    for (const Vector3& normal : node_normals(scan, net.positions, team))
      EXPECT_LT((normal - Vector3::UnitZ()).norm(), 1e-12);
  }
}

}  // namespace
}  // namespace vspring::scan_mesh_test
