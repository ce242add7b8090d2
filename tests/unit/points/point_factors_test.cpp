// What a length asks of points: of waves of angular frequency ω to keep 1/(1 + (λω)⁴), whatever the mesh.

#include "points/point_factors.hpp"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <memory>
#include <numeric>
#include <vector>

#include "points/point_ties.hpp"
#include "spring/bending_factor.hpp"
#include "support/specimens.hpp"

namespace vspring::point_factors_test {
namespace {

using namespace support;

/// The nodes of a mesh as its own points, pulled with these factors.
Net pulled(const PolygonMesh& mesh, const PointFactors& factors) {
  Net net = gather_net(mesh, held_boundary(mesh));
  std::vector<Index> own(mesh.positions().size());
  std::iota(own.begin(), own.end(), 0);
  const PointTies ties(net, mesh.positions(), std::vector<double>(own.size(), 1), own, factors);
  return net;
}

TEST(PointFactors, ByEdgesGoWithTheFourthPowerOfTheLength) {
  for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::quads}) {
    const PolygonMesh plane = generate::plane({.columns = 6, .rows = 6, .faces = faces, .jitter = 0.3});
    for (const double edges : {1.0, 2.0, 5.0}) {
      const auto length = std::make_shared<double>(0);
      *length = edges * mean_edge(pulled(plane, {}));
      const Net net = pulled(plane, pull_by_edges(length));
      for (std::size_t i = 0; i < net.moving; ++i)
        EXPECT_NEAR(net.points.factor(i), bending_factor(net) / (16 * std::pow(edges, 4)), 1e-15);
    }
  }
}

TEST(PointFactors, BySmoothingGoWithTheAreaThatANodeStandsFor) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(name_of(faces));
    const PolygonMesh plane = generate::plane({.columns = 6, .rows = 6, .faces = faces, .jitter = 0.2});
    const double length = 0.7;
    const Net net = pulled(plane, pull_by_smoothing(std::make_shared<double>(length), 0));
    std::vector<double> areas(plane.positions().size(), 0);
    for (Index f = 0; f < plane.face_count(); ++f) {
      const auto face = plane.face(f);
      Vector3 area = Vector3::Zero();
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        area +=
            (net.frame.to_local(plane.position(face[k])) - net.frame.to_local(plane.position(face[0])))
                .cross(net.frame.to_local(plane.position(face[k + 1])) - net.frame.to_local(plane.position(face[0])));
      for (const Index i : face)
        areas[static_cast<std::size_t>(i)] += area.norm() / (2 * static_cast<double>(face.size()));
    }
    double whole = 0;
    for (std::size_t i = 0; i < net.moving; ++i) whole += areas[static_cast<std::size_t>(net.node[i])];
    for (std::size_t i = 0; i < net.moving; ++i) {
      double squares = 0;
      double spokes = 0;
      for (const Link link : net.rings.links(i)) {
        if (!link.spoke()) continue;
        squares += (net.positions[link.node()] - net.positions[i]).squaredNorm();
        spokes += 1;
      }
      const double edge4 = std::pow(squares / spokes, 2);
      const double per_point = whole / static_cast<double>(net.moving);
      const double expected = per_point / areas[static_cast<std::size_t>(net.node[i])] * bending_factor(net) * edge4 /
                              (16 * std::pow(length, 4));
      EXPECT_NEAR(net.points.factor(i), expected, 1e-12 * expected) << i;
    }
  }
}

}  // namespace
}  // namespace vspring::point_factors_test
