// What is claimed of sharp edges: they are found, stay sharp, and each side meets them with its own tangent plane.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "support/positions.hpp"
#include "support/refusal.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::sharp_edges_test {
namespace {

using namespace support;

constexpr double angle = 40;

using Place = std::function<Vector3(const Vector3&)>;

PolygonMesh mapped(const PolygonMesh& mesh, const Place& place) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) p = place(p);
  return with_positions(mesh, std::move(positions));
}

/// Two planes, which meet at y = 0.5 at a right angle.
Vector3 on_roof(const Vector3& p) { return {p.x(), p.y(), -std::abs(p.y() - 0.5)}; }

PolygonMesh roof(generate::Faces faces, int cells = 16) {
  return mapped(generate::plane({.columns = cells, .rows = cells, .faces = faces}), on_roof);
}

bool on_ridge(const Vector3& p) { return std::abs(p.y() - 0.5) < 1e-9; }

/// With noise in nodes for which `disturbs` holds.
PolygonMesh with_noise(const PolygonMesh& mesh, double deviation, const std::function<bool(Index)>& disturbs) {
  std::vector<Vector3> positions = generate::add_noise(mesh, deviation, 7).positions();
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!disturbs(i)) positions[static_cast<std::size_t>(i)] = mesh.position(i);
  }
  return with_positions(mesh, std::move(positions));
}

double furthest(const std::vector<Vector3>& positions, const std::function<double(const Vector3&)>& distance) {
  double greatest = 0;
  for (const Vector3& p : positions) greatest = std::max(greatest, std::abs(distance(p)));
  return greatest;
}

double off_roof(const Vector3& p) { return (p.z() + std::abs(p.y() - 0.5)) / std::sqrt(2.0); }

FairOptions to_the_end() { return {.method = EquilibriumMethod{.tolerance = 1e-12}}; }

TEST(SharpEdges, AreFoundWithTheirChainsAndCorners) {
  const PolygonMesh mesh = roof(generate::Faces::triangles, 10);
  const SharpEdges sharp = find_sharp_edges(mesh, angle);
  EXPECT_EQ(sharp.edges.size(), 10U);
  ASSERT_EQ(sharp.chains.chains().size(), 1U);
  EXPECT_FALSE(sharp.chains.chains().front().closed);
  for (const Index node : sharp.chains.chains().front().nodes) EXPECT_TRUE(on_ridge(mesh.position(node)));
  EXPECT_TRUE(sharp.corners.empty());
  EXPECT_NEAR(chain_lengths(sharp.chains).at(0), 1, 1e-12);
  EXPECT_TRUE(find_sharp_edges(mesh, 91).edges.empty());
  for (const double wrong : {0.0, 180.0, -3.0, std::nan("")}) {
    EXPECT_TRUE(says(refusal([&] { (void)find_sharp_edges(mesh, wrong); }, ErrorCode::invalid_argument), "degrees"));
  }
}

TEST(SharpEdges, AreNotLookedForBetweenFacesWithoutAPlace) {
  PolygonMesh mesh = roof(generate::Faces::quads, 10);
  std::vector<Vector3> positions = mesh.positions();
  positions[60].z() = std::nan("");
  mesh.set_positions(positions);
  EXPECT_EQ(refusal([&] { (void)find_sharp_edges(mesh, angle); }, ErrorCode::unusable_shape),
            "node 60: a coordinate is not finite; correct it");
  Context context;
  EXPECT_EQ(refusal([&] { (void)find_sharp_edges(mesh, angle, 0.01, context); }, ErrorCode::unusable_shape),
            "node 60: a coordinate is not finite; correct it");
}

