// The solvers of the corrections on surfaces against dense algebra.

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <vector>

#include "levels/surface_levels.hpp"
#include "levels/surface_slide.hpp"
#include "solve/bending_form.hpp"
#include "solve/cholesky_solver.hpp"
#include "solve/interpolation.hpp"
#include "solve/multigrid_solver.hpp"
#include "vspring/generate.hpp"

namespace vspring {
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

Eigen::MatrixXd right_sides(Eigen::Index rows, Eigen::Index columns) {
  Eigen::MatrixXd values(rows, columns);
  for (Eigen::Index k = 0; k < columns; ++k) {
    for (Eigen::Index i = 0; i < rows; ++i) values(i, k) = std::sin(0.1 * static_cast<double>(i * (k + 1))) + 0.2;
  }
  return values;
}

std::vector<Interpolation> interpolations_of(const std::vector<SurfaceLevel>& levels, std::size_t last,
                                             ThreadTeam& team) {
  std::vector<Interpolation> result;
  for (std::size_t k = levels.size() - 1; k > last; --k)
    result.push_back(
        interpolation(levels[k].net, levels[k].net.positions, levels[k - 1].net, levels[k - 1].finer, team));
  return result;
}

TEST(SparseRows, ProductAndTransposeAreThoseOfDenseMatrices) {
  ThreadTeam team(2);
  const Net net = disc_net(300, true, team);
  const SparseRows a = spreading_form(net, team);
  const SparseRows b = bending_form(net, team);
  EXPECT_LT((dense(product(a, b, team)) - dense(a) * dense(b)).norm(), 1e-10 * dense(b).norm());
  EXPECT_EQ(dense(product(a, b, team).transposed()), dense(product(a, b, team)).transpose());
}

TEST(BendingForm, IsSymmetricAndPositiveDefinite) {
  ThreadTeam team(1);
  for (const bool normals : {false, true}) {
    Net net = disc_net(200, normals, team);
    // A moving node with a normal, too.
    net.given[5] |= Net::given_normal;
    for (const SparseRows& form : {bending_form(net, team), spreading_form(net, team)}) {
      const Eigen::MatrixXd matrix = dense(form);
      EXPECT_LT((matrix - matrix.transpose()).norm(), 1e-12 * matrix.norm());
      EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(matrix).eigenvalues().minCoeff(), 0);
    }
  }
}

TEST(BendingForm, DoesNotResistTilts) {
  ThreadTeam team(1);
  const Net net = disc_net(400, true, team);
  const SparseRows form = bending_form(net, team);
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

TEST(CholeskySolver, SolvesAndSolvesAnew) {
  ThreadTeam team(2);
  CholeskySolver solver(team);
  for (const Index nodes : {50, 400}) {
    const Net net = disc_net(nodes, true, team);
    for (const SparseRows& form : {bending_form(net, team), spreading_form(net, team)}) {
      const Eigen::MatrixXd right = right_sides(static_cast<Eigen::Index>(net.moving), 3);
      Eigen::MatrixXd solution = right;
      solver.build(form);
      solver.solve(solution);
      EXPECT_LT((solution - dense(form).ldlt().solve(right)).norm(), 1e-8 * solution.norm());
    }
  }
}

TEST(Interpolation, ReproducesLinearFunctionsOfThePlace) {
  ThreadTeam team(1);
  const auto levels =
      surface_levels(disc_net(2000, false, team), *surface_model(PseudoNormals::link), Distribution::even, team);
  const SurfaceLevel& fine = levels.back();
  const SurfaceLevel& coarse = levels[levels.size() - 2];
  const Interpolation between = interpolation(fine.net, fine.net.positions, coarse.net, coarse.finer, team);
  ASSERT_EQ(between.up.rows(), fine.net.moving);
  ASSERT_EQ(between.up.columns(), coarse.net.moving);
  for (std::size_t i = 0; i < fine.net.moving; ++i) {
    if (fine.net.positions[i].norm() > 0.7) continue;
    Vector3 place = Vector3::Zero();
    for (const SparseRows::Entry& entry : between.up.row(i)) place += entry.value * coarse.net.positions[entry.column];
    EXPECT_LT((place - fine.net.positions[i]).norm(), 0.01);
  }
}

TEST(MultigridSolver, NeedsFewIterationsAtEverySize) {
  ThreadTeam team(2);
  for (const Index nodes : {2000, 8000, 32000}) {
    SCOPED_TRACE(nodes);
    // Without jitter nodes lie about as the regularisation puts them.
    const auto levels =
        surface_levels(disc_net(nodes, true, team, 0), *surface_model(PseudoNormals::link), Distribution::even, team);
    const Net& net = levels.back().net;
    const std::vector<Interpolation> coarse = interpolations_of(levels, 2, team);
    for (const bool bends : {true, false}) {
      const SparseRows form = bends ? bending_form(net, team) : spreading_form(net, team);
      const Eigen::MatrixXd right = right_sides(static_cast<Eigen::Index>(net.moving), bends ? 1 : 3);
      MultigridSolver solver(coarse, 1e-9, team);
      solver.build(form);
      Eigen::MatrixXd solution = right;
      solver.solve(solution);
      EXPECT_LE(solver.iterations(), bends ? 40 : 20);
      EXPECT_LT((form.to_eigen() * solution - right).norm(), 1e-4 * right.norm());
      Eigen::MatrixXd expected = right;
      CholeskySolver exact(team);
      exact.build(form);
      exact.solve(expected);
      EXPECT_LT((solution - expected).norm(), 1e-5 * expected.norm());
    }
  }
}

TEST(MultigridSolver, ThreadsGiveTheSameBits) {
  std::vector<Eigen::MatrixXd> solutions;
  for (const int threads : {1, 2, 3}) {
    ThreadTeam team(threads);
    const auto levels =
        surface_levels(disc_net(20000, true, team), *surface_model(PseudoNormals::link), Distribution::even, team);
    const Net& net = levels.back().net;
    const std::vector<Interpolation> coarse = interpolations_of(levels, 2, team);
    MultigridSolver solver(coarse, 0.05, team);
    solver.build(bending_form(net, team));
    solutions.push_back(right_sides(static_cast<Eigen::Index>(net.moving), 1));
    solver.solve(solutions.back());
  }
  EXPECT_EQ(solutions[0], solutions[1]);
  EXPECT_EQ(solutions[0], solutions[2]);
}

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

}  // namespace
}  // namespace vspring
