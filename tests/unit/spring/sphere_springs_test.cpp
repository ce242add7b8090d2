// Sphere springs: exact on spheres whatever the mesh, half the mean curvature elsewhere, and a force that takes bumps
// away.

#include "spring/sphere_springs.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "spring/link_edges.hpp"
#include "spring/model.hpp"
#include "support/specimens.hpp"

namespace vspring::sphere_springs_test {
namespace {

using namespace support;

struct Sprung {
  Net net;
  double greatest_force = 0;
};

Sprung sprung(const PolygonMesh& mesh, const Constraints& constraints, FairBy fair_by = FairBy::curvature) {
  ThreadTeam team(1);
  Sprung result{gather_net(mesh, constraints, true)};
  if (fair_by == FairBy::bending) use_least_bending(result.net);
  update_directions(result.net, *surface_model(PseudoNormals::link), team);
  for (std::size_t i = 0; i < result.net.moving; ++i)
    result.greatest_force = std::max(result.greatest_force, std::abs(sphere_force(result.net, i)));
  return result;
}

TEST(SphereSprings, AreExactOnSpheresOfEveryKindOfFace) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(name_of(faces));
    const PolygonMesh patch =
        generate::sphere_patch({.columns = 12, .rows = 12, .faces = faces, .jitter = 0.4}, 2, 100);
    const Sprung at = sprung(patch, held_boundary(patch, radial));
    for (std::size_t i = 0; i < at.net.computed; ++i) {
      ASSERT_FALSE(std::isnan(at.net.spheres.curvatures[i])) << i;
      const double half = at.net.spheres.curvatures[i] * at.net.frame.scale();
      EXPECT_NEAR(std::abs(half), 0.25, 1e-10) << i;
    }
    EXPECT_LT(at.greatest_force, 1e-12);
  }
}

TEST(SphereSprings, AreExactOnASphereWhereANodeHasManyNeighbours) {
  constexpr int around = 40;
  MeshBuilder builder;
  const auto add = [&](double polar, double turn) {
    builder.add_node(2 * Vector3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn), std::cos(polar)));
  };
  add(0, 0);
  for (const double polar : {0.3, 0.4}) {
    for (int k = 0; k < around; ++k) add(polar * (1 + 0.1 * (k % 3)), 2 * std::numbers::pi * k / around);
  }
  for (int k = 1; k <= around; ++k) {
    const int next = k % around + 1;
    builder.add_face({0, k, next});
    builder.add_face({k, k + around, next + around, next});
  }
  const PolygonMesh mesh = builder.take();
  const Sprung at = sprung(mesh, held_boundary(mesh, radial));
  for (std::size_t i = 0; i < at.net.computed; ++i)
    EXPECT_NEAR(std::abs(at.net.spheres.curvatures[i] * at.net.frame.scale()), 0.25, 1e-10) << i;
  EXPECT_LT(at.greatest_force, 1e-12);
}

TEST(SphereSprings, GiveEveryNodeItsShareOfItsFaces) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(name_of(faces));
    const PolygonMesh plane = generate::plane({.columns = 6, .rows = 6, .faces = faces, .jitter = 0.2});
    std::vector<double> areas(plane.positions().size(), 0);
    for (Index f = 0; f < plane.face_count(); ++f) {
      const auto face = plane.face(f);
      Vector3 area = Vector3::Zero();
      for (std::size_t k = 1; k + 1 < face.size(); ++k)
        area += (plane.position(face[k]) - plane.position(face[0]))
                    .cross(plane.position(face[k + 1]) - plane.position(face[0])) /
                2;
      for (const Index i : face) areas[static_cast<std::size_t>(i)] += area.norm() / static_cast<double>(face.size());
    }
    const Net net = sprung(plane, held_boundary(plane)).net;
    for (std::size_t i = 0; i < net.moving; ++i) {
      const double scale = net.frame.scale() * net.frame.scale();
      EXPECT_NEAR(net.spheres.areas[i] / scale, areas[static_cast<std::size_t>(net.node[i])], 1e-14) << i;
      EXPECT_GE(spread_of_row(net, i, LinkEdges(net, i)).sum, 2 * net.spheres.areas[i]);
    }
  }
}

