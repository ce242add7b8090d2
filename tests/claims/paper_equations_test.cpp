// The paper's iteration, to the letter: Figs. 3 and 5 and Eqs. 4, 5, 8 and 9 written down once more in plain loops,
// from its text alone, against what the library makes of the same shapes with its choices.

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "support/curves.hpp"
#include "support/specimens.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::paper_equations_test {
namespace {

using namespace support;

// Of the extent of shapes of about 1: what rounding leaves of sums in another order.
constexpr double rounding = 1e-14;
constexpr int every_number_of_iterations[] = {1, 2, 5};

enum class Kind { surface, planar_curve, space_curve };

/// What the paper's text says of one shape.
class Rewrite {
 public:
  Rewrite(const PolygonMesh& mesh, const Constraints& constraints)
      : kind_(Kind::surface), p_(mesh.positions()), held_(constraints) {
    for (Index f = 0; f < mesh.face_count(); ++f) polygons_.emplace_back(mesh.face(f).begin(), mesh.face(f).end());
    begin();
  }

  /// plane: the normal of the curve's plane, where it has one.
  Rewrite(const PolygonCurve& curve, const Constraints& constraints, const std::optional<Vector3>& plane)
      : kind_(plane ? Kind::planar_curve : Kind::space_curve),
        plane_(plane.value_or(Vector3::Zero())),
        p_(curve.positions()),
        held_(constraints) {
    for (const auto& chain : curve.chains()) {
      for (std::size_t k = 0; k + 1 < chain.nodes.size(); ++k)
        polygons_.push_back({chain.nodes[k], chain.nodes[k + 1]});
      if (chain.closed) polygons_.push_back({chain.nodes.back(), chain.nodes.front()});
    }
    begin();
  }

  void draw_to(const std::vector<Vector3>& points, double k) {
    v_ = points;
    k_ = k;
  }

  /// The loops of Figs. 3 and 5.
  std::vector<Vector3> iterate(int iterations) {
    for (int iteration = 0; iteration < iterations; ++iteration) {
      for (std::size_t f = 0; f < polygons_.size(); ++f) face_normals_[f] = normal_of(polygons_[f]);
      for (std::size_t i = 0; i < p_.size(); ++i) n_[i] = pseudo_normal(i);
      if (iteration % 5 == 0) connect_points();
      for (std::size_t i = 0; i < p_.size(); ++i) {
        if (held_.position_fixed(static_cast<Index>(i)) || ring_[i].empty()) continue;
        const Vector3 dp = by_springs(i);
        const Vector3 dpu = by_distribution(i);
        const Vector3 dpc = by_points(i);
        p_[i] = p_[i] + (dp + dpu + dpc);
      }
    }
    return p_;
  }

 private:
  void begin() {
    ring_.resize(p_.size());
    around_.resize(p_.size());
    face_normals_.resize(polygons_.size());
    for (std::size_t f = 0; f < polygons_.size(); ++f) {
      const auto& polygon = polygons_[f];
      for (const Index node : polygon) around_[static_cast<std::size_t>(node)].push_back(f);
      const std::size_t edges = polygon.size() == 2 ? 1 : polygon.size();
      for (std::size_t k = 0; k < edges; ++k) {
        const Index a = polygon[k];
        const Index b = polygon[(k + 1) % polygon.size()];
        join(a, b);
        join(b, a);
      }
    }
    for (std::size_t i = 0; i < p_.size(); ++i) {
      if (held_.position_fixed(static_cast<Index>(i))) p_[i] = held_.position(static_cast<Index>(i));
    }
    n_.assign(p_.size(), Vector3::Zero());
  }

  void join(Index from, Index to) {
    auto& ring = ring_[static_cast<std::size_t>(from)];
    if (std::find(ring.begin(), ring.end(), static_cast<std::size_t>(to)) == ring.end())
      ring.push_back(static_cast<std::size_t>(to));
  }

  [[nodiscard]] const Vector3& place(Index i) const { return p_[static_cast<std::size_t>(i)]; }

  /// Of a face, or in the curve's plane of a segment.
  [[nodiscard]] Vector3 normal_of(const std::vector<Index>& polygon) const {
    if (polygon.size() == 2) return plane_.cross(place(polygon[1]) - place(polygon[0])).normalized();
    Vector3 area = Vector3::Zero();
    for (std::size_t k = 1; k + 1 < polygon.size(); ++k)
      area += (place(polygon[k]) - place(polygon[0])).cross(place(polygon[k + 1]) - place(polygon[0]));
    return area.normalized();
  }

