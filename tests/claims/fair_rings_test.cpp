// Rings of faces around an axis, with cells much wider than high or higher than wide: exact shapes stay what they are,
// and nothing folds. The mean of the neighbours would draw rows towards the axis.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "support/fairness_of.hpp"
#include "support/specimens.hpp"

namespace vspring::fair_rings_test {
namespace {

using namespace support;
using generate::Faces;

/// A profile that goes around the z axis: at 0 to 1 along it, the radius, the height and the normal (outwards, up).
struct Place {
  double radius;
  double height;
  double outwards;
  double up;
};
using Profile = std::function<Place(double along)>;

struct Rings {
  Faces faces = Faces::quads;
  int columns = 24;
  int rows = 16;
  double ratio = 1;  ///< of the longest row to the shortest
  double noise = 0;  ///< inside, in shortest edges
};

struct Lathe {
  PolygonMesh start;
  PolygonMesh exact;
  Constraints constraints;  ///< rims with their normals
};

Lathe lathe(const Profile& profile, const Rings& rings) {
  const PolygonMesh tube = generate::tube({.columns = rings.columns, .rows = rings.rows, .faces = rings.faces}, 1, 1);
  std::vector<Vector3> exact;
  std::vector<Vector3> normals;
  for (const Vector3& p : tube.positions()) {
    const Place place = profile(graded(p.z(), rings.ratio));
    const Vector3 outwards = Vector3(p.x(), p.y(), 0).normalized();
    exact.push_back(place.radius * outwards + Vector3(0, 0, place.height));
    normals.push_back((place.outwards * outwards + Vector3(0, 0, place.up)).normalized());
  }
  PolygonMesh mesh = with_positions(tube, exact);
  double shortest = 1;
  for (Index face = 0; face < mesh.face_count(); ++face) {
    const auto nodes = mesh.face(face);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      shortest = std::min(shortest, (mesh.position(nodes[k]) - mesh.position(nodes[(k + 1) % nodes.size()])).norm());
  }
  Constraints constraints = held_boundary(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (constraints.position_fixed(i)) constraints.fix_normal(i, normals[static_cast<std::size_t>(i)]);
  }
  return {generate::add_noise(mesh, rings.noise * shortest, 5), mesh, constraints};
}

/// Edges between faces that turn by more than 90°.
int folds(const PolygonMesh& mesh) {
  const auto normal = [&](Index face) {
    const auto nodes = mesh.face(face);
    Vector3 sum = Vector3::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k)
      sum += mesh.position(nodes[k]).cross(mesh.position(nodes[(k + 1) % nodes.size()]));
    return sum;
  };
  std::vector<std::pair<std::pair<Index, Index>, Index>> sides;
  for (Index face = 0; face < mesh.face_count(); ++face) {
    const auto nodes = mesh.face(face);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      sides.push_back({std::minmax(nodes[k], nodes[(k + 1) % nodes.size()]), face});
  }
  std::sort(sides.begin(), sides.end());
  int count = 0;
  for (std::size_t k = 1; k < sides.size(); ++k) {
    if (sides[k].first == sides[k - 1].first && normal(sides[k].second).dot(normal(sides[k - 1].second)) < 0) ++count;
  }
  return count;
}

Profile band(double from, double to) {
  return [=](double along) -> Place {
    const double angle = from + (to - from) * along;
    return {std::sin(angle), std::cos(angle), std::sin(angle), std::cos(angle)};
  };
}

Profile cylinder(double height) {
  return [=](double along) -> Place { return {1, height * along, 1, 0}; };
}

Profile flat(double inner) {
  return [=](double along) -> Place { return {inner + (1.5 - inner) * along, 0, 0, 1}; };
}

Place cone(double along) { return {0.3 + 0.7 * along, 1.5 * along, 1.5, -0.7}; }
Place bell(double along) { return {0.3 + 0.7 * along * along, 1 - along, 1, 1.4 * along}; }
Place vase(double along) {
  const double angle = 2 * std::numbers::pi * along;
  return {0.6 + 0.3 * std::sin(angle), 2 * along, 2, -0.6 * std::numbers::pi * std::cos(angle)};
}

FairResult faired(const Lathe& one) {
  FairResult result = fair(one.start, one.constraints);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(folds(with_positions(one.start, result.positions)), 0);
  EXPECT_LE(result.report.work, result.report.most_work);
  return result;
}

struct Case {
  std::string name;
  Profile profile;
  Rings rings;
  std::function<double(const Vector3&)> off;
  double most_off;
};

std::vector<Case> exact_surfaces() {
  const auto off_sphere = [](const Vector3& p) { return std::abs(p.norm() - 1); };
  const auto off_plane = [](const Vector3& p) { return std::abs(p.z()); };
  const auto off_cylinder = [](const Vector3& p) { return std::abs(p.head<2>().norm() - 1); };
  // Spheres and planes to the solver's tolerance; springs see how wide cells are on cylinders.
  return {
      {"band", band(0.6, 1.2), {.columns = 32, .rows = 16}, off_sphere, 2e-5},
      {"band, cells of 12 : 1", band(0.6, 1.2), {.columns = 24, .rows = 30}, off_sphere, 2e-5},
      {"band, cells of 1 : 2", band(0.6, 1.2), {.columns = 64, .rows = 6}, off_sphere, 2e-5},
      {"wide band", band(0.6, 2.4), {.columns = 32, .rows = 16}, off_sphere, 2e-5},
      {"annulus", flat(0.5), {.columns = 32, .rows = 16}, off_plane, 2e-5},
      {"annulus with a small hole", flat(0.2), {.columns = 24, .rows = 24}, off_plane, 3e-5},
      {"graded annulus", flat(0.2), {.columns = 48, .rows = 8, .ratio = 10}, off_plane, 2e-5},
      {"cylinder, cells of 1 : 10", cylinder(3), {.columns = 64, .rows = 3}, off_cylinder, 5e-3},
      {"cylinder, cells of 10 : 1", cylinder(0.4), {.columns = 16, .rows = 10}, off_cylinder, 5e-3},
      {"graded cylinder", cylinder(2), {.columns = 24, .rows = 24, .ratio = 10}, off_cylinder, 5e-3},
  };
}

TEST(FairRings, ExactSurfacesStayOrComeBack) {
  for (const Faces faces : {Faces::quads, Faces::triangles}) {
    for (const double noise : {0.0, 1.0}) {
      for (Case one : exact_surfaces()) {
        SCOPED_TRACE(fmt::format("{} of {}, noise {}", one.name, name_of(faces), noise));
        one.rings.faces = faces;
        one.rings.noise = noise;
        double greatest = 0;
        for (const Vector3& p : faired(lathe(one.profile, one.rings)).positions)
          greatest = std::max(greatest, one.off(p));
        EXPECT_LT(greatest, one.most_off);
      }
    }
  }
}

TEST(FairRings, ShapesOfALatheDoNotFold) {
  for (const Faces faces : {Faces::quads, Faces::triangles, Faces::mixed}) {
    for (const double noise : {0.0, 0.5}) {
      for (const auto& [name, profile] :
           {std::pair<const char*, Profile>("cone", cone), {"bell", bell}, {"vase", vase}}) {
        SCOPED_TRACE(fmt::format("{} of {}, noise {}", name, name_of(faces), noise));
        const Lathe one = lathe(profile, {.faces = faces, .columns = 24, .rows = 16, .noise = noise});
        const FairResult result = faired(one);
        if (noise == 0) continue;
        const auto [before, after] = fairness_of(one.start, one.constraints, result.positions);
        EXPECT_LT(after.vspring_energy, before.vspring_energy / 10);
      }
    }
  }
}

TEST(FairRings, SphereSpringsTakeWideCells) {
  // Lifted off by a tenth of the radius in the middle, so that rows have far to go from level to level.
  for (const Faces faces : {Faces::quads, Faces::triangles}) {
    for (const auto& [columns, rows] : {std::pair(48, 32), std::pair(72, 48)}) {
      SCOPED_TRACE(fmt::format("{} x {} {}", columns, rows, name_of(faces)));
      Lathe one = lathe(band(0.6, 1.2), {.faces = faces, .columns = columns, .rows = rows});
      std::vector<Vector3> lifted = one.start.positions();
      for (Vector3& p : lifted) p *= 1 + 0.1 * std::sin(std::numbers::pi * (std::acos(p.z()) - 0.6) / 0.6);
      one.start = with_positions(one.start, std::move(lifted));
      const FairResult result = faired(one);
      EXPECT_EQ(result.report.springs, Springs::sphere);
      EXPECT_LT(result.report.iterations, 60);
      for (const Vector3& p : result.positions) EXPECT_NEAR(p.norm(), 1, 2e-5);
    }
  }
}

TEST(FairRings, AFairShapeWhoseNodesFindNoSpacingIsBentAsLittleAsBefore) {
  // Bricks that are bent along a row by more than they are high: nodes have nowhere to slide to.
  const Lathe one = lathe(band(1.4, 1.7), {.faces = Faces::hexagons, .columns = 16, .rows = 16, .ratio = 2});
  const FairResult result = faired(one);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.fair_by, FairBy::bending);
  // Edges along a row bulge by 0.019.
  EXPECT_LT(greatest_distance(result.positions, one.start.positions()), 3e-4);
  // But not where it is not fair.
  Lathe lifted = one;
  std::vector<Vector3> places = one.start.positions();
  for (Vector3& p : places) p *= 1 + 0.01 * std::sin(std::numbers::pi * (std::acos(p.z()) - 1.4) / 0.3);
  lifted.start = with_positions(one.start, std::move(places));
  EXPECT_NE(fair(lifted.start, lifted.constraints).positions, lifted.start.positions());
}

