// What a fit does once somebody has cancelled: it ends, keeps the best so far, and measures no large shape.

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <memory>
#include <numeric>
#include <string_view>
#include <vector>

#include "base/cancellation.hpp"
#include "base/threads.hpp"
#include "constraints/holding.hpp"
#include "equilibrium/sweep_method.hpp"
#include "fit/interior_fit.hpp"
#include "fit/tolerance_fit.hpp"
#include "levels/patch_mesh.hpp"
#include "noise/scan_mesh.hpp"
#include "points/nearest_nodes.hpp"
#include "points/point_clusters.hpp"
#include "points/point_factors.hpp"
#include "points/point_ties.hpp"
#include "shape/incidence.hpp"
#include "shape/triangles.hpp"
#include "spring/curve_net.hpp"
#include "spring/model.hpp"
#include "support/curves.hpp"
#include "support/surfaces.hpp"
#include "vspring/distance.hpp"
#include "vspring/fit.hpp"
#include "vspring/noise.hpp"

namespace vspring::fit_cancellation_test {
namespace {

using namespace support;

const std::vector<FitCriterion> every_criterion = {Weight{0.01}, SmoothingLength{0.05}, Within{0.003},
                                                   RootMeanSquare{0.001}, Noise{0.001}};

PolygonMesh noisy_annulus(Index nodes) { return generate::add_noise(generate::annulus({.nodes = nodes}), 0.002, 1); }

/// The boundary, and a node that is pulled out of the shape.
Constraints held(const PolygonMesh& mesh) {
  Constraints constraints = held_boundary(mesh);
  constraints.fix_position(0, mesh.position(0) + Vector3(0, 0, 0.01));
  return constraints;
}

/// Cancelled as soon as that is being done.
struct Cancelling : Context {
  explicit Cancelling(std::string_view stage) {
    threads = 2;
    on_progress = [this, stage](const Progress& progress) {
      if (cancelled() || progress.stage != stage) return;
      cancel();
      calls = ThreadTeam::calls_for_help();
    };
  }
  std::size_t calls = 0;  ///< for threads, until then
};

FitResult fit_own_nodes(const PolygonMesh& mesh, const FitCriterion& criterion, Context& context) {
  FitOptions options{.criterion = criterion};
  options.fair.distribution = Distribution::keep;
  return fit(mesh, held(mesh), {.positions = mesh.positions()}, options, context);
}

void expect_unchanged(const PolygonMesh& mesh, const FitResult& result) {
  const Constraints constraints = held(mesh);
  std::vector<Vector3> expected = mesh.positions();
  expected[0] = constraints.position(0);
  EXPECT_EQ(result.positions, expected);
  const FairReport& report = result.report.fair;
  EXPECT_EQ(report.outcome, Outcome::cancelled);
  EXPECT_EQ(report.nodes, mesh.node_count());
  EXPECT_EQ(report.faces, mesh.face_count());
  EXPECT_EQ(report.moving_nodes + report.fixed_positions, mesh.node_count());
}

TEST(CancelledFit, EndsItsPreparationAndMeasuresNothingLarge) {
  const PolygonMesh mesh = noisy_annulus(20'100);
  for (const FitCriterion& criterion : every_criterion) {
    Cancelling context("preparing");
    const FitResult result = fit_own_nodes(mesh, criterion, context);
    EXPECT_EQ(ThreadTeam::calls_for_help(), context.calls) << criterion.index();
    expect_unchanged(mesh, result);
    EXPECT_TRUE(result.distances.empty());
    EXPECT_EQ(result.report.before.all.count, 0);
    EXPECT_EQ(result.report.after.all.count, 0);
  }
}

TEST(CancelledFit, MeasuresASmallShape) {
  const PolygonMesh mesh = noisy_annulus(500);
  for (const FitCriterion& criterion : every_criterion) {
    Cancelling context("preparing");
    const FitResult result = fit_own_nodes(mesh, criterion, context);
    expect_unchanged(mesh, result);
    EXPECT_EQ(result.distances.size(), mesh.positions().size());
    const Index at_held = result.report.at_held.count;
    EXPECT_GT(at_held, 0);
    EXPECT_EQ(result.report.before.all.count, mesh.node_count() - at_held);
    EXPECT_EQ(result.report.after.all.count, mesh.node_count() - at_held);
    EXPECT_EQ(result.report.outliers, 0);
  }
}

TEST(CancelledFit, StopsTakingNoiseOff) {
  const PolygonMesh mesh = noisy_annulus(20'100);
  for (const FitCriterion& criterion : {FitCriterion(RootMeanSquare{0.001}), FitCriterion(Noise{0.001})}) {
    Cancelling context("taking noise off");
    const FitResult result = fit_own_nodes(mesh, criterion, context);
    EXPECT_TRUE(context.cancelled());
    EXPECT_EQ(ThreadTeam::calls_for_help(), context.calls) << criterion.index();
    expect_unchanged(mesh, result);
  }
}

TEST(CancelledFit, KeepsTheBestSoFar) {
  const PolygonMesh mesh = noisy_annulus(20'100);
  for (const FairingMethod& method : {FairingMethod(EquilibriumMethod{}), FairingMethod(SweepMethod{})}) {
    Cancelling context("fairing");
    FitOptions options{.criterion = Weight{0.01}};
    options.fair.method = method;
    const FitResult result = fit(mesh, held_boundary(mesh), {.positions = mesh.positions()}, options, context);
    EXPECT_EQ(result.report.fair.outcome, Outcome::cancelled);
    EXPECT_NE(result.positions, mesh.positions());
    EXPECT_GT(result.report.fair.rms_move, 0);
    EXPECT_TRUE(result.distances.empty());
    for (const Vector3& position : result.positions) ASSERT_TRUE(position.allFinite());
  }
}

TEST(Fit, CountsItsHeldNodesOnce) {
  const PolygonMesh mesh = noisy_annulus(500);
  Context context;
  for (const FitCriterion& criterion : every_criterion) {
    const FairReport report = fit_own_nodes(mesh, criterion, context).report.fair;
    EXPECT_EQ(report.moving_nodes + report.fixed_positions, mesh.node_count()) << criterion.index();
  }
}

TEST(CancelledFit, LooksInEveryLongLoop) {
  const PolygonMesh mesh = noisy_annulus(500);
  const Constraints constraints = held_boundary(mesh);
  Net net = gather_net(mesh, constraints);
  ThreadTeam team(1);
  std::vector<Index> own(mesh.positions().size());
  std::iota(own.begin(), own.end(), 0);
  const std::vector<double> ones(own.size(), 1);
  const std::vector<std::uint8_t> all(own.size(), 1);
  const auto length = std::make_shared<double>(0.1);
  const PointTies ties(net, mesh.positions(), ones, own, pull_by_smoothing(length));
  Net other = net;

  Context context;
  context.cancel();
  const auto ends = [&](const auto& work) {
    const CancellationScope scope(context);
    try {
      work();
      return false;
    } catch (const Cancelled&) {
      return true;
    }
  };
  EXPECT_TRUE(ends([&] { (void)Incidence(mesh); }));
  EXPECT_TRUE(ends([&] { (void)cut_into_triangles(mesh); }));
  EXPECT_TRUE(ends([&] { (void)check_constraints(mesh, constraints, {}); }));
  EXPECT_TRUE(ends([&] { (void)triangulated_patch(net); }));
  EXPECT_TRUE(ends([&] { (void)nearest_nodes(mesh.positions(), mesh.positions(), all, team); }));
  EXPECT_TRUE(ends([&] { (void)cluster_points(net.points, 0.1); }));
  EXPECT_TRUE(ends([&] { pull_by_smoothing(length)(other); }));
  EXPECT_TRUE(ends([&] { pull_by_edges(length)(other); }));
  EXPECT_TRUE(ends([&] { (void)PointTies(other, mesh.positions(), ones, own); }));
  EXPECT_TRUE(ends([&] { (void)scan_mesh(net, mesh); }));
  EXPECT_TRUE(ends([&] { (void)estimate_noise(mesh, context); }));
  EXPECT_TRUE(ends([&] { (void)point_distances(mesh.positions(), mesh, Context()); }));
}

TEST(CancelledFit, LeavesTiesAsTheyWere) {
  const PolygonMesh mesh = noisy_annulus(500);
  Net net = gather_net(mesh, held_boundary(mesh));
  std::vector<Index> own(mesh.positions().size());
  std::iota(own.begin(), own.end(), 0);
  const auto length = std::make_shared<double>(0.1);
  PointTies ties(net, mesh.positions(), std::vector<double>(own.size(), 1), own, pull_by_smoothing(length));
  net.points.are_nodes = true;
  const std::vector<double> factors = net.points.factors;
  *length = 0.2;
  ThreadTeam team(1);
  {
    Context context;
    context.cancel();
    const CancellationScope scope(context);
    EXPECT_THROW((void)ties.renew(team), Cancelled);
  }
  EXPECT_EQ(net.points.factors, factors);
  EXPECT_TRUE(ties.renew(team));
  EXPECT_NE(net.points.factors, factors) << "or it would show nothing";
}

TEST(CancelledFit, SweepsEndWithTheirTies) {
  const PolygonMesh mesh = noisy_annulus(500);
  Net net = gather_net(mesh, held_boundary(mesh));
  const auto model = surface_model(PseudoNormals::link);
  ThreadTeam team(1);
  Context context;
  int renewed = 0;
  SweepTask task{.step_tolerance = 0, .max_iterations = 100};
  task.renew_ties = [&] {
    if (++renewed < 3) return;
    context.cancel();
    end_if_cancelled();
  };
  const SweepResult result = sweep_until_still(net, *model, task, team, context);
  EXPECT_EQ(result.outcome, Outcome::cancelled);
  EXPECT_GT(result.iterations, 0);
  EXPECT_EQ(renewed, 3);
}

/// A task on a curve whose second node goes a step further with each shape, until measuring is broken off with the
/// third.
struct BrokenOff {
  BrokenOff() {
    curve_model_for(net, {})->update_directions(net, 0, net.computed);
    net.normals.assign(net.positions.size(), Vector3(0, 1, 0));  // as of a surface, for the interior-point method
    task.net = &net;
    task.length = std::make_shared<double>(1);
    task.update = [this](bool /*or_find*/) {
      net.positions[0].y() += step;
      return true;
    };
    task.ended = [] { return false; };
    task.measure = [this] {
      if (++measured == 3) throw Cancelled();
      return std::vector<double>(nodes.size(), tolerance / 2);
    };
    task.energy = [this] { return -net.positions[0].y(); };
  }

  static constexpr double tolerance = 0.01;
  static constexpr double step = 1e-5;
  std::vector<Vector3> nodes = {{-2, 0, 0}, {-1, 0.1, 0}, {0, 0.3, 0}, {1, 0.1, 0}, {2, 0, 0}};
  Net net = gather_net(PolygonCurve(nodes), held_ends(nodes));
  PointTies ties{net, nodes, std::vector<double>(5, 1), std::vector<Index>{0, 1, 2, 3, 4}};
  ToleranceFitTask task;
  int measured = 0;
  double start = net.positions[0].y();
};

TEST(CancelledFit, KeepsTheBestWithinATolerance) {
  const auto greatest = [](const std::vector<double>& all) { return *std::max_element(all.begin(), all.end()); };
  using Fit = std::function<ToleranceFitResult(const ToleranceFitTask&)>;
  const Fit fits[] = {
      [&](const ToleranceFitTask& task) { return smooth_within(task, BrokenOff::tolerance, greatest); },
      [](const ToleranceFitTask& task) { return hold_between(task, BrokenOff::tolerance, {.length = 1}); }};
  for (const Fit& fit : fits) {
    BrokenOff one;
    const std::vector<double> weights = one.net.points.weights;
    const std::vector<Vector3> places = one.net.points.positions;
    const ToleranceFitResult result = fit(one.task);
    EXPECT_EQ(one.measured, 3);
    EXPECT_TRUE(result.within);
    EXPECT_EQ(one.net.positions[0].y(), one.start + BrokenOff::step) << "the second shape";
    EXPECT_EQ(one.net.points.weights, weights);
    EXPECT_EQ(one.net.points.positions, places);
  }
}

}  // namespace
}  // namespace vspring::fit_cancellation_test
