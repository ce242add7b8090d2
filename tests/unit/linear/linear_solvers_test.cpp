// The solvers of the corrections on surfaces against dense algebra.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <Eigen/SparseCholesky>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

#include "base/cancellation.hpp"
#include "levels/levels.hpp"
#include "linear/cholesky_solver.hpp"
#include "linear/interpolation.hpp"
#include "linear/multigrid_solver.hpp"
#include "linear/sparse_sum.hpp"
#include "precondition/bending_operator.hpp"
#include "precondition/surface_systems.hpp"
#include "vspring/generate.hpp"

namespace vspring::linear_solvers_test {
namespace {

/// A disc whose boundary is held, with normals or without.
Net disc_net(Index nodes, bool normals, ThreadTeam& team, double jitter = 0.3) {
  const PolygonMesh disc = generate::flat_disc({.nodes = nodes, .jitter = jitter});
  Constraints constraints(disc.node_count());
  fix_boundary_positions(constraints, disc);
  if (normals) fix_boundary_normals(constraints, disc);
  Net net = gather_net(disc, constraints);
  update_directions(net, *surface_model(PseudoNormals::link), team);
  return net;
}

Eigen::MatrixXd dense(const SparseRows& matrix) { return Eigen::MatrixXd(matrix.to_eigen()); }

std::vector<Vector3> right_sides(std::size_t rows) {
  std::vector<Vector3> values(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    const auto place = static_cast<double>(i);
    values[i] = Vector3(std::sin(0.1 * place), std::sin(0.2 * place), std::sin(0.3 * place)).array() + 0.2;
  }
  return values;
}

std::vector<double> first_column(const std::vector<Vector3>& values) {
  std::vector<double> column;
  column.reserve(values.size());
  for (const Vector3& value : values) column.push_back(value.x());
  return column;
}

Eigen::Map<const Eigen::MatrixXd> as_matrix(const std::vector<double>& values) {
  return {values.data(), static_cast<Eigen::Index>(values.size()), 1};
}

Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor>> as_matrix(
    const std::vector<Vector3>& values) {
  return {values.front().data(), static_cast<Eigen::Index>(values.size()), 3};
}

/// A surface with its levels, ready for systems over `count` of them.
struct Prepared {
  std::vector<Level> levels;
  SystemLevels systems;
};

Prepared prepared(Net net, std::size_t count, ThreadTeam& team) {
  Prepared result{surface_levels(std::move(net), *surface_model(PseudoNormals::link), Distribution::even, team), {}};
  std::vector<Level>& levels = result.levels;
  result.systems.net = &levels.back().net;
  for (std::size_t k = levels.size() - 1; k > 0 && result.systems.interpolations.size() + 1 < count; --k) {
    restrict_shape(levels[k], levels[k - 1]);
    result.systems.interpolations.push_back(interpolation(levels[k].net, levels[k - 1].net, levels[k - 1].finer, team));
  }
  return result;
}

TEST(SparseRows, ProductAndTransposeAreThoseOfDenseMatrices) {
  ThreadTeam team(2);
  const Net net = disc_net(300, true, team);
  const SparseRows a = tangential_laplacian(net, team);
  const SparseRows b = bending_operator(net, team);
  const SparseRows both = product(a, b, team);
  EXPECT_LT((dense(both) - dense(a) * dense(b)).norm(), 1e-10 * dense(b).norm());
  EXPECT_EQ(dense(both.transposed()), dense(both).transpose());
}

TEST(Cholesky, HasTheBitsOfEigensFactor) {
  ThreadTeam team(1);
  const SparseRows rows = bending_operator(disc_net(300, true, team), team);
  const std::vector<double> right = first_column(right_sides(rows.rows()));
  CholeskySolver solver(team);
  solver.build(rows);
  std::vector<double> values = right;
  solver.solve(values, {});
  const Eigen::SparseMatrix<double> matrix = rows.to_eigen();
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::AMDOrdering<int>> factor(matrix);
  const Eigen::VectorXd column = as_matrix(right);
  const Eigen::VectorXd expected = factor.solve(column);
  EXPECT_EQ(as_matrix(values), expected);
}

TEST(Cholesky, EndsWhereItIsCancelledAndIsBuiltAnew) {
  ThreadTeam team(1);
  const SparseRows rows = bending_operator(disc_net(300, true, team), team);
  const std::vector<double> right = first_column(right_sides(rows.rows()));
  CholeskySolver solver(team);
  solver.build(rows);
  std::vector<double> expected = right;
  solver.solve(expected, {});
  Context context;
  context.cancel();
  {
    const CancellationScope scope(context);
    EXPECT_THROW(solver.build(rows), Cancelled);
  }
  solver.build(rows);
  std::vector<double> values = right;
  solver.solve(values, {});
  EXPECT_EQ(values, expected);
}

TEST(BendingForm, IsSymmetricAndPositiveDefinite) {
  ThreadTeam team(1);
  for (const bool normals : {false, true}) {
    Net net = disc_net(200, normals, team);
    // A moving node with a normal, too.
    net.given[5] |= Net::given_normal;
    for (const SparseRows& form : {bending_operator(net, team), tangential_laplacian(net, team)}) {
      const Eigen::MatrixXd matrix = dense(form);
      EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-12 * matrix.norm());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff(), 0);
    }
  }
}

