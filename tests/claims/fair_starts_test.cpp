// That fairing forgets where it began: one answer from a flat start, a noisy one, two bulged to either side and one
// folded over.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "support/methods.hpp"
#include "support/specimens.hpp"

namespace vspring::fair_starts_test {
namespace {

using namespace support;
using generate::Faces;

struct Start {
  std::string name;
  std::vector<Vector3> positions;
};

/// What the nodes without a fixed position may start from, about those that have one. up: bulges go there and back;
/// across: nodes beyond a plane normal to it are mirrored by it. Unit vectors.
std::vector<Start> five_starts(const std::vector<Vector3>& positions, const Constraints& constraints, const Vector3& up,
                               const Vector3& across) {
  std::vector<Vector3> held;
  Vector3 middle = Vector3::Zero();
  for (Index i = 0; i < constraints.node_count(); ++i) {
    if (constraints.position_fixed(i)) held.push_back(constraints.position(i));
  }
  for (const Vector3& p : held) middle += p / static_cast<double>(held.size());
  const double size = diagonal(held);
  const auto made = [&](const auto& place) {
    std::vector<Vector3> start = positions;
    for (Index i = 0; i < constraints.node_count(); ++i) {
      Vector3& p = start[static_cast<std::size_t>(i)];
      if (!constraints.position_fixed(i)) p = place(p);
    }
    return start;
  };
  const auto bulged = [&](double height) {
    return made([&](const Vector3& p) {
      double nearest = size;
      for (const Vector3& q : held) nearest = std::min(nearest, (p - q).norm());
      return Vector3(p + height * nearest * up);
    });
  };
  return {{"flat", made([&](const Vector3& p) { return Vector3(p - (p - middle).dot(up) * up); })},
          {"noisy", noisy(positions, constraints, 0.03 * size, 7, up.z() == 0)},
          {"bulged up", bulged(1)},
          {"bulged down", bulged(-1)},
          {"folded", made([&](const Vector3& p) {
             const double beyond = (p - middle).dot(across) - 0.05 * size;
             return Vector3(p - 2 * std::max(0.0, beyond) * across);
           })}};
}

struct Problem {
  std::string name;
  PolygonMesh mesh;
  Constraints constraints;
  /// Around rings: one folded over along a line across it has another equilibrium, see docs/notes/solver.md.
  Vector3 across = Vector3::UnitX();
};

std::vector<Problem> problems() {
  std::vector<Problem> all;
  const Normal up = [](const Vector3&) { return Vector3::UnitZ(); };
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    const std::string of = " of " + name_of(faces);
    const PolygonMesh cap = generate::sphere_patch({.columns = 16, .rows = 16, .faces = faces, .jitter = 0.3}, 1, 80);
    all.push_back({"cap" + of, cap, held_boundary(cap, radial)});
    all.push_back({"cap by positions" + of, cap, held_boundary(cap)});
    const Specimen funnel =
        on_chart("", funnel_chart, true, {.columns = 32, .rows = 8, .faces = faces}, {.jitter = 0.3}, up);
    all.push_back({"funnel" + of, funnel.start, funnel.constraints, Vector3::UnitZ()});
    all.push_back({"funnel by positions" + of, funnel.start, held_boundary(funnel.start), Vector3::UnitZ()});
    const Specimen region = region_of_saddle(faces, 20);
    all.push_back({region.name, region.start, region.constraints});
  }
  const PolygonMesh annulus = generate::annulus({.nodes = 400, .jitter = 0.3});
  all.push_back({"annulus", annulus, clamped_boundary(annulus)});
  all.push_back({"annulus by positions", annulus, held_boundary(annulus)});
  return all;
}

TEST(Starts, SurfacesForgetTheirs) {
  FairOptions options;
  options.method = equilibrium_alone();
  // Spacing, where it is kept, is that of the start.
  options.distribution = Distribution::even;
  for (const Problem& problem : problems()) {
    FairOptions exact = options;
    exact.method = equilibrium_alone(1e-12);
    // Where one start finds no equilibrium of sphere springs it is compared with that of edge springs.
    const FairResult truth = fair(problem.mesh, problem.constraints, exact);
    exact.springs = Springs::edge;
    const FairResult truth_of_edges = fair(problem.mesh, problem.constraints, exact);
    int by_edges = 0;
    const double size = diagonal(problem.mesh, problem.constraints);
    for (const Start& start :
         five_starts(problem.mesh.positions(), problem.constraints, Vector3::UnitZ(), problem.across)) {
      SCOPED_TRACE(problem.name + ", " + start.name);
      const FairResult result = fair(with_positions(problem.mesh, start.positions), problem.constraints, options);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      const bool of_edges = result.report.springs == Springs::edge;
      by_edges += of_edges ? 1 : 0;
      const FairResult& same = of_edges ? truth_of_edges : truth;
      const double error = greatest_distance(result.positions, same.positions) / size;
      EXPECT_LT(error, 3 * *result.report.expected_error);
    }
    EXPECT_LE(by_edges, 1) << problem.name;
  }
}

TEST(Starts, CurvesForgetTheirs) {
  const std::vector<Vector3> line = straight({0, 0, 0}, {1, 0, 0}, places(Spacing::even, 80));
  std::vector<std::pair<std::string, Constraints>> all;
  all.emplace_back("arc", held_ends(line, heading(60 * degree), heading(-60 * degree)));
  all.emplace_back("S", held_ends(line, heading(60 * degree), heading(60 * degree)));
  all.emplace_back("line by positions", held_ends(line));
  Constraints spline = held_ends(line, heading(0), heading(0));
  spline.fix_position(30, {0.4, 0.2, 0});
  all.emplace_back("spline", spline);
  for (const auto& [name, constraints] : all) {
    const std::vector<Vector3> truth = faired(line, constraints);
    for (const Start& start : five_starts(line, constraints, Vector3::UnitY(), Vector3::UnitX())) {
      SCOPED_TRACE(name + ", " + start.name);
      // Spacing, where it is kept, is that of the start.
      FairOptions even;
      even.distribution = Distribution::even;
      const FairResult result = fair(PolygonCurve(start.positions), constraints, even);
      EXPECT_EQ(result.report.outcome, Outcome::converged);
      const double error = greatest_distance(result.positions, truth);
      EXPECT_LT(error, 3 * *result.report.expected_error);
    }
  }
}

TEST(Starts, WhereTheSpacingOfTheInputLeadsNowhereAnEvenOneMay) {
  // A spike six times as high as the square that it stands on is wide; nearly flat is fair.
  const PolygonMesh plane = generate::plane({.columns = 32, .rows = 32});
  std::vector<Vector3> spike = plane.positions();
  for (Vector3& p : spike) p.z() = 6 * std::exp(-30 * (p - Vector3(0.5, 0.5, 0)).squaredNorm());
  const PolygonMesh mesh = with_positions(plane, spike);
  const FairResult result = fair(mesh, clamped_boundary(mesh));
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  ASSERT_FALSE(result.report.warnings.empty());
  EXPECT_EQ(result.report.warnings.back().code, WarningCode::other_distribution);
  double highest = 0;
  for (const Vector3& p : result.positions) highest = std::max(highest, std::abs(p.z()));
  EXPECT_LT(highest, 0.1);
  EXPECT_LT(result.report.work, result.report.most_work);
}

TEST(Starts, AnEarThatLeansOverIsBentLess) {
  // An ear that leans over, with noise.
  const PolygonMesh plane = generate::plane({.columns = 19, .rows = 19});
  std::vector<Vector3> ear = plane.positions();
  for (Vector3& p : ear) {
    const double height = 3 * std::exp(-18.75 * (p - Vector3(0.5, 0.5, 0)).squaredNorm());
    p += Vector3(2.6 / 3 * height * height, 0, height);
  }
  const PolygonMesh mesh = generate::add_noise(with_positions(plane, ear), 0.1, 5);
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  const FairResult result = fair(mesh, constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  ASSERT_FALSE(result.report.warnings.empty());
  EXPECT_LT(result.report.work, result.report.most_work);
  EXPECT_LT(measure_surface(with_positions(mesh, result.positions)).bending_energy,
            0.01 * measure_surface(mesh).bending_energy);
}

/// With a triangle more below and above every edge of the rims.
PolygonMesh with_teeth(const PolygonMesh& tube) {
  MeshBuilder builder;
  for (const Vector3& p : tube.positions()) builder.add_node(p);
  for (Index f = 0; f < tube.face_count(); ++f) builder.add_face(tube.face(f));
  for (const std::vector<Index>& loop : boundary_loops(tube)) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const Index a = loop[k];
      const Index b = loop[(k + 1) % loop.size()];
      const Vector3 middle = (tube.position(a) + tube.position(b)) / 2;
      const Index tip = builder.add_node(middle + Vector3(0, 0, middle.z() > 2 ? 0.3 : -0.3));
      builder.add_face(std::array{a, b, tip});
    }
  }
  return builder.take();
}

TEST(FairStarts, AttemptsMayHaveSeenOtherNodes) {
  // Sphere springs and less bending see the teeth; edge springs, which come between them, do not.
  const PolygonMesh mesh = with_teeth(generate::add_noise(generate::tube({.columns = 5, .rows = 10}, 1, 4), 0.1, 1));
  const Constraints held = clamped_boundary(mesh);
  const FairResult result = fair(mesh, held);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair_by, FairBy::bending);
  EXPECT_NE(result.positions, mesh.positions());
  for (Index i = 0; i < mesh.node_count(); ++i) {
    EXPECT_TRUE(!held.position_fixed(i) || result.positions[static_cast<std::size_t>(i)] == mesh.position(i)) << i;
  }
}

}  // namespace
}  // namespace vspring::fair_starts_test