  /// §4.2, §4.5, §4.8.
  Vector3 pseudo_normal(std::size_t i) {
    const auto node = static_cast<Index>(i);
    if (held_.normal_fixed(node)) return held_.normal(node);
    if (kind_ == Kind::planar_curve && held_.tangent_fixed(node)) return plane_.cross(held_.tangent(node));
    if (kind_ == Kind::space_curve) return principal_normal(i);
    Vector3 sum = Vector3::Zero();
    for (const std::size_t f : around_[i]) sum += face_normals_[f];
    return sum.norm() > 0 ? Vector3(sum.normalized()) : sum;
  }

  [[nodiscard]] Vector3 principal_normal(std::size_t i) const {
    std::optional<Vector3> before;
    std::optional<Vector3> after;
    for (const std::size_t f : around_[i]) {
      const auto& segment = polygons_[f];
      if (segment[1] == static_cast<Index>(i)) before = place(segment[0]);
      if (segment[0] == static_cast<Index>(i)) after = place(segment[1]);
    }
    if (!before || !after) return Vector3::Zero();
    const Vector3 tangent = (*after - *before).normalized();
    const Vector3 across = (p_[i] - *before).cross(*after - p_[i]);
    if (across.isZero(0)) return Vector3::Zero();
    return across.normalized().cross(tangent).normalized();
  }

  /// Eqs. 4, 5 and 8.
  [[nodiscard]] Vector3 by_springs(std::size_t i) const {
    Vector3 sum = Vector3::Zero();
    double weights = 0;
    for (const std::size_t j : ring_[i]) {
      const Vector3 nj = n_[i].dot(n_[j]) < 0 ? Vector3(-n_[j]) : n_[j];
      const double difference = (p_[j] - p_[i]).dot(n_[i] + nj) / (1 + n_[i].dot(nj));
      const double weight = 1 / (p_[i] - p_[j]).norm();
      sum += weight * difference * n_[i];
      weights += weight;
    }
    return sum / weights;
  }

  /// §4.4.
  [[nodiscard]] Vector3 by_distribution(std::size_t i) const {
    Vector3 mean = Vector3::Zero();
    for (const std::size_t j : ring_[i]) mean += p_[j];
    const Vector3 dpu0 = mean / static_cast<double>(ring_[i].size()) - p_[i];
    return dpu0 - dpu0.dot(n_[i]) * n_[i];
  }

  void connect_points() {
    nearest_.resize(v_.size());
    for (std::size_t j = 0; j < v_.size(); ++j) {
      for (std::size_t i = 0; i < p_.size(); ++i) {
        if ((p_[i] - v_[j]).norm() < (p_[nearest_[j]] - v_[j]).norm()) nearest_[j] = i;
      }
    }
  }

  /// Eq. 9. What is "sufficiently large" for w_j is that of a hundredth of the node's mean edge.
  [[nodiscard]] Vector3 by_points(std::size_t i) const {
    double mean_edge = 0;
    for (const std::size_t j : ring_[i]) mean_edge += (p_[j] - p_[i]).norm() / static_cast<double>(ring_[i].size());
    Vector3 sum = Vector3::Zero();
    double weights = 0;
    for (std::size_t j = 0; j < v_.size(); ++j) {
      if (nearest_[j] != i) continue;
      const double height = (v_[j] - p_[i]).dot(n_[i]);
      const Vector3 foot = v_[j] - height * n_[i];
      const double weight = 1 / std::max((p_[i] - foot).norm(), 0.01 * mean_edge);
      sum += weight * k_ * height * n_[i];
      weights += weight;
    }
    return weights > 0 ? Vector3(sum / weights) : sum;
  }