TEST(BendingForm, PullsAtWhatIsBentAndNotAtWhatIsMovedAsAWhole) {
  ThreadTeam team(1);
  for (const bool normals : {false, true}) {
    Net net = disc_net(300, normals, team);
    std::vector<Vector3> ways(net.positions.size(), Vector3::Zero());
    Eigen::VectorXd heights(static_cast<Eigen::Index>(net.moving));
    for (std::size_t i = 0; i < net.moving; ++i) {
      heights[static_cast<Eigen::Index>(i)] = std::sin(0.7 * static_cast<double>(i));
      ways[i] = heights[static_cast<Eigen::Index>(i)] * net.normals[i];
    }
    const Eigen::VectorXd expected = -dense(bending_operator(net, team)) * heights;
    EXPECT_LT((as_matrix(bending_residual(net, ways)) - expected).norm(), 1e-10 * expected.norm());
    // A bowl, whose normals differ.
    for (Vector3& place : net.positions) place.z() = 0.4 * place.head<2>().squaredNorm();
    update_directions(net, *surface_model(PseudoNormals::link), team);
    ways.assign(ways.size(), Vector3(0.3, -0.2, 0.5));
    EXPECT_LT(as_matrix(bending_residual(net, ways)).norm(), 1e-12 * expected.norm());
  }
}

TEST(BendingForm, DoesNotResistTilts) {
  ThreadTeam team(1);
  const Net net = disc_net(400, true, team);
  const SparseRows form = bending_operator(net, team);
  Eigen::VectorXd tilted(static_cast<Eigen::Index>(net.moving));
  for (std::size_t i = 0; i < net.moving; ++i)
    tilted[static_cast<Eigen::Index>(i)] = 0.3 * net.positions[i].x() - 0.2 * net.positions[i].y();
  const Eigen::VectorXd image = dense(form) * tilted;
  // Away from what is held.
  for (std::size_t i = 0; i < net.moving; ++i) {
    if (net.positions[i].norm() < 0.5) {
      EXPECT_NEAR(image[static_cast<Eigen::Index>(i)], 0, 1e-8);
    }
  }
}

/// A node among so many, over an angle, and a ring around these, which is held. Without them all around it is one of
/// the boundary. In the plane.
Net fan_net(Index spokes, double angle, ThreadTeam& team) {
  const bool closed = angle > 6;
  MeshBuilder builder;
  builder.add_node(Vector3::Zero());
  for (const double radius : {1.0, 2.0}) {
    for (Index k = 0; k < spokes; ++k) {
      const double at = angle * k / (closed ? spokes : spokes - 1);
      builder.add_node(radius * Vector3(std::cos(at), std::sin(at), 0));
    }
  }
  for (Index k = 0; k < (closed ? spokes : spokes - 1); ++k) {
    const Index next = (k + 1) % spokes;
    builder.add_face({0, 1 + k, 1 + next});
    builder.add_face({1 + k, 1 + spokes + k, 1 + spokes + next, 1 + next});
  }
  const PolygonMesh mesh = builder.take();
  Constraints constraints(mesh.node_count());
  for (Index k = 0; k < spokes; ++k) constraints.fix_position(1 + spokes + k, mesh.position(1 + spokes + k));
  Net net = gather_net(mesh, constraints);
  update_directions(net, *surface_model(PseudoNormals::link), team);
  return net;
}

Eigen::Index place_of(const Net& net, Index node) {
  return std::find(net.node.begin(), net.node.end(), node) - net.node.begin();
}

TEST(BendingForm, SomeOfManyNeighboursStandForAll) {
  ThreadTeam team(1);
  const auto stiffness = [&](Index spokes) {
    const Net net = fan_net(spokes, 2 * std::numbers::pi, team);
    const Eigen::Index middle = place_of(net, 0);
    return dense(bending_operator(net, team))(middle, middle);
  };
  // As the sum of the weights of its edges, which are all the same.
  const double expected = stiffness(64) / 64;
  EXPECT_NEAR(stiffness(128) / 128, expected, 0.1 * expected);
  EXPECT_NEAR(stiffness(640) / 640, expected, 0.2 * expected);
}

