// A mesh that is faired again and again while its constraints move.

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fairing_session_test {
namespace {

using namespace support;

/// An annulus with both rims held, and the node in the middle of it that is held too.
struct Dragged {
  PolygonMesh mesh;
  Constraints constraints;
  Index node = 0;
};

Dragged dragged(Index nodes) {
  PolygonMesh mesh = generate::annulus({.nodes = nodes});
  Constraints constraints = clamped_boundary(mesh);
  Index node = 0;
  const Vector3 middle(0.65, 0, 0.3);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if ((mesh.position(i) - middle).norm() < (mesh.position(node) - middle).norm()) node = i;
  }
  const FairResult free = fair(mesh, constraints, {.method = equilibrium_alone()});
  constraints.fix_position(node, free.positions[static_cast<std::size_t>(node)]);
  return {std::move(mesh), std::move(constraints), node};
}

FairOptions to(double tolerance) { return {.method = equilibrium_alone(tolerance)}; }

TEST(FairingSession, FollowsWhatIsDragged) {
  for (const Index nodes : {800, 2400}) {
    Dragged one = dragged(nodes);
    const FairOptions options = to(1e-6);
    FairingSession session(one.mesh, options);
    const FairResult first = session.fair(one.constraints);
    ASSERT_EQ(first.report.outcome, Outcome::converged);
    EXPECT_STREQ(first.report.levels.back().strategy, "coarse to fine");
    EXPECT_EQ(first.positions, fair(one.mesh, one.constraints, options).positions);
    const double size = diagonal(one.mesh);
    for (int step = 0; step < 4; ++step) {
      one.constraints.fix_position(one.node, one.constraints.position(one.node) + Vector3(0.002, 0.001, 0.004));
      const FairResult followed = session.fair(one.constraints);
      const FairResult anew = fair(one.mesh, one.constraints, options);
      EXPECT_EQ(followed.report.outcome, Outcome::converged);
      EXPECT_EQ(followed.report.levels.size(), 1U) << "no coarser level is needed";
      EXPECT_STREQ(followed.report.levels.back().strategy, "from the last shape");
      EXPECT_LT(followed.report.iterations, 12);
      const double error = *followed.report.expected_error + *anew.report.expected_error;
      EXPECT_LT(greatest_distance(followed.positions, anew.positions), 3 * error * size);
      EXPECT_EQ(followed.positions[static_cast<std::size_t>(one.node)], one.constraints.position(one.node));
    }
  }
}

TEST(FairingSession, FollowsNormalsThatTurn) {
  Dragged one = dragged(1000);
  const FairOptions options = to(1e-6);
  FairingSession session(one.mesh, options);
  (void)session.fair(one.constraints);
  for (const double tilt : {0.05, 0.1}) {
    for (Index i = 0; i < one.mesh.node_count(); ++i) {
      if (one.constraints.normal_fixed(i) && one.mesh.position(i).head<2>().norm() > 0.9)
        one.constraints.fix_normal(i, Vector3(tilt * one.mesh.position(i).x(), tilt * one.mesh.position(i).y(), 1));
    }
    const FairResult followed = session.fair(one.constraints);
    const FairResult anew = fair(one.mesh, one.constraints, options);
    EXPECT_EQ(followed.report.outcome, Outcome::converged);
    EXPECT_EQ(followed.report.levels.size(), 1U);
    const double error = *followed.report.expected_error + *anew.report.expected_error;
    EXPECT_LT(greatest_distance(followed.positions, anew.positions), 3 * error * diagonal(one.mesh));
  }
}

/// Where the inner rim has been dragged to after so many steps of 0.3 % of the size: to and fro, and round.
Vector3 way_of(int step) {
  const double turn = 0.15 * step;
  return {0.04 * std::sin(turn), 0.03 * std::sin(0.7 * turn), 0.04 * (1 - std::cos(turn))};
}

TEST(FairingSession, PicturesOfADragStayWithinTheirTolerance) {
  const PolygonMesh mesh = generate::annulus({.nodes = 1000});
  const double tolerance = 2e-4;
  for (const bool normals_held : {false, true}) {
    Constraints constraints(mesh.node_count());
    fix_boundary_positions(constraints, mesh);
    if (normals_held) fix_boundary_normals(constraints, mesh);
    FairingSession session(mesh, {.method = equilibrium_alone()});
    (void)session.fair(constraints);
    Context context;
    int iterations = 0;
    for (int step = 1; step <= 100; ++step) {
      for (Index i = 0; i < mesh.node_count(); ++i) {
        if (constraints.position_fixed(i) && mesh.position(i).head<2>().norm() < 0.5)
          constraints.fix_position(i, mesh.position(i) + way_of(step));
      }
      const FairResult seen = session.update(constraints, tolerance, context);
      ASSERT_EQ(seen.report.outcome, Outcome::converged) << step;
      ASSERT_EQ(seen.report.levels.size(), 1U) << step;
      EXPECT_LT(*seen.report.expected_error, tolerance);
      iterations += seen.report.iterations;
      if (step % 10 != 0) continue;
      const FairResult anew = fair(mesh, constraints, {.method = equilibrium_alone()});
      EXPECT_LT(greatest_distance(seen.positions, anew.positions), 3 * tolerance * diagonal(mesh)) << step;
    }
    EXPECT_LT(iterations, 200) << "hardly more than one a picture";
  }
}

TEST(FairingSession, PicturesOfNormalsThatTurnStayWithinTheirTolerance) {
  Dragged one = dragged(1500);
  FairingSession session(one.mesh, to(1e-5));
  (void)session.fair(one.constraints);
  Context context;
  const double tolerance = 2e-4;
  for (int step = 1; step <= 20; ++step) {
    const double tilt = 0.01 * step;
    for (Index i = 0; i < one.mesh.node_count(); ++i) {
      if (one.constraints.normal_fixed(i) && one.mesh.position(i).head<2>().norm() > 0.9)
        one.constraints.fix_normal(i, Vector3(tilt * one.mesh.position(i).x(), tilt * one.mesh.position(i).y(), 1));
    }
    const FairResult seen = session.update(one.constraints, tolerance, context);
    ASSERT_EQ(seen.report.levels.size(), 1U);
    if (step % 5 != 0) continue;
    const FairResult anew = fair(one.mesh, one.constraints, to(1e-5));
    EXPECT_LT(greatest_distance(seen.positions, anew.positions), 3 * tolerance * diagonal(one.mesh)) << step;
  }
}

TEST(FairingSession, ForeseesWhereADragLeadsAndStaysAsItIs) {
  const PolygonMesh mesh = generate::annulus({.nodes = 3000});
  const double tolerance = 2e-4;
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  FairingSession looks_ahead(mesh, to(1e-5));
  FairingSession does_not(mesh, to(1e-5));
  EXPECT_FALSE(looks_ahead.predict(constraints, tolerance)) << "from where?";
  Context context;
  std::vector<Vector3> before = looks_ahead.fair(constraints).positions;
  (void)does_not.fair(constraints);
  std::vector<double> shares;  // of how far nodes go, of what was foreseen wrong
  for (int step = 1; step <= 8; ++step) {
    for (Index i = 0; i < mesh.node_count(); ++i) {
      if (constraints.position_fixed(i) && mesh.position(i).head<2>().norm() < 0.5)
        constraints.fix_position(i, mesh.position(i) + way_of(step));
    }
    const auto foreseen = looks_ahead.predict(constraints, tolerance);
    ASSERT_TRUE(foreseen);
    const FairResult seen = looks_ahead.update(constraints, tolerance, context);
    EXPECT_EQ(seen.positions, does_not.update(constraints, tolerance, context).positions);
    for (Index i = 0; i < mesh.node_count(); ++i) {
      if (constraints.position_fixed(i)) {
        EXPECT_EQ((*foreseen)[static_cast<std::size_t>(i)], constraints.position(i));
      }
    }
    shares.push_back(greatest_distance(*foreseen, seen.positions) / greatest_distance(before, seen.positions));
    before = seen.positions;
  }
  EXPECT_LT(shares.front(), 0.3);
  EXPECT_LT(shares.back(), 0.1);
  constraints.free_position(0);
  EXPECT_FALSE(looks_ahead.predict(constraints, tolerance)) << "what is held is not what was held";
}

TEST(FairingSession, PausesOfADragDoNotMisleadIt) {
  Dragged one = dragged(1500);
  FairingSession session(one.mesh, to(1e-5));
  (void)session.fair(one.constraints);
  Context context;
  const double tolerance = 2e-4;
  const Vector3 start = one.constraints.position(one.node);
  // Hardly a move, and then a far one: what the small ones left unfinished says nothing of that.
  for (int step = 0; step < 6; ++step) {
    const double height = step % 2 == 0 ? 0.01 * step + 1e-6 : 0.01 * (step + 1);
    one.constraints.fix_position(one.node, start + Vector3(0, 0, height));
    const FairResult seen = session.update(one.constraints, tolerance, context);
    EXPECT_EQ(seen.report.levels.size(), 1U);
    EXPECT_LT(seen.report.iterations, 5);
  }
}

TEST(FairingSession, OtherNodesHeldAreFairedAnew) {
  Dragged one = dragged(800);
  const FairOptions options = to(1e-6);
  FairingSession session(one.mesh, options);
  (void)session.fair(one.constraints);
  one.constraints.free_position(one.node);
  EXPECT_EQ(session.fair(one.constraints).positions, fair(one.mesh, one.constraints, options).positions);
}

/// The outer rim of an annulus at another size.
Constraints with_rim(const Dragged& one, double size) {
  Constraints constraints = one.constraints;
  for (Index i = 0; i < one.mesh.node_count(); ++i) {
    if (constraints.normal_fixed(i) && one.mesh.position(i).head<2>().norm() > 0.9)
      constraints.fix_position(i, size * one.mesh.position(i));
  }
  return constraints;
}

TEST(FairingSession, AFarStepIsFollowedAndOneTooFarIsFairedAnew) {
  Dragged one = dragged(1000);
  const FairOptions options = to(1e-6);
  one.constraints.free_position(one.node);
  // Three times as large; and within the inner rim, so that the surface folds over.
  for (const double size : {3.0, 0.2}) {
    FairingSession session(one.mesh, options);
    (void)session.fair(one.constraints);
    const Constraints constraints = with_rim(one, size);
    const FairResult result = session.fair(constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    const FairResult anew = fair(one.mesh, constraints, options);
    const double error = *result.report.expected_error + *anew.report.expected_error;
    EXPECT_LT(greatest_distance(result.positions, anew.positions), 3 * error * 3 * diagonal(one.mesh));
    if (size > 1) {
      EXPECT_EQ(result.report.levels.size(), 1U);
      EXPECT_LT(result.report.iterations, 12);
    } else {
      EXPECT_GT(result.report.levels.size(), 1U) << "not on the shape itself alone";
    }
  }
}

TEST(FairingSession, APlaceThatIsNoneIsRefusedAndNothingIsLost) {
  Dragged one = dragged(800);
  FairingSession session(one.mesh, to(1e-6));
  const FairResult first = session.fair(one.constraints);
  Constraints wrong = one.constraints;
  wrong.fix_position(one.node, Vector3(0, std::nan(""), 0));
  try {
    (void)session.fair(wrong);
    FAIL() << "it was taken";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(std::to_string(one.node)), std::string::npos) << error.what();
  }
  const FairResult again = session.fair(one.constraints);
  EXPECT_EQ(again.report.outcome, Outcome::converged);
  EXPECT_LT(greatest_distance(again.positions, first.positions), 1e-5 * diagonal(one.mesh));
}

TEST(FairingSession, CancelledItGoesOnTheNextTime) {
  Dragged one = dragged(800);
  FairingSession session(one.mesh, to(1e-6));
  const FairResult first = session.fair(one.constraints);
  const Constraints before = one.constraints;
  one.constraints.fix_position(one.node, one.constraints.position(one.node) + Vector3(0, 0, 0.01));
  Context context;
  context.cancel();
  EXPECT_EQ(session.fair(one.constraints, context).report.outcome, Outcome::cancelled);
  context.reset();
  EXPECT_EQ(session.fair(before, context).positions, first.positions) << "it stayed where it was";
  const FairResult result = session.fair(one.constraints, context);
  EXPECT_EQ(result.report.outcome, Outcome::converged);
  EXPECT_EQ(result.report.levels.size(), 1U) << "from the shape before";
  const FairResult anew = fair(one.mesh, one.constraints, to(1e-6));
  EXPECT_LT(greatest_distance(result.positions, anew.positions), 1e-5 * diagonal(one.mesh));
}

TEST(FairingSession, HoldsNodesThatCannotMoveAndFollowsAllTheSame) {
  Dragged one = dragged(800);
  MeshBuilder builder;
  for (const Vector3& p : one.mesh.positions()) builder.add_node(p);
  for (Index f = 0; f < one.mesh.face_count(); ++f) builder.add_face(one.mesh.face(f));
  // A fin on an edge far from what is dragged.
  const auto face = [&] {
    for (Index f = 0;; ++f) {
      const auto nodes = one.mesh.face(f);
      if (one.mesh.position(nodes[0]).x() < -0.6 && !one.constraints.position_fixed(nodes[0]) &&
          !one.constraints.position_fixed(nodes[1]))
        return nodes;
    }
  }();
  const Index tip = builder.add_node(one.mesh.position(face[0]) + Vector3(0, 0, 1));
  const std::vector<Index> fin = {face[0], face[1], tip};
  builder.add_face(fin);
  const PolygonMesh mesh = builder.take();
  Constraints constraints = clamped_boundary(mesh);
  constraints.free_position(face[0]);
  constraints.free_position(face[1]);
  constraints.fix_position(tip, mesh.position(tip));
  constraints.fix_position(one.node, one.constraints.position(one.node));
  FairingSession session(mesh, to(1e-6));
  for (int step = 0; step < 3; ++step) {
    constraints.fix_position(one.node, constraints.position(one.node) + Vector3(0.002, 0.001, 0.004));
    const FairResult result = session.fair(constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    ASSERT_EQ(result.report.warnings.size(), 1U);
    EXPECT_EQ(result.report.warnings[0].text.substr(0, 33), "2 nodes cannot move and are held:");
    EXPECT_EQ(result.positions[static_cast<std::size_t>(face[0])], mesh.position(face[0]));
    if (step > 0) {
      EXPECT_EQ(result.report.levels.size(), 1U) << "no coarser level is needed";
    }
  }
}

TEST(FairingSession, OtherMethodsFairAnewEveryTime) {
  Dragged one = dragged(800);
  const FairOptions options = {.method = MultigridMethod{}};
  FairingSession session(one.mesh, options);
  (void)session.fair(one.constraints);
  one.constraints.fix_position(one.node, one.constraints.position(one.node) + Vector3(0, 0, 0.01));
  EXPECT_EQ(session.fair(one.constraints).positions, fair(one.mesh, one.constraints, options).positions);
}

TEST(FairingSession, SaysThatADragFoldsTheShapeAndComesBackFromIt) {
  const PolygonMesh mesh = generate::plane({.columns = 12, .rows = 12});
  Constraints constraints = held_boundary(mesh);
  const Index node = 6 * 13 + 6;
  FairingSession session(mesh, to(1e-6));
  Context context;
  const auto drag_to = [&](double way) {
    constraints.fix_position(node, mesh.position(node) + Vector3(way, 0, 0));
    return session.update(constraints, 1e-4, context);
  };
  EXPECT_EQ(drag_to(0).report.outcome, Outcome::converged);
  Outcome outcome = Outcome::converged;
  double way = 0;
  for (; way < 0.9 && outcome == Outcome::converged; way += 0.02) outcome = drag_to(way).report.outcome;
  ASSERT_EQ(outcome, Outcome::worse_than_input) << "over the rim";
  EXPECT_GT(way, 0.45) << "up to there nodes about it go along";
  const FairResult far = session.fair(constraints, context);
  EXPECT_EQ(far.report.outcome, Outcome::converged) << "afresh it need not fold";
  EXPECT_EQ(far.positions[node], constraints.position(node));
  for (const Vector3& p : far.positions) EXPECT_TRUE(p.allFinite());
  EXPECT_EQ(drag_to(0.02).report.outcome, Outcome::converged);
}

TEST(FairingSession, ADragThatCameThroughFoldsEndsWhereTheMeshLeads) {
  // Pictures that come back from folds may have another equilibrium.
  const PolygonMesh mesh = generate::plane({.columns = 12, .rows = 12});
  Constraints constraints = held_boundary(mesh);
  const Index node = 6 * 13 + 6;
  FairingSession session(mesh, to(1e-6));
  Context context;
  const auto drag_to = [&](double way) {
    constraints.fix_position(node, mesh.position(node) + Vector3(way, 0, 0));
    return session.update(constraints, 1e-4, context).report.outcome;
  };
  Outcome outcome = Outcome::converged;
  for (double way = 0; way < 0.9 && outcome == Outcome::converged; way += 0.02) outcome = drag_to(way);
  ASSERT_EQ(outcome, Outcome::worse_than_input);
  ASSERT_EQ(drag_to(0.02), Outcome::converged);
  EXPECT_EQ(session.fair(constraints, context).positions, fair(mesh, constraints, to(1e-6)).positions);
}

TEST(FairingSession, ThreadsGiveTheSameBits) {
  std::vector<std::vector<Vector3>> shapes;
  for (const int threads : {1, 3}) {
    Dragged one = dragged(4600);
    FairingSession session(one.mesh, to(1e-6), threads);
    (void)session.fair(one.constraints);
    one.constraints.fix_position(one.node, one.constraints.position(one.node) + Vector3(0, 0, 0.005));
    std::vector<Vector3> shape = session.fair(one.constraints).positions;
    for (int step = 1; step < 4; ++step) {
      one.constraints.fix_position(one.node, one.constraints.position(one.node) + Vector3(0, 0.001, 0.003));
      Context context;
      const FairResult seen = session.update(one.constraints, 2e-4, context);
      shape.insert(shape.end(), seen.positions.begin(), seen.positions.end());
    }
    shapes.push_back(std::move(shape));
  }
  EXPECT_EQ(shapes[0], shapes[1]);
}

TEST(FairingSession, FairsCurvesAsTheyAreFairedAlone) {
  const std::vector<Vector3> nodes = {{0, 0, 0}, {1, 0.3, 0}, {2, -0.2, 0}, {3, 0.4, 0}, {4, 0, 0}};
  const PolygonCurve curve(nodes);
  Constraints held(curve.node_count());
  held.fix_position(0, nodes[0]);
  held.fix_position(4, nodes[4]);
  FairingSession session(curve, to(1e-8));
  for (const double height : {0.2, 0.5}) {
    held.fix_position(2, {2, height, 0});
    EXPECT_EQ(session.fair(held).positions, fair(curve, held, to(1e-8)).positions);
    Context context;
    EXPECT_EQ(session.update(held, 1e-3, context).positions, fair(curve, held, to(1e-3)).positions);
    EXPECT_FALSE(session.predict(held, 1e-3).has_value());
    EXPECT_THROW((void)session.update(held, 0, context), Error);
  }
}

}  // namespace
}  // namespace vspring::fairing_session_test