/// The root mean square error of half the mean curvature at nodes inside a surface z = x³/5 whose normal there is
/// given.
double error_of_given(int cells) {
  PolygonMesh patch = generate::plane({.columns = cells, .rows = cells, .jitter = 0.3});
  std::vector<Vector3> positions = patch.positions();
  for (Vector3& p : positions) p.z() = std::pow(p.x(), 3) / 5;
  patch.set_positions(std::move(positions));
  double squares = 0;
  double count = 0;
  for (Index i = 0; i < patch.node_count(); i += cells / 8) {
    Constraints held = held_boundary(patch);
    if (held.position_fixed(i)) continue;
    if ((patch.position(i) - Vector3(0.5, 0.5, 0)).head<2>().lpNorm<Eigen::Infinity>() > 0.3) continue;
    const double x = patch.position(i).x();
    const double slope = 0.6 * x * x;
    held.fix_normal(i, {-slope, 0, 1});
    const Net net = sprung(patch, held).net;
    for (std::size_t k = 0; k < net.moving; ++k) {
      if (net.node[k] != i) continue;
      const double half = net.spheres.curvatures[k] * net.frame.scale();
      squares += std::pow(half - 0.3 * x / std::pow(1 + slope * slope, 1.5), 2);
      count += 1;
    }
  }
  return std::sqrt(squares / count);
}

TEST(SphereSprings, OfGivenNormalsGetExactSoonerBesideComputedOnes) {
  // By heights over their own tangent plane alone errors would fall with the spacing.
  EXPECT_GT(std::log(error_of_given(8) / error_of_given(32)) / std::log(4), 1.1);
}

TEST(SphereSprings, AreHalfTheMeanCurvatureOnACylinder) {
  for (const generate::Faces faces : every_kind) {
    SCOPED_TRACE(name_of(faces));
    const auto error = [&](int cells) {
      const PolygonMesh patch =
          generate::cylinder_patch({.columns = cells, .rows = cells, .faces = faces, .jitter = 0.2}, 1, 90, 1.5);
      const Sprung at = sprung(patch, held_boundary(patch));
      double greatest = 0;
      for (std::size_t i = 0; i < at.net.moving; ++i)
        greatest = std::max(greatest, std::abs(std::abs(at.net.spheres.curvatures[i] * at.net.frame.scale()) - 0.25));
      return greatest;
    };
    EXPECT_LT(error(12), 0.01);
    EXPECT_LT(error(24), 0.6 * error(12));
  }
}

TEST(SphereSprings, AreOfSecondOrderAtRimsWithoutNormals) {
  for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::quads, generate::Faces::hexagons}) {
    SCOPED_TRACE(name_of(faces));
    const auto error = [&](int cells) {
      // Some 2 long, so that cells are about as long as wide. Nothing bends it along the rim's normal plane.
      const PolygonMesh tube = generate::tube({.columns = 3 * cells, .rows = cells, .faces = faces}, 1, 2);
      const Sprung at = sprung(tube, held_boundary(tube));
      double greatest = 0;
      for (std::size_t i = at.net.moving; i < at.net.computed; ++i)
        greatest = std::max(greatest, std::abs(std::abs(at.net.spheres.curvatures[i] * at.net.frame.scale()) - 0.25));
      EXPECT_GT(at.net.computed, at.net.moving);
      return greatest;
    };
    EXPECT_LT(error(12), 0.01);
    EXPECT_LT(error(24), 0.35 * error(12) + 1e-12);
  }
}

TEST(SphereSprings, DoNotKnowTheCurvatureWhereRimsMeetAtANode) {
  // Two squares of four triangles each, with one corner in common, which is held without a normal.
  const PolygonMesh joined(
      {{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}, {1, 1, 0.1}, {-2, 0, 0}, {-2, -2, 0}, {0, -2, 0}, {-1, -1, 0.1}},
      {0, 3, 6, 9, 12, 15, 18, 21, 24}, {0, 1, 4, 1, 2, 4, 2, 3, 4, 3, 0, 4, 0, 5, 8, 5, 6, 8, 6, 7, 8, 7, 0, 8});
  const Sprung at = sprung(joined, held_boundary(joined));
  for (std::size_t i = at.net.moving; i < at.net.computed; ++i)
    EXPECT_EQ(std::isnan(at.net.spheres.curvatures[i]), at.net.node[i] == 0) << at.net.node[i];
  EXPECT_TRUE(std::isfinite(at.greatest_force));
}