  Kind kind_;
  Vector3 plane_ = Vector3::Zero();
  std::vector<Vector3> p_;
  std::vector<Vector3> n_;
  std::vector<std::vector<Index>> polygons_;      // or segments
  std::vector<Vector3> face_normals_;             // of these
  std::vector<std::vector<std::size_t>> around_;  // which of these adjoin each node
  std::vector<std::vector<std::size_t>> ring_;
  Constraints held_;
  std::vector<Vector3> v_;
  double k_ = 0;
  std::vector<std::size_t> nearest_;
};

FairOptions as_printed(int iterations) {
  FairOptions options;
  options.method =
      SweepMethod{.step_tolerance = 1e-300, .max_iterations = iterations, .order = SweepOrder::file, .keep_last = true};
  options.pseudo_normals = PseudoNormals::average;
  options.springs = Springs::edge;
  options.forces = Forces::printed;
  options.curve = CurveRules::paper();
  options.distribution = Distribution::even;
  options.accept_worse = true;
  return options;
}

template <typename Shape>
void expect_same(const Shape& shape, const Constraints& held, const Rewrite& rewrite, const std::string& name) {
  for (const int iterations : every_number_of_iterations) {
    Rewrite copy = rewrite;
    const std::vector<Vector3> expected = copy.iterate(iterations);
    const std::vector<Vector3> found = fair(shape, held, as_printed(iterations)).positions;
    EXPECT_LT(greatest_distance(found, expected), rounding) << name << ", " << iterations << " iterations";
    EXPECT_GT(greatest_distance(found, shape.positions()), 1e-3) << name;
  }
}

/// growth: of what rounding leaves.
template <typename Shape>
void expect_same(const Shape& shape, const Constraints& held, const std::vector<Vector3>& points, double k,
                 Rewrite rewrite, const std::string& name, double growth = 1) {
  rewrite.draw_to(points, k);
  for (const int iterations : every_number_of_iterations) {
    Rewrite copy = rewrite;
    const std::vector<Vector3> expected = copy.iterate(iterations);
    FitOptions options{.criterion = Weight{k}};
    options.fair = as_printed(iterations);
    const FitResult found = fit(shape, held, {.positions = points}, options);
    EXPECT_LT(greatest_distance(found.positions, expected), growth * rounding)
        << name << ", " << iterations << " iterations";
    const FairResult without = fair(shape, held, options.fair);
    EXPECT_GT(greatest_distance(found.positions, without.positions), 1e-3) << name;
  }
}

PolygonMesh rough(const PolygonMesh& mesh, double noise = 0.03) { return generate::add_noise(mesh, noise, 7); }

/// Places beside the nodes.
std::vector<Vector3> beside(const std::vector<Vector3>& nodes, double distance, int each, bool planar) {
  Draw draw(3);
  std::vector<Vector3> points;
  for (const Vector3& node : nodes) {
    for (int k = 0; k < each; ++k) {
      Vector3 offset = draw.in_cube(distance);
      if (planar) offset.z() = 0;
      points.emplace_back(node + offset);
    }
  }
  return points;
}

/// Two flat n-gons of many sides and a few hexagons between: every second node of a rim has two neighbours.
PolygonMesh lens(Index sides) {
  MeshBuilder builder;
  std::vector<Index> upper;
  std::vector<Index> lower;
  Draw draw(11);
  for (Index k = 0; k < sides; ++k) {
    const double angle = 2 * std::numbers::pi * k / sides;
    const Vector3 around(std::cos(angle), std::sin(angle), 0);
    upper.push_back(builder.add_node(around + Vector3(0, 0, 0.2 + draw.uniform(-0.01, 0.01))));
    lower.push_back(builder.add_node(around - Vector3(0, 0, 0.2 + draw.uniform(-0.01, 0.01))));
  }
  for (Index k = 0; k < sides; k += 2) {
    const auto at = [&](Index n) { return static_cast<std::size_t>((k + n) % sides); };
    builder.add_face({lower[at(0)], lower[at(1)], lower[at(2)], upper[at(2)], upper[at(1)], upper[at(0)]});
  }
  builder.add_face(upper);
  std::reverse(lower.begin(), lower.end());
  builder.add_face(lower);
  return builder.take();
}

TEST(PaperEquations, AreWhatOpenSurfacesOfEveryKindOfFaceDo) {
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh mesh =
        rough(generate::saddle({.columns = 8, .rows = 8, .faces = faces, .jitter = 0.3, .seed = 5}, 1));
    for (const Constraints& held : {held_boundary(mesh), clamped_boundary(mesh)})
      expect_same(mesh, held, Rewrite(mesh, held), name_of(faces));
  }
  const PolygonMesh pentagon = rough(generate::polygon_patch({.sides = 5, .rings = 4}));
  const Constraints held = held_boundary(pentagon);
  expect_same(pentagon, held, Rewrite(pentagon, held), "a pentagon among quads");
}

