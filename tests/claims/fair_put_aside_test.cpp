// Single nodes that are put somewhere else along the surface.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_put_aside_test {
namespace {

using namespace support;

constexpr Index cells = 48;
constexpr double edge = 2.0 / cells;

struct Patch {
  PolygonMesh mesh;
  Constraints constraints;
  Index node = 0;  ///< that is held in its middle
};

/// The middle of a saddle z = xy, which moves; the rest is held.
Patch patch(generate::Faces faces, Index along = cells) {
  PolygonMesh mesh = generate::saddle({.columns = along, .rows = along, .faces = faces, .jitter = 0.2});
  Patch one{mesh, Constraints(mesh.node_count())};
  double least = std::numeric_limits<double>::infinity();
  for (Index i = 0; i < one.mesh.node_count(); ++i) {
    const double away = one.mesh.position(i).head<2>().norm();
    if (away > 0.6) one.constraints.fix_position(i, one.mesh.position(i));
    if (away < least) {
      least = away;
      one.node = i;
    }
  }
  return one;
}

Vector3 put_aside(const Patch& one, double edges, double up) {
  const Vector3 from = one.mesh.position(one.node);
  const double x = from.x() + edges * edge;
  return {x, from.y(), x * from.y() + up};
}

/// The greatest share of the way round a face that one of its edges has, and whether all faces look upwards.
struct Slender {
  double slenderness = 0;
  bool upwards = true;
};

Slender faces_of(const PolygonMesh& mesh, const std::vector<Vector3>& positions) {
  Slender result;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    double around = 0;
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector3& a = positions[static_cast<std::size_t>(face[k])];
      const Vector3& b = positions[static_cast<std::size_t>(face[(k + 1) % face.size()])];
      around += (b - a).norm();
      area += a.cross(b) / 2;
    }
    result.slenderness = std::max(result.slenderness, around * around / (4 * std::sqrt(3.0) * area.norm()));
    result.upwards = result.upwards && area.z() > 0;
  }
  return result;
}

TEST(FairPutAside, NodesAboutItGoAlong) {
  for (const auto faces : {generate::Faces::triangles, generate::Faces::quads, generate::Faces::mixed}) {
    SCOPED_TRACE(static_cast<int>(faces));
    Patch one = patch(faces);
    for (const double edges : {3.0, 6.0}) {
      for (const double up : {0.0, 0.05}) {
        one.constraints.fix_position(one.node, put_aside(one, edges, up));
        const FairResult result = fair(one.mesh, one.constraints);
        EXPECT_EQ(result.report.outcome, Outcome::converged);
        const Slender found = faces_of(one.mesh, result.positions);
        EXPECT_TRUE(found.upwards);
        EXPECT_LT(found.slenderness, 1.5 * faces_of(one.mesh, one.mesh.positions()).slenderness);
        EXPECT_EQ(result.positions[static_cast<std::size_t>(one.node)], one.constraints.position(one.node));
        if (up > 0) continue;
        double off = 0;
        for (const Vector3& p : result.positions) off = std::max(off, std::abs(p.z() - p.x() * p.y()));
        EXPECT_LT(off, 2e-3) << "the surface stays where it was";
      }
    }
  }
}

TEST(FairPutAside, WhatLeadsNowhereComesBackAsItWasAndNotFoldedAlong) {
  Patch one = patch(generate::Faces::triangles, 16);
  one.constraints.fix_position(one.node, put_aside(one, 16, 0));
  const FairResult result = fair(one.mesh, one.constraints);
  ASSERT_EQ(result.report.outcome, Outcome::worse_than_input) << "over what is held";
  std::vector<Vector3> expected = one.mesh.positions();
  expected[static_cast<std::size_t>(one.node)] = one.constraints.position(one.node);
  EXPECT_EQ(result.positions, expected);
}

TEST(FairPutAside, ADragThereIsFollowedAndEndsAsIfThereHadBeenNone) {
  const Patch start = patch(generate::Faces::triangles);
  for (const auto distribution : {Distribution::smooth, Distribution::keep}) {
    SCOPED_TRACE(static_cast<int>(distribution));
    Patch one = start;
    const FairOptions options{.method = equilibrium_alone(1e-6), .distribution = distribution};
    FairingSession session(one.mesh, options);
    one.constraints.fix_position(one.node, one.mesh.position(one.node));
    (void)session.fair(one.constraints);
    Context context;
    const double before = faces_of(one.mesh, one.mesh.positions()).slenderness;
    std::vector<Vector3> picture;
    for (int step = 1; step <= 24; ++step) {
      one.constraints.fix_position(one.node, put_aside(one, 0.25 * step, 0));
      const FairResult seen = session.update(one.constraints, 2e-4, context);
      picture = seen.positions;
      // With the shares as they came, noise and all, faces may turn over on the way.
      if (distribution == Distribution::keep) continue;
      EXPECT_EQ(seen.report.outcome, Outcome::converged) << step;
      const Slender found = faces_of(one.mesh, seen.positions);
      EXPECT_TRUE(found.upwards) << step;
      EXPECT_LT(found.slenderness, 3 * before) << step;
    }
    const FairResult last = session.fair(one.constraints);
    const FairResult anew = fair(one.mesh, one.constraints, options);
    EXPECT_EQ(last.report.outcome, Outcome::converged);
    const double error = *last.report.expected_error + *anew.report.expected_error;
    EXPECT_LT(greatest_distance(last.positions, anew.positions), 3 * error * diagonal(one.mesh));
    EXPECT_LT(greatest_distance(picture, anew.positions), 3 * 2e-4 * diagonal(one.mesh)) << "no jump";
  }
}

TEST(FairPutAside, TheResultGoesOnSmoothlyAsANodeIsPutFurther) {
  Patch one = patch(generate::Faces::triangles);
  const FairOptions options{.method = equilibrium_alone(1e-8)};
  std::vector<Vector3> before;
  for (int step = 18; step < 44; ++step) {
    const double edges = 0.05 * step;
    one.constraints.fix_position(one.node, put_aside(one, edges, 0));
    const FairResult result = fair(one.mesh, one.constraints, options);
    if (!before.empty()) EXPECT_LT(greatest_distance(result.positions, before), 4 * 0.05 * edge) << edges;
    before = result.positions;
  }
}

}  // namespace
}  // namespace vspring::fair_put_aside_test