TEST(FairRings, SpringsAlongRimsThatAreFreeToTurnCount) {
  // Edge springs find a thinner tube whose own springs agree, but those along the rims by much less than they did: that
  // is not taken.
  const PolygonMesh straight = generate::tube({.columns = 16, .rows = 28, .faces = Faces::quads}, 0.35, 1);
  std::vector<Vector3> places;
  for (const Vector3& p : straight.positions()) {
    const double turn = p.z() * 210 / 180 * std::numbers::pi;
    places.emplace_back((1 + p.x()) * std::cos(turn), (1 + p.x()) * std::sin(turn), p.y());
  }
  const PolygonMesh bent = with_positions(straight, std::move(places));
  const FairResult result = fair(bent, held_boundary(bent));
  EXPECT_EQ(result.report.fair_by, FairBy::bending);
  EXPECT_LE(measure_surface(with_positions(bent, result.positions)).bending_energy,
            measure_surface(bent).bending_energy);
}

TEST(FairRings, AnEvenDistributionWouldFoldThem) {
  // That is what it is for.
  const Lathe one = lathe(flat(0.5), {.columns = 32, .rows = 16});
  FairOptions even;
  even.distribution = Distribution::even;
  even.accept_worse = true;
  const FairResult result = fair(one.start, one.constraints, even);
  EXPECT_EQ(result.report.outcome, Outcome::worse_than_input);
  EXPECT_GT(folds(with_positions(one.start, result.positions)), 0);
  // Unless it is wanted as found, the input is better.
  even.accept_worse = false;
  const FairResult sane = fair(one.start, one.constraints, even);
  EXPECT_EQ(folds(with_positions(one.start, sane.positions)), 0);
}

TEST(FairRings, CancelledWhileTheyAreCheckedTheyAreNotFoldedEither) {
  const Lathe one = lathe(flat(0.5), {.columns = 32, .rows = 16});
  for (const Springs springs : {Springs::edge, Springs::sphere}) {
    FairOptions even{.springs = springs};
    even.distribution = Distribution::even;
    Context context;
    context.on_progress = [&](const Progress& progress) {
      if (progress.stage == "checking") context.cancel();
    };
    const FairResult result = fair(one.start, one.constraints, even, context);
    EXPECT_EQ(result.report.outcome, Outcome::cancelled);
    EXPECT_EQ(folds(with_positions(one.start, result.positions)), 0);
  }
}

}  // namespace
}  // namespace vspring::fair_rings_test