/// A cube of so many cells a side, triangles.
PolygonMesh cube(int cells) {
  std::map<std::array<int, 3>, Index> number;
  MeshBuilder builder;
  const auto node = [&](std::array<int, 3> at) {
    const auto [found, is_new] = number.try_emplace(at, 0);
    if (is_new) found->second = builder.add_node(Vector3(at[0], at[1], at[2]) / cells);
    return found->second;
  };
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (const bool is_far : {false, true}) {
      for (int i = 0; i < cells; ++i) {
        for (int j = 0; j < cells; ++j) {
          const auto at = [&](int di, int dj) {
            std::array<int, 3> place{};
            place[axis] = is_far ? cells : 0;
            place[(axis + 1) % 3] = i + di;
            place[(axis + 2) % 3] = j + dj;
            return node(place);
          };
          std::array<Index, 4> corners = {at(0, 0), at(1, 0), at(1, 1), at(0, 1)};
          if (!is_far) std::reverse(corners.begin(), corners.end());
          builder.add_face({corners[0], corners[1], corners[2]});
          builder.add_face({corners[0], corners[2], corners[3]});
        }
      }
    }
  }
  return builder.take();
}

TEST(SharpEdges, OfACubeMeetAtItsCorners) {
  const SharpEdges sharp = find_sharp_edges(cube(6), angle);
  EXPECT_EQ(sharp.edges.size(), 72U);
  EXPECT_EQ(sharp.chains.chains().size(), 12U);
  EXPECT_EQ(sharp.corners.size(), 8U);
}

class SharpRoof : public testing::TestWithParam<generate::Faces> {};
INSTANTIATE_TEST_SUITE_P(Faces, SharpRoof, testing::ValuesIn(every_kind));