TEST(BendingForm, ABoundaryNodeOfManyNeighboursBendsAlongTheBoundary) {
  ThreadTeam team(1);
  for (const Index spokes : {20, 100}) {
    const Net net = fan_net(spokes, std::numbers::pi, team);
    const Eigen::MatrixXd matrix = dense(bending_operator(net, team));
    EXPECT_GT(matrix(place_of(net, 1), place_of(net, spokes)), 0) << spokes;
  }
}

TEST(CholeskySolver, SolvesAndSolvesAnew) {
  ThreadTeam team(2);
  CholeskySolver solver(team);
  for (const Index nodes : {50, 400}) {
    const Net net = disc_net(nodes, true, team);
    for (const SparseRows& form : {bending_operator(net, team), tangential_laplacian(net, team)}) {
      const std::vector<Vector3> right = right_sides(net.moving);
      const Eigen::MatrixXd expected = dense(form).ldlt().solve(as_matrix(right));
      std::vector<Vector3> solution = right;
      std::vector<double> single = first_column(right);
      solver.build(form);
      solver.solve(solution, {});
      solver.solve(single, {});
      EXPECT_LT((as_matrix(solution) - expected).norm(), 1e-8 * expected.norm());
      EXPECT_LT((as_matrix(single) - expected.col(0)).norm(), 1e-8 * expected.norm());
    }
  }
}

TEST(CholeskySolver, AsManyEntriesAtOtherPlacesAreAnotherMatrix) {
  ThreadTeam team(1);
  CholeskySolver solver(team);
  constexpr std::uint32_t count = 30;
  // Arrows: what one node has to do with all others has no fill in one order and much in another.
  for (const std::uint32_t hub : {count - 1, 0U, 7U}) {
    const SparseRows matrix = SparseRows::build(team, count, count, [&] {
      return [&](std::size_t i, SparseRows::Row& row) {
        for (std::uint32_t k = 0; k < count; ++k)
          if (k == i || i == hub || k == hub) row.push_back({k, k == i ? count + 0.25 * k : -1.0});
      };
    });
    solver.build(matrix);
    const std::vector<double> right(count, 1);
    std::vector<double> solution = right;
    solver.solve(solution, {});
    const Eigen::VectorXd expected = dense(matrix).ldlt().solve(Eigen::VectorXd::Ones(count));
    EXPECT_LT((Eigen::Map<Eigen::VectorXd>(solution.data(), count) - expected).norm(), 1e-12) << hub;
  }
}

TEST(CholeskySolver, AMatrixWithoutAFactorLeavesNothingToChance) {
  ThreadTeam team(1);
  CholeskySolver solver(team);
  // Rows of zeros, as tangled shapes have them, and of no numbers.
  const auto diagonal = [&](double last) {
    return SparseRows::build(team, 3, 3, [&] {
      return [&](std::size_t i, SparseRows::Row& row) {
        row.push_back({static_cast<std::uint32_t>(i), i < 2 ? 2.0 : last});
      };
    });
  };
  solver.build(diagonal(0));
  std::vector<double> values = {2, 4, 0};
  solver.solve(values, {});
  EXPECT_NEAR(values[0], 1, 1e-8);
  EXPECT_NEAR(values[1], 2, 1e-8);
  EXPECT_EQ(values[2], 0);
  solver.build(diagonal(std::numeric_limits<double>::quiet_NaN()));
  values = {2, 4, 6};
  solver.solve(values, {});
  EXPECT_TRUE(std::isnan(values[2]));
  // What was added for one matrix is not there for the next.
  solver.build(diagonal(3));
  values = {2, 4, 6};
  solver.solve(values, {});
  EXPECT_EQ(values, (std::vector<double>{1, 2, 2}));
  const SparseRows nothing = SparseRows::build(team, 2, 2, [] {
    return [](std::size_t i, SparseRows::Row& row) { row.push_back({static_cast<std::uint32_t>(i), 0.0}); };
  });
  solver.build(nothing);
  std::vector<Vector3> vectors(2, Vector3::Ones());
  solver.solve(vectors, {});
  EXPECT_TRUE(std::isnan(vectors[0].x()) && std::isnan(vectors[1].z()));
}