TEST(PaperEquations, AreWhatClosedSurfacesDo) {
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh mesh = rough(generate::torus({.columns = 12, .rows = 8, .faces = faces}, 1, 0.4));
    Constraints held(mesh.node_count());
    for (const Index i : {0, 17, 40, 61}) held.fix_position(i, mesh.position(i) + Vector3(0.01, 0, 0.02));
    held.fix_normal(5, Vector3(0.1, 0.2, 1).normalized());
    held.fix_normal(40, Vector3(0.3, -0.2, 1).normalized());
    expect_same(mesh, held, Rewrite(mesh, held), name_of(faces));
  }
}

TEST(PaperEquations, AreWhatSurfacesThatPointsDrawDo) {
  for (const generate::Faces faces : every_kind) {
    const PolygonMesh mesh = rough(generate::saddle({.columns = 8, .rows = 8, .faces = faces}, 1));
    const Constraints held = held_boundary(mesh);
    for (const double k : {0.3, 0.9})
      expect_same(mesh, held, beside(mesh.positions(), 0.04, 2, false), k, Rewrite(mesh, held), name_of(faces));
  }
}

TEST(PaperEquations, GivePolygonsOfManySidesTheirOwnMeanNormal) {
  for (const Index sides : {128, 130, 400}) {
    const PolygonMesh patch = rough(generate::polygon_patch({.sides = sides, .rings = 3}), 0.02);
    const Constraints held = held_boundary(patch);
    expect_same(patch, held, Rewrite(patch, held), "patch of " + std::to_string(sides));
    const PolygonMesh both = lens(sides);
    Constraints some(both.node_count());
    for (Index i = 0; i < both.node_count(); i += 7) some.fix_position(i, both.position(i));
    expect_same(both, some, Rewrite(both, some), "lens of " + std::to_string(sides));
    // Where most of the polygon takes no part.
    Constraints most(both.node_count());
    for (Index i = 0; i < both.node_count(); ++i) {
      if (i != 10 && i != 12 && i != 13) most.fix_position(i, both.position(i));
    }
    expect_same(both, most, Rewrite(both, most), "a corner of a lens of " + std::to_string(sides));
  }
}

TEST(PaperEquations, GoOnWhereStepsGrow) {
  const PolygonMesh mesh = generate::saddle({.columns = 12, .rows = 12}, 1);
  const Constraints held = held_boundary(mesh);
  std::vector<Vector3> points = mesh.positions();
  for (Vector3& point : points) point.z() += 0.001;
  // Each iteration nearly doubles the distance from the points: the last step is over ten times as long as the first.
  const double k = 2.9;
  expect_same(mesh, held, points, k, Rewrite(mesh, held), "large weights", 10);
  FitOptions options{.criterion = Weight{k}};
  options.fair = as_printed(5);
  const std::vector<double> steps = fit(mesh, held, {.positions = points}, options).report.fair.history;
  EXPECT_GT(steps.back(), 10 * steps.front());
}

TEST(PaperEquations, AreThoseOfTheOneLevelOfAVCycle) {
  const PolygonMesh mesh = rough(generate::saddle({.columns = 8, .rows = 8}, 1));
  const Constraints held = held_boundary(mesh);
  FairOptions options = as_printed(0);
  options.method = MultigridMethod{
      .step_tolerance = 1e-300, .max_iterations = 5, .levels = 1, .order = SweepOrder::file, .keep_last = true};
  EXPECT_LT(greatest_distance(fair(mesh, held, options).positions, Rewrite(mesh, held).iterate(5)), rounding);
}

TEST(PaperEquations, MoveTheBoundaryFirst) {
  const PolygonMesh mesh = generate::add_noise(generate::saddle({.columns = 8, .rows = 8}, 1), 0.03, 7, true);
  const PolygonCurve boundary = boundary_curve(mesh);
  const std::vector<std::uint8_t> on_boundary = boundary_nodes(mesh);
  Constraints some(mesh.node_count());
  for (const Index corner : {0, 8, 72, 80}) some.fix_position(corner, mesh.position(corner));
  for (const int iterations : every_number_of_iterations) {
    FairOptions options = as_printed(iterations);
    options.fair_boundary = options.method;
    const FairResult found = fair(mesh, some, options);
    std::vector<Vector3> expected = Rewrite(boundary, some, {}).iterate(iterations);
    Constraints held(mesh.node_count());
    for (Index i = 0; i < mesh.node_count(); ++i) {
      if (on_boundary[static_cast<std::size_t>(i)] != 0) held.fix_position(i, expected[static_cast<std::size_t>(i)]);
    }
    expected = Rewrite(mesh, held).iterate(iterations);
    EXPECT_LT(greatest_distance(found.positions, expected), rounding) << iterations;
    ASSERT_TRUE(found.report.boundary);
    EXPECT_EQ(found.report.boundary->method, Method::sweep);
    EXPECT_EQ(found.report.boundary->iterations, iterations);
  }
}