TEST(SphereSprings, TakeABumpBackAndItsNeighboursAlong) {
  for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::quads}) {
    SCOPED_TRACE(name_of(faces));
    PolygonMesh plane = generate::plane({.columns = 8, .rows = 8, .faces = faces});
    const Index middle = 4 * 9 + 4;
    std::vector<Vector3> positions = plane.positions();
    positions[static_cast<std::size_t>(middle)].z() += 1e-4;
    plane.set_positions(std::move(positions));
    const Sprung at = sprung(plane, held_boundary(plane));
    for (std::size_t i = 0; i < at.net.moving; ++i) {
      const double up = sphere_force(at.net, i) * at.net.normals[i].z() / at.net.frame.scale();
      const double apart = (plane.position(at.net.node[i]) - plane.position(middle)).norm();
      if (apart < 1e-9) {
        EXPECT_LT(up, -1e-5);
        EXPECT_GT(up, -2e-4);
      } else if (apart < 1.01 / 8) {
        EXPECT_GT(up, 1e-6);
      }
    }
  }
}

/// Inverted at the unit sphere around a centre.
PolygonMesh inverted(const PolygonMesh& mesh, const Vector3& centre) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p = centre + (p - centre) / (p - centre).squaredNorm();
  return with_positions(mesh, std::move(positions));
}

/// The root mean square of Δc, or of what is to vanish where bending is least, away from the boundary, over that of the
/// curvature's cube.
double unrest(const PolygonMesh& mesh, FairBy fair_by) {
  const Net net = sprung(mesh, held_boundary(mesh), fair_by).net;
  double squares = 0;
  double of_curvatures = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    if (std::any_of(links.begin(), links.end(), [&](Link link) { return link.node() >= net.moving; })) continue;
    const double area = net.spheres.areas[i];
    squares += area * std::pow(sphere_force(net, i) * net.spheres.weights[i] / (4 * net.spheres.factor * area), 2);
    of_curvatures += area * std::pow(net.spheres.curvatures[i], 6);
  }
  return std::sqrt(squares / of_curvatures);
}

TEST(SphereSprings, OfLeastBendingRestOnTheCliffordTorusAndOnWhatItIsInvertedTo) {
  // Inversion at spheres keeps the energy. The torus's mean curvature is uneven.
  for (const bool inverts : {false, true}) {
    SCOPED_TRACE(inverts ? "inverted" : "as it is");
    const auto unrest_of = [&](int cells, FairBy fair_by) {
      const generate::Grid grid{.columns = 3 * cells / 2, .rows = cells, .faces = generate::Faces::quads};
      const PolygonMesh torus = generate::torus(grid, std::numbers::sqrt2, 1);
      return unrest(inverts ? inverted(torus, {0.4, 0.5, 2.5}) : torus, fair_by);
    };
    EXPECT_GT(unrest_of(48, FairBy::curvature), 10);
    EXPECT_LT(unrest_of(48, FairBy::bending), 0.2);
    EXPECT_LT(unrest_of(48, FairBy::bending), 0.3 * unrest_of(24, FairBy::bending));
  }
}

TEST(SphereSprings, OfLeastBendingRestOnAnInvertedCatenoid) {
  const auto unrest_of = [](int cells, FairBy fair_by) {
    PolygonMesh catenoid = generate::tube({.columns = 3 * cells, .rows = cells, .faces = generate::Faces::quads}, 1, 2);
    std::vector<Vector3> positions = catenoid.positions();
    for (Vector3& p : positions) {
      const double radius = std::cosh(p.z() - 1);
      p = Vector3(radius * p.x(), radius * p.y(), p.z() - 1);
    }
    return unrest(inverted(with_positions(std::move(catenoid), std::move(positions)), {0.3, 0.2, 0.1}), fair_by);
  };
  EXPECT_GT(unrest_of(24, FairBy::curvature), 1);
  EXPECT_LT(unrest_of(24, FairBy::bending), 0.2);
  EXPECT_LT(unrest_of(24, FairBy::bending), 0.3 * unrest_of(12, FairBy::bending));
}

}  // namespace
}  // namespace vspring::sphere_springs_test