TEST(Interpolation, ReproducesLinearFunctionsOfThePlace) {
  ThreadTeam team(1);
  const auto levels =
      surface_levels(disc_net(2000, false, team), *surface_model(PseudoNormals::link), Distribution::even, team);
  const Level& fine = levels.back();
  const Level& coarse = levels[levels.size() - 2];
  const Interpolation between = interpolation(fine.net, coarse.net, coarse.finer, team);
  ASSERT_EQ(between.up.rows(), fine.net.moving);
  ASSERT_EQ(between.up.columns(), coarse.net.moving);
  for (std::size_t i = 0; i < fine.net.moving; ++i) {
    if (fine.net.positions[i].norm() > 0.7) continue;
    Vector3 place = Vector3::Zero();
    for (const FloatRows::Entry& entry : between.up.row(i))
      place += static_cast<double>(entry.value) * coarse.net.positions[entry.column];
    EXPECT_LT((place - fine.net.positions[i]).norm(), 0.01);
  }
}

/// The greatest error of a value as a share of the greatest value.
double relative_error(const Eigen::MatrixXd& solution, const Eigen::MatrixXd& expected) {
  return (solution - expected).cwiseAbs().maxCoeff() / expected.cwiseAbs().maxCoeff();
}

TEST(SurfaceSystems, SolveAtEverySize) {
  ThreadTeam team(2);
  for (const Index nodes : {500, 2000, 8000}) {
    // With one level a factor solves.
    for (const std::size_t levels : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
      if (nodes > 2000 && levels < 4) continue;  // nothing that smaller ones do not show
      SCOPED_TRACE(::testing::Message() << nodes << " nodes, " << levels << " levels");
      // Without jitter nodes lie about as the regularisation puts them.
      const Prepared surface = prepared(disc_net(nodes, true, team, 0), levels, team);
      const Net& net = surface.levels.back().net;
      const std::vector<Vector3> right = right_sides(net.moving);
      CholeskySolver exact(team);

      const SparseRows bending = bending_operator(net, team);
      std::vector<double> bent = first_column(right);
      std::vector<double> expected_bent = bent;
      exact.build(bending);
      exact.solve(expected_bent, {});
      BendingSystem system(surface.systems, team);
      for (int build = 0; build < 2; ++build) {
        system.build();
        for (const double share : {0.05, 0.005}) {
          bent = first_column(right);
          system.solve(bent, {.share = share});
          EXPECT_LT(relative_error(as_matrix(bent), as_matrix(expected_bent)), levels == 1 ? 1e-8 : 5 * share);
        }
      }

      const SparseRows spreading = tangential_laplacian(net, team);
      const auto spreading_system = spreading_solver(surface.systems, team);
      std::vector<Vector3> expected_spread = right;
      exact.build(spreading);
      exact.solve(expected_spread, {});
      for (const double share : {1.0, 0.05, 0.005}) {
        std::vector<Vector3> spread = right;
        spreading_system->solve(spread, {.share = share});
        EXPECT_LT(relative_error(as_matrix(spread), as_matrix(expected_spread)), levels == 1 ? 1e-8 : 0.3 * share);
      }
    }
  }
}

TEST(SurfaceSystems, AnErrorThatIsEnoughIsLeft) {
  ThreadTeam team(2);
  const Prepared surface = prepared(disc_net(8000, true, team, 0), 3, team);
  const Net& net = surface.levels.back().net;
  BendingSystem system(surface.systems, team);
  system.build();
  std::vector<double> best = first_column(right_sides(net.moving));
  std::vector<double> rough = best;
  system.solve(best, {.share = 0.02});
  double greatest = 0;
  for (const double value : best) greatest = std::max(greatest, std::abs(value));
  system.solve(rough, {.enough = 0.1 * greatest});
  double difference = 0;
  for (std::size_t i = 0; i < best.size(); ++i) difference = std::max(difference, std::abs(best[i] - rough[i]));
  EXPECT_GT(difference, 0);
  EXPECT_LT(difference, 0.4 * greatest);
}

TEST(SurfaceSystems, ThreadsGiveTheSameBits) {
  std::vector<std::vector<double>> solutions;
  std::vector<std::vector<Vector3>> spread;
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    const Prepared surface = prepared(disc_net(20000, true, team), 4, team);
    const Net& net = surface.levels.back().net;
    BendingSystem system(surface.systems, team);
    system.build();
    spread.push_back(right_sides(net.moving));
    solutions.push_back(first_column(spread.back()));
    system.solve(solutions.back(), {.share = 0.05});
    spreading_solver(surface.systems, team)->solve(spread.back(), {.share = 0.05});
  }
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
  EXPECT_EQ(spread[0], spread[1]);
  EXPECT_EQ(spread[0], spread[2]);
}

}  // namespace
}  // namespace vspring::linear_solvers_test