TEST_P(SharpRoof, ComesBackToTwoPlanesWithTheCreaseStraight) {
  const PolygonMesh truth = roof(GetParam());
  const Constraints constraints = held_boundary(truth);
  const PolygonMesh mesh =
      with_noise(truth, 0.02, [&](Index i) { return !constraints.position_fixed(i) && !on_ridge(truth.position(i)); });
  ASSERT_GT(furthest(mesh.positions(), off_roof), 0.01);
  FairOptions options = to_the_end();
  const FairResult rounded = fair(mesh, constraints, options);
  EXPECT_GT(furthest(rounded.positions, off_roof), 0.02) << "without sharp edges the ridge goes";
  options.sharp_edges = find_sharp_edges(truth, angle).edges;
  ASSERT_EQ(options.sharp_edges.size(), 16U);
  const FairResult result = fair(mesh, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(furthest(result.positions, off_roof), 1e-10);
  EXPECT_EQ(result.report.sharp_edges, 16);
  EXPECT_EQ(result.report.nodes, mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (on_ridge(truth.position(i)) || constraints.position_fixed(i)) {
      EXPECT_EQ(result.positions[static_cast<std::size_t>(i)], mesh.position(i));
    }
  }
}

TEST_P(SharpRoof, ItsCreaseIsMadeStraightWhereThatIsAskedFor) {
  const PolygonMesh truth = roof(GetParam());
  const Constraints constraints = held_boundary(truth);
  const PolygonMesh mesh = with_noise(truth, 0.01, [&](Index i) { return !constraints.position_fixed(i); });
  FairOptions options = to_the_end();
  options.sharp_edges = find_sharp_edges(truth, angle).edges;
  options.sharp_curves = SharpCurves::fit;
  const FairResult result = fair(mesh, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(furthest(result.positions, off_roof), 1e-9);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (on_ridge(truth.position(i))) EXPECT_NEAR(result.positions[static_cast<std::size_t>(i)].y(), 0.5, 1e-9);
  }
  ASSERT_TRUE(result.report.sharp_curves);
  EXPECT_EQ(result.report.sharp_curves->moving_nodes, 15);
}

/// Two cylinders of radius 1 along x that meet at y = 0.5 at an angle of 2 · 30°.
Vector3 on_cylinders(const Vector3& p) {
  const double side = p.y() < 0.5 ? -1 : 1;
  const double turn = std::abs(p.y() - 0.5) + M_PI / 6;
  return {p.x(), 0.5 + side * (std::sin(turn) - std::sin(M_PI / 6)), std::cos(turn) - std::cos(M_PI / 6)};
}

double off_cylinders(const Vector3& p) {
  const double across = std::abs(p.y() - 0.5) + std::sin(M_PI / 6);
  return std::hypot(across, p.z() + std::cos(M_PI / 6)) - 1;
}

double cylinders_off(int cells) {
  const PolygonMesh truth = mapped(generate::plane({.columns = cells, .rows = cells}), on_cylinders);
  FairOptions options = to_the_end();
  options.sharp_edges = find_sharp_edges(truth, angle).edges;
  options.fix_sharp_normals = true;
  Constraints constraints = held_boundary(truth);
  fix_boundary_normals(constraints, truth, options.sharp_edges);
  EXPECT_EQ(options.sharp_edges.size(), static_cast<std::size_t>(cells));
  const FairResult result = fair(truth, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  return furthest(result.positions, off_cylinders);
}

TEST(SharpEdges, TwoCylindersStayTheTwoCylinders) {
  const double coarse = cylinders_off(8);
  const double fine = cylinders_off(16);
  EXPECT_LT(coarse, 5e-3);
  EXPECT_LT(fine, coarse / 2);
}

TEST(SharpEdges, OfACubeWithNoiseAndItsCornersComeBack) {
  const PolygonMesh truth = cube(12);
  const double edge = 1.0 / 12;
  const double noise = 0.1 * edge;
  // In a ball: of that deviation in each coordinate.
  const PolygonMesh mesh = with_noise(truth, std::sqrt(5.0) * noise, [](Index) { return true; });
  Context context;
  const SharpEdges true_edges = find_sharp_edges(truth, angle);
  const SharpEdges sharp = find_sharp_edges(mesh, angle, noise, context);
  EXPECT_EQ(sharp.edges, true_edges.edges) << "and none of the noise";
  EXPECT_GT(find_sharp_edges(mesh, angle / 2).edges.size(), sharp.edges.size()) << "of which there is some";
  for (const double wrong : {-noise, std::nan("")})
    EXPECT_THROW((void)find_sharp_edges(mesh, angle, wrong, context), Error) << wrong;
  ScatteredPoints nodes;
  nodes.positions = mesh.positions();
  FitOptions options{.criterion = Noise{noise}};
  options.fair.distribution = Distribution::keep;
  const auto off_edges = [&](const std::vector<Vector3>& positions) {
    double squares = 0;
    Index count = 0;
    for (const auto& chain : true_edges.chains.chains()) {
      for (const Index node : chain.nodes) {
        const Vector3& true_place = truth.position(node);
        const Vector3& place = positions[static_cast<std::size_t>(node)];
        double square = 0;
        for (int axis = 0; axis < 3; ++axis) {
          if (true_place[axis] == 0 || true_place[axis] == 1)
            square += (place[axis] - true_place[axis]) * (place[axis] - true_place[axis]);
        }
        squares += square;
        ++count;
      }
    }
    return std::sqrt(squares / count) / edge;
  };
  const FitResult rounded = fit(mesh, Constraints(mesh.node_count()), nodes, options);
  options.fair.sharp_edges = sharp.edges;
  const FitResult result = fit(mesh, Constraints(mesh.node_count()), nodes, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  EXPECT_LT(off_edges(result.positions), 0.05);
  EXPECT_GT(off_edges(rounded.positions), 1.3 * off_edges(result.positions));
}

/// A can: a wall of radius 1 and height 1, and a flat lid.
PolygonMesh can() {
  constexpr int around = 32;
  constexpr int rings = 5;
  MeshBuilder builder;
  const auto ring = [&](double radius, double height) {
    for (int k = 0; k < around; ++k) {
      const double turn = 2 * M_PI * k / around;
      builder.add_node({radius * std::cos(turn), radius * std::sin(turn), height});
    }
  };
  for (int r = 0; r <= rings; ++r) ring(1, static_cast<double>(r) / rings);
  for (int r = 1; r < rings; ++r) ring(1 - static_cast<double>(r) / rings, 1);
  const Index middle = builder.add_node({0, 0, 1});
  for (int r = 0; r + 1 < 2 * rings; ++r) {
    for (int k = 0; k < around; ++k) {
      const int next = (k + 1) % around;
      builder.add_face({r * around + k, r * around + next, (r + 1) * around + next, (r + 1) * around + k});
    }
  }
  for (int k = 0; k < around; ++k)
    builder.add_face({(2 * rings - 1) * around + k, (2 * rings - 1) * around + (k + 1) % around, middle});
  return builder.take();
}

TEST(SharpEdges, ARimThatIsALoopStaysAndItsLidBecomesFlat) {
  const PolygonMesh truth = can();
  const Constraints constraints = clamped_boundary(truth);
  const SharpEdges sharp = find_sharp_edges(truth, angle);
  ASSERT_EQ(sharp.chains.chains().size(), 1U);
  EXPECT_TRUE(sharp.chains.chains().front().closed);
  const auto on_lid = [&](Index i) {
    const Vector3& p = truth.position(i);
    return p.z() == 1 && p.head<2>().norm() < 0.99;
  };
  const PolygonMesh mesh = with_noise(truth, 0.02, on_lid);
  FairOptions options = to_the_end();
  const auto off_lid = [&](const std::vector<Vector3>& positions) {
    double greatest = 0;
    for (Index i = 0; i < truth.node_count(); ++i) {
      if (on_lid(i)) greatest = std::max(greatest, std::abs(positions[static_cast<std::size_t>(i)].z() - 1));
    }
    return greatest;
  };
  EXPECT_GT(off_lid(fair(mesh, constraints, options).positions), 0.1) << "without sharp edges the lid bulges";
  options.sharp_edges = sharp.edges;
  const FairResult result = fair(mesh, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_LT(off_lid(result.positions), 1e-10);
  // Wherever a loop goes as a curve of its own nothing holds it.
  options.sharp_curves = SharpCurves::fit;
  EXPECT_FALSE(refusal([&] { (void)fair(mesh, constraints, options); }, ErrorCode::unusable_constraint).empty());
}

/// Two caps that meet at a rim, where they turn by 76°.
PolygonMesh lens() {
  constexpr int around = 24;
  constexpr int rings = 4;
  MeshBuilder builder;
  const auto ring = [&](int k, double side) {
    const double radius = static_cast<double>(k) / rings;
    for (int i = 0; i < around; ++i) {
      const double turn = 2 * M_PI * i / around;
      builder.add_node({radius * std::cos(turn), radius * std::sin(turn), side * 0.45 * (1 - radius * radius)});
    }
  };
  for (int k = 1; k <= rings; ++k) ring(k, 1);
  for (int k = rings - 1; k > 0; --k) ring(k, -1);
  const Index top = builder.add_node({0, 0, 0.45});
  const Index bottom = builder.add_node({0, 0, -0.45});
  for (int i = 0; i < around; ++i) {
    const int next = (i + 1) % around;
    builder.add_face({top, i, next});
    for (int k = 0; k + 1 < 2 * rings - 1; ++k)
      builder.add_face({k * around + i, (k + 1) * around + i, (k + 1) * around + next, k * around + next});
    builder.add_face({bottom, (2 * rings - 2) * around + next, (2 * rings - 2) * around + i});
  }
  return builder.take();
}

TEST(SharpEdges, AboutWhichSidesWouldFoldKeepTheirTangentPlanes) {
  const PolygonMesh mesh = lens();
  const Constraints free(mesh.node_count());
  FairOptions options;
  options.sharp_edges = find_sharp_edges(mesh, 60).edges;
  ASSERT_EQ(options.sharp_edges.size(), 24U);
  const FairResult result = fair(mesh, free, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_TRUE(std::any_of(result.report.warnings.begin(), result.report.warnings.end(), [](const Warning& warning) {
    return warning.code == WarningCode::sharp_normals_kept && says(warning.text, "chains of 24 of 24 of them");
  }));
  options.fix_sharp_normals = true;
  EXPECT_EQ(fair(mesh, free, options).positions, result.positions);
  // Who wants it as it is found gets it.
  options.fix_sharp_normals = false;
  options.accept_worse = true;
  EXPECT_NE(fair(mesh, free, options).positions, result.positions);
}

TEST(SharpEdges, MayEndInsideTheSurface) {
  // A crease that runs out: its two sides turn into one plane.
  const auto on_dart = [](const Vector3& p) {
    return Vector3(p.x(), p.y(), -3 * std::pow(std::max(0.0, 0.7 - p.x()), 2) * std::abs(p.y() - 0.5));
  };
  const PolygonMesh truth = mapped(generate::plane({.columns = 20, .rows = 20}), on_dart);
  const SharpEdges sharp = find_sharp_edges(truth, angle);
  ASSERT_EQ(sharp.chains.chains().size(), 1U);
  EXPECT_LT(sharp.edges.size(), 9U);
  EXPECT_GT(sharp.edges.size(), 4U);
  const Constraints constraints = held_boundary(truth);
  const PolygonMesh mesh =
      with_noise(truth, 0.003, [&](Index i) { return !constraints.position_fixed(i) && !on_ridge(truth.position(i)); });
  FairOptions options = to_the_end();
  options.sharp_edges = sharp.edges;
  const FairResult result = fair(mesh, constraints, options);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  const PolygonMesh after = with_positions(mesh, result.positions);
  const SharpEdges kept = find_sharp_edges(after, angle / 2);
  EXPECT_TRUE(std::includes(kept.edges.begin(), kept.edges.end(), sharp.edges.begin(), sharp.edges.end()));
  EXPECT_TRUE(self_intersections(after).empty());
}

/// A roof whose ridge and the rows beside it, which are near, are wavy; all rows but the ridge and the outer ones are
/// held. A ridge that is straight would be beyond them.
struct WavyRoof {
  PolygonMesh mesh;
  Constraints constraints = Constraints(0);
  MeshEdges ridge;

  WavyRoof() {
    mesh = mapped(generate::plane({.columns = 16, .rows = 16}), [](const Vector3& p) {
      const double across = p.y() - 0.5;
      const double near = across * std::min(1.0, 0.2 + 6 * across * across);
      const double wave = 0.05 * std::sin(2 * M_PI * p.x()) * std::max(0.0, 1 - 3 * std::abs(across));
      return Vector3(p.x(), 0.5 + near + wave, -std::abs(near));
    });
    constraints = held_boundary(mesh);
    for (Index i = 0; i < mesh.node_count(); ++i) {
      const Index row = i / 17;
      if (row > 3 && row < 13 && row != 8) constraints.fix_position(i, mesh.position(i));
    }
    for (Index k = 0; k < 16; ++k) ridge.emplace_back(8 * 17 + k, 8 * 17 + k + 1);
  }

  [[nodiscard]] bool ridge_stays(const std::vector<Vector3>& positions) const {
    return std::all_of(ridge.begin(), ridge.end(), [&](const auto& edge) {
      return positions[static_cast<std::size_t>(edge.first)] == mesh.position(edge.first);
    });
  }
};

void expect_told_that_edges_stay(const FairReport& report) {
  EXPECT_TRUE(std::any_of(report.warnings.begin(), report.warnings.end(), [](const Warning& warning) {
    return warning.code == WarningCode::worse_than_input && says(warning.text, "the sharp edges stay where they were");
  }));
}

TEST(SharpEdges, StayWhereTheSurfaceWouldFoldWithThemElsewhere) {
  const WavyRoof roof;
  FairOptions options = to_the_end();
  options.sharp_edges = roof.ridge;
  options.sharp_curves = SharpCurves::fit;
  const FairResult faired = fair(roof.mesh, roof.constraints, options);
  EXPECT_TRUE(roof.ridge_stays(faired.positions));
  expect_told_that_edges_stay(faired.report);
  ScatteredPoints nodes;
  nodes.positions = roof.mesh.positions();
  const FitResult fitted = fit(roof.mesh, roof.constraints, nodes, {.criterion = Within{0.06}, .fair = options});
  EXPECT_TRUE(roof.ridge_stays(fitted.positions));
  expect_told_that_edges_stay(fitted.report.fair);
  // Who wants it as it is found gets it.
  options.accept_worse = true;
  EXPECT_FALSE(roof.ridge_stays(fair(roof.mesh, roof.constraints, options).positions));
  EXPECT_FALSE(roof.ridge_stays(
      fit(roof.mesh, roof.constraints, nodes, {.criterion = Within{0.06}, .fair = options}).positions));
}

TEST(SharpEdges, NodesAreWithinTheToleranceThatWasAskedFor) {
  const PolygonMesh truth = cube(10);
  const PolygonMesh mesh = with_noise(truth, 0.02, [](Index) { return true; });
  ScatteredPoints nodes;
  nodes.positions = mesh.positions();
  FitOptions options;
  options.fair.sharp_edges = find_sharp_edges(truth, angle).edges;
  options.fair.distribution = Distribution::keep;
  for (const double tolerance : {0.005, 0.01, 0.03}) {
    options.criterion = Within{tolerance};
    const FitResult result = fit(mesh, Constraints(mesh.node_count()), nodes, options);
    Context context;
    const auto distances = point_distances(nodes.positions, with_positions(mesh, result.positions), context);
    EXPECT_LE(*std::max_element(distances.begin(), distances.end()), tolerance * (1 + 1e-9));
    EXPECT_EQ(result.report.outside_points, 0);
    // Four times nearer than the noise chains are within it only on detours.
    if (tolerance > 0.02) {
      EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
    }
  }
}

TEST(SharpEdges, OfAScanAreSplinesThatTakeNoSteps) {
  // The ridge is held at its ends, where they are off by noise.
  const PolygonMesh truth = roof(generate::Faces::quads, 10);
  const PolygonMesh mesh = with_noise(truth, std::sqrt(5.0) * 0.01, [](Index) { return true; });
  ScatteredPoints nodes;
  nodes.positions = mesh.positions();
  FitOptions options{.criterion = Noise{0.01}};
  options.fair.distribution = Distribution::keep;
  options.fair.sharp_edges = find_sharp_edges(truth, angle).edges;
  const FitResult result = fit(mesh, held_boundary(mesh), nodes, options);
  EXPECT_EQ(result.report.fair.outcome, Outcome::converged);
  ASSERT_TRUE(result.report.fair.sharp_curves);
  EXPECT_EQ(result.report.fair.sharp_curves->iterations, 0);
  EXPECT_TRUE(result.report.fair.sharp_curves->warnings.empty());
  double before = 0;
  double after = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Vector3& true_place = truth.position(i);
    if (!on_ridge(true_place)) continue;
    before += (mesh.position(i) - true_place).tail<2>().squaredNorm();
    after += (result.positions[static_cast<std::size_t>(i)] - true_place).tail<2>().squaredNorm();
  }
  EXPECT_LT(std::sqrt(after), 0.6 * std::sqrt(before)) << "across the ridge";
}

TEST(SharpEdges, GivenOnesAreRefusedWithTheReason) {
  const PolygonMesh mesh = roof(generate::Faces::quads, 4);
  const Constraints constraints = held_boundary(mesh);
  const auto refused = [&](MeshEdges edges) {
    FairOptions options;
    options.sharp_edges = std::move(edges);
    return refusal([&] { (void)fair(mesh, constraints, options); }, ErrorCode::unusable_constraint);
  };
  EXPECT_TRUE(says(refused({{0, 99}}), "there is no node 99"));
  EXPECT_TRUE(says(refused({{0, 12}}), "from node 0 to node 12: no face has this edge"));
  EXPECT_TRUE(says(refused({{0, 1}}), "boundary"));
}

TEST(SharpEdges, ThoseThatCannotBeSharpAreLeftOutAndNamed) {
  const PolygonMesh mesh = roof(generate::Faces::triangles, 4);
  std::vector<LeftOutEdge> left_out;
  const SharpEdges sharp =
      as_sharp_edges(mesh, {{11, 10}, {0, 1}, {10, 11}, {0, 12}, {3, 99}, {12, 12}, {12, 11}}, left_out);
  EXPECT_EQ(sharp.edges, (MeshEdges{{10, 11}, {11, 12}}));
  ASSERT_EQ(left_out.size(), 4U);
  EXPECT_EQ(std::pair(left_out[0].first, left_out[0].second), std::pair(Index{0}, Index{1}));
  EXPECT_TRUE(says(left_out[0].why, "boundary"));
  EXPECT_TRUE(says(left_out[1].why, "no face"));
  EXPECT_TRUE(says(left_out[2].why, "no node 99"));
  EXPECT_TRUE(says(left_out[3].why, "no face"));
}

TEST(SharpEdges, OfARefinedMeshAreThePartsOfTheDividedOnes) {
  const PolygonMesh mesh = roof(generate::Faces::triangles, 4);
  const MeshEdges ridge = find_sharp_edges(mesh, angle).edges;
  for (const double length : {0.2, 0.1, 0.03}) {
    const Refined refined = refine(mesh, Constraints(mesh.node_count()), {.length = length});
    const MeshEdges parts = refined.parts_of(ridge);
    EXPECT_EQ(as_sharp_edges(refined.mesh, parts).edges, find_sharp_edges(refined.mesh, angle).edges) << length;
    // One after the other, from the first node to the last.
    for (std::size_t k = 1; k < parts.size(); ++k) EXPECT_EQ(parts[k - 1].second, parts[k].first);
    EXPECT_TRUE(says(refusal(
                         [&] {
                           (void)refined.parts_of({{0, refined.mesh.node_count()}});
                         },
                         ErrorCode::invalid_argument),
                     "no node"));
  }
}

TEST(SharpEdges, NormalsAtThemAreLeftOutWithAWarning) {
  const PolygonMesh mesh = roof(generate::Faces::quads, 8);
  FairOptions options = to_the_end();
  options.sharp_edges = find_sharp_edges(mesh, angle).edges;
  const auto warnings = [&](const Constraints& constraints) {
    const FairResult result = fair(mesh, constraints, options);
    EXPECT_EQ(result.report.fixed_normals, 4 * 8 - 2);
    return std::count_if(result.report.warnings.begin(), result.report.warnings.end(),
                         [](const Warning& warning) { return warning.code == WarningCode::normals_at_sharp_edges; });
  };
  EXPECT_EQ(warnings(clamped_boundary(mesh)), 1);
  // Those of the sides alone.
  Constraints constraints = held_boundary(mesh);
  fix_boundary_normals(constraints, mesh, options.sharp_edges);
  EXPECT_EQ(warnings(constraints), 0);
  EXPECT_LT(furthest(fair(mesh, constraints, options).positions, off_roof), 1e-10);
}

TEST(SharpEdges, SessionsKeepThem) {
  const PolygonMesh mesh = roof(generate::Faces::quads, 8);
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  FairOptions options = to_the_end();
  options.sharp_edges = find_sharp_edges(mesh, angle).edges;
  FairingSession session(mesh, options);
  EXPECT_EQ(session.fair(constraints).positions, fair(mesh, constraints, options).positions);
  // Half way up one side.
  constraints.fix_position(20, mesh.position(20) + Vector3(0, 0, 0.1));
  EXPECT_FALSE(session.predict(constraints, 1e-4));
  Context context;
  const FairResult result = session.update(constraints, 1e-4, context);
  EXPECT_EQ(result.report.sharp_edges, 8);
  const std::vector<Vector3> exact = fair(mesh, constraints, options).positions;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Vector3& p = result.positions[static_cast<std::size_t>(i)];
    EXPECT_LT((p - exact[static_cast<std::size_t>(i)]).norm(), 1e-3);
    // The other side is flat as before.
    if (mesh.position(i).y() > 0.5 - 1e-9) EXPECT_LT(std::abs(off_roof(p)), 1e-3);
  }
  EXPECT_TRUE(says(refusal(
                       [&] {
                         const FairingSession none(mesh, {.sharp_edges = {{0, 1}}});
                       },
                       ErrorCode::unusable_constraint),
                   "boundary"));
}

}  // namespace
}  // namespace vspring::sharp_edges_test