std::vector<Vector3> wave(int edges) {
  std::vector<Vector3> nodes;
  for (const double t : places(Spacing::random, edges))
    nodes.emplace_back(2 * t, 0.4 * std::sin(2 * std::numbers::pi * t), 0);
  return nodes;
}

std::vector<Vector3> ring(int edges, double height) {
  std::vector<Vector3> nodes;
  for (int k = 0; k < edges; ++k) {
    const double angle = 2 * std::numbers::pi * k / edges;
    nodes.emplace_back(std::cos(angle), std::sin(angle), height * std::sin(3 * angle));
  }
  return nodes;
}

TEST(PaperEquations, AreWhatCurvesInAPlaneDo) {
  const Vector3 plane = Vector3::UnitZ();
  const std::vector<Vector3> clean = wave(24);
  const std::vector<Vector3> nodes = noisy(clean, held_ends(clean), 0.02, 5, true);
  const PolygonCurve open(nodes);
  Constraints held = held_ends(nodes);
  expect_same(open, held, Rewrite(open, held, plane), "ends alone");
  held.fix_tangent(0, heading(0.4));
  held.fix_normal(24, heading(1.8));
  hold(held, nodes, 9);
  held.fix_normal(12, heading(1.2));
  expect_same(open, held, Rewrite(open, held, plane), "directions");
  expect_same(open, held, beside(nodes, 0.03, 2, true), 0.4, Rewrite(open, held, plane), "points");

  const std::vector<Vector3> around = noisy(ring(20, 0), Constraints(20), 0.05, 3, true);
  const PolygonCurve closed(around, true);
  Constraints some(20);
  hold(some, around, 0);
  hold(some, around, 7);
  expect_same(closed, some, Rewrite(closed, some, plane), "closed");
}

TEST(PaperEquations, LetStraightRunsOfPlaneCurvesHaveNormals) {
  const Vector3 plane = Vector3::UnitZ();
  const std::vector<Vector3> nodes = straight(Vector3::Zero(), Vector3(3, 0, 0), places(Spacing::even, 12));
  const PolygonCurve line(nodes);
  const Constraints bent = held_ends(nodes, heading(0.4), heading(-0.4));
  expect_same(line, bent, Rewrite(line, bent, plane), "end tangents");
  const Constraints ends = held_ends(nodes);
  std::vector<Vector3> points;
  points.reserve(nodes.size());
  for (const Vector3& node : nodes) points.emplace_back(node + Vector3(0, 0.1 * std::sin(node.x()), 0));
  expect_same(line, ends, points, 0.5, Rewrite(line, ends, plane), "points");
}

TEST(PaperEquations, AreWhatCurvesInSpaceDo) {
  const std::vector<Vector3> around = noisy(ring(24, 0.5), Constraints(24), 0.04, 3, false);
  const PolygonCurve closed(around, true);
  Constraints some(24);
  hold(some, around, 0);
  hold(some, around, 9);
  some.fix_normal(4, Vector3(-0.6, 0.8, 0));
  expect_same(closed, some, Rewrite(closed, some, {}), "closed");
  expect_same(closed, some, beside(around, 0.05, 2, false), 0.4, Rewrite(closed, some, {}), "points");

  // A straight run, whose nodes have no normal, before a helix.
  std::vector<Vector3> nodes;
  nodes.reserve(26);
  for (int k = 0; k < 6; ++k) nodes.emplace_back(0.25 * k - 1.5, 0, 0);
  for (int k = 0; k < 20; ++k)
    nodes.emplace_back(std::sin(0.3 * k), 1 - std::cos(0.3 * k), 0.02 * k * (1 + 0.1 * (k % 3)));
  const PolygonCurve open(nodes);
  Constraints held = held_ends(nodes);
  held.fix_normal(0, Vector3::UnitY());
  held.fix_normal(25, Vector3(-0.6, 0.8, 0));
  expect_same(open, held, Rewrite(open, held, {}), "open");
}

}  // namespace
}  // namespace vspring::paper_equations_test
