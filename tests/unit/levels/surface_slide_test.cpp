// Nodes that slide along a surface: where they end.

#include "levels/surface_slide.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "base/random.hpp"
#include "spring/model.hpp"
#include "support/specimens.hpp"
#include "support/surfaces.hpp"
#include "vspring/generate.hpp"

namespace vspring::surface_slide_test {
namespace {

TEST(Slide, StaysOnTheSphere) {
  ThreadTeam team(2);
  const PolygonMesh cap = generate::cap({.nodes = 4000, .half_angle = 70, .jitter = 0.3});
  Constraints constraints(cap.node_count());
  fix_boundary_positions(constraints, cap);
  for (Index i = 0; i < cap.node_count(); ++i) {
    if (constraints.position_fixed(i)) constraints.fix_normal(i, cap.position(i));
  }
  Net net = gather_net(cap, constraints);
  update_directions(net, *surface_model(PseudoNormals::link), team);
  const Vector3 centre = net.frame.to_local(Vector3::Zero());
  const double radius = net.frame.scale();
  std::vector<Vector3> steps;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Vector3 from = (net.positions[i] - centre) / radius;
    const Vector3 push(0.2 * (from.z() - 0.4), 0.1 * from.x() * (from.z() - 0.4), 0);
    steps.emplace_back(radius * (push - push.dot(from) * from));
  }
  const std::vector<Vector3> before = net.positions;
  slide(net, steps, team);
  for (std::size_t i = 0; i < net.moving; ++i) {
    EXPECT_NEAR((net.positions[i] - centre).norm(), radius, 1e-12);
    EXPECT_LT((net.positions[i] - before[i] - steps[i]).norm(), 0.02 * radius);
  }
}

TEST(Slide, AcrossUnevenRowsOfWideTriangles) {
  // The triangle that a place lies in is none of those around the node that is nearest to it.
  ThreadTeam team(1);
  Random random(3);
  const generate::Grid wide{.columns = 40, .rows = 30, .faces = generate::Faces::triangles};
  const PolygonMesh tube = generate::tube(wide, 1, 1);
  const auto on_sphere = [](double along, double angle) -> Vector3 {
    const double off_pole = 0.6 + 0.6 * along;
    return {std::sin(off_pole) * std::cos(angle), std::sin(off_pole) * std::sin(angle), std::cos(off_pole)};
  };
  std::vector<Vector3> places;
  for (const Vector3& p : tube.positions()) {
    const bool inside = p.z() > 0.5 / wide.rows && p.z() < 1 - 0.5 / wide.rows;
    const Vector3 off = inside ? random.in_ball() : Vector3::Zero();
    places.push_back(on_sphere(p.z() + 0.2 * off.x() / wide.rows,
                               std::atan2(p.y(), p.x()) + 0.2 * off.y() * 2 * std::numbers::pi / wide.columns));
  }
  const PolygonMesh band = support::with_positions(tube, std::move(places));
  Net net = gather_net(band, support::held_boundary(band, support::radial));
  update_directions(net, *surface_model(PseudoNormals::link), team);
  const Vector3 centre = net.frame.to_local(Vector3::Zero());
  const double row = 0.6 * net.frame.scale() / wide.rows;
  std::vector<Vector3> steps;
  std::vector<Vector3> wanted;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Vector3 from = (net.positions[i] - centre).normalized();
    const double along = (std::acos(from.z()) - 0.6) / 0.6;
    const double rows = 3 * std::sin(std::numbers::pi * along);
    const Vector3 to = on_sphere(along + rows / wide.rows, std::atan2(from.y(), from.x()));
    steps.push_back(net.frame.scale() * (to - to.dot(from) * from));
    wanted.push_back(centre + net.frame.scale() * to);
  }
  slide(net, steps, team);
  for (std::size_t i = 0; i < net.moving; ++i) EXPECT_LT((net.positions[i] - wanted[i]).norm(), 0.25 * row);
}

TEST(Slide, ToAnyPlaceInFacesOfEveryKind) {
  ThreadTeam team(2);
  Random random(5);
  for (const generate::Faces faces : support::every_kind) {
    SCOPED_TRACE(support::name_of(faces));
    const generate::Grid grid{.columns = 40, .rows = 40, .faces = faces, .jitter = 0.2};
    const PolygonMesh plane = generate::plane(grid, 1, 1);
    Net net = gather_net(plane, support::held_boundary(plane));
    update_directions(net, *surface_model(PseudoNormals::link), team);
    const double cell = net.frame.scale() / grid.columns;
    std::vector<Vector3> wanted;
    std::vector<Vector3> steps;
    for (std::size_t i = 0; i < net.moving; ++i) {
      // What lies behind held nodes is not known.
      const Vector3& at = plane.position(net.node[i]);
      const double room = std::min({at.x(), at.y(), 1 - at.x(), 1 - at.y()}) * grid.columns;
      const Vector3 way = random.in_ball();
      steps.push_back(room > 3 ? 2 * cell * Vector3(way.x(), way.y(), 0) : Vector3(Vector3::Zero()));
      wanted.push_back(net.positions[i] + steps.back());
    }
    slide(net, steps, team);
    for (std::size_t i = 0; i < net.moving; ++i) EXPECT_LT((net.positions[i] - wanted[i]).norm(), 0.03 * cell) << i;
  }
}

}  // namespace
}  // namespace vspring::surface_slide_test
