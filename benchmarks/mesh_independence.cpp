// How far the equilibrium depends on the mesh: the funnel between circles of radius 1 and 0.35, 0.5 apart, on rings of
// triangles and of quads, wide and narrow, on even, random and graded meshes, refined. Distances of all nodes' radii
// and heights from the meridian of the surface of rotation that V-Spring stands for where a mesh looks alike in all
// directions and everywhere: the Laplacian of its mean curvature vanishes; or of the one of least bending. Prints the
// figures of docs/notes/edge-springs.md and springs.md; `bench_mesh_independence 8000` stops at that many nodes,
// `bench_mesh_independence 8000 edge` takes edge springs, `bench_mesh_independence 8000 bending` fairs by bending.

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "support/fairness_of.hpp"
#include "support/methods.hpp"
#include "support/specimens.hpp"

namespace {

using namespace vspring;
using namespace support;

constexpr double inner_radius = 0.35;
constexpr double height = 0.5;
constexpr double pi = std::numbers::pi;

/// The meridian r(s), z(s) with the angle ψ of its tangent: 2H = ψ' + sin ψ / r, and r H' is constant, or where bending
/// is least its derivative is −2 r H (H² − K).
struct Meridian {
  double part = 0;                ///< of that derivative
  std::vector<Vector3> points;    ///< (r, 0, z), from the outer circle inwards
  std::vector<double> conformal;  ///< ∫ ds / r up to every point

  using State = Eigen::Matrix<double, 6, 1>;  // r, z, ψ, H, r H', conformal

  /// Level at both circles where clamped, else without curvature across them.
  Meridian(bool clamped, FairBy fair_by) {
    Vector3 unknown = clamped ? Vector3(-5.6, 4, 0.95) : Vector3(pi - std::atan2(height, 1 - inner_radius), 0, 0.82);
    solve(clamped, unknown);
    // From shape to shape, as there are others that bend less than all nearby.
    for (int k = 1; k <= 4 && fair_by == FairBy::bending; ++k) {
      part = 0.25 * k;
      solve(clamped, unknown);
    }
    shoot(clamped, unknown, &points, &conformal);
  }

  /// Newton's method.
  void solve(bool clamped, Vector3& unknown) const {
    for (int k = 0; k < 60; ++k) {
      const Vector3 miss = missed_by(clamped, unknown);
      Eigen::Matrix3d slope;
      for (int j = 0; j < 3; ++j) slope.col(j) = (missed_by(clamped, unknown + 1e-6 * Vector3::Unit(j)) - miss) / 1e-6;
      const Vector3 step = slope.fullPivLu().solve(miss);
      unknown -= std::min(1.0, 0.3 / step.norm()) * step;
      if (step.norm() < 1e-13) break;
    }
  }

  /// What the far end misses. unknown: curvature (clamped) or angle at the outer circle, r H' there, length.
  [[nodiscard]] Vector3 missed_by(bool clamped, const Vector3& unknown) const {
    const State end = shoot(clamped, unknown, nullptr, nullptr);
    const double last = clamped ? end[2] - pi : 2 * end[3] - std::sin(end[2]) / end[0];
    return {end[0] - inner_radius, end[1] - height, last};
  }

  State shoot(bool clamped, const Vector3& unknown, std::vector<Vector3>* path, std::vector<double>* conformals) const {
    const auto slope = [&](const State& at) {
      const double around = std::sin(at[2]) / at[0];
      const double difference = at[3] - around;  // half that of the principal curvatures
      const double force = -2 * part * at[0] * at[3] * difference * difference;
      State change;
      change << std::cos(at[2]), std::sin(at[2]), 2 * at[3] - around, at[4] / at[0], force, 1 / at[0];
      return change;
    };
    State at;
    at << 1, 0, clamped ? pi : unknown[0], clamped ? unknown[0] / 2 : std::sin(unknown[0]) / 2, unknown[1], 0;
    constexpr int steps = 4000;
    const double h = unknown[2] / steps;
    for (int k = 0;; ++k) {
      if (path != nullptr) {
        path->emplace_back(at[0], 0, at[1]);
        conformals->push_back(at[5]);
      }
      if (k == steps) return at;
      const State a = slope(at);
      const State b = slope(at + 0.5 * h * a);
      const State c = slope(at + 0.5 * h * b);
      at += h / 6 * (a + 2 * b + 2 * c + slope(at + h * c));
    }
  }

  /// The point of the surface after a share of the meridian's length.
  [[nodiscard]] Vector3 at(double share, double angle) const {
    const double place = std::clamp(share, 0.0, 1.0) * static_cast<double>(points.size() - 1);
    const auto k = std::min(static_cast<std::size_t>(place), points.size() - 2);
    const Vector3 p = points[k] + (place - static_cast<double>(k)) * (points[k + 1] - points[k]);
    return {p.x() * std::cos(angle), p.x() * std::sin(angle), p.z()};
  }

  /// The share at which ∫ ds / r has a value.
  [[nodiscard]] double share_at(double value) const {
    const auto above = std::upper_bound(conformal.begin() + 1, conformal.end() - 1, value);
    const double fraction = (value - *(above - 1)) / (*above - *(above - 1));
    return (static_cast<double>(above - 1 - conformal.begin()) + fraction) / static_cast<double>(conformal.size() - 1);
  }
};

/// Triangles in a plane under Delaunay's condition, of nodes that move about.
class MovingDelaunay {
 public:
  MovingDelaunay(std::vector<Vector3> points, const PolygonMesh& mesh) : points_(std::move(points)) {
    std::map<std::pair<Index, Index>, Side> sides;
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      triangles_.push_back({face[0], face[1], face[2]});
      across_.push_back({Side{}, Side{}, Side{}});
      for (int k = 0; k < 3; ++k) {
        const auto found = sides.find({corner(f, k + 1), corner(f, k)});
        if (found == sides.end()) {
          sides[{corner(f, k), corner(f, k + 1)}] = {f, k};
        } else {
          join({f, k}, found->second);
        }
      }
    }
  }

  /// Moves nodes at random by up to reach[node] where no triangle turns over, then restores Delaunay's condition.
  void shake(const std::vector<double>& reach, Random& random) {
    const std::vector<Vector3> before = points_;
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const Vector3 step = random.in_ball();
      points_[i] += reach[i] * Vector3(step.x(), step.y(), 0);
    }
    for (bool whole = false; !whole;) {
      whole = true;
      for (Index f = 0; f < static_cast<Index>(triangles_.size()); ++f) {
        if (turn(corner(f, 0), corner(f, 1), corner(f, 2)) > 0) continue;
        whole = false;
        for (int k = 0; k < 3; ++k) points_[corner(f, k)] = before[corner(f, k)];
      }
    }
    for (bool flipped = true; flipped;) {
      flipped = false;
      for (Index f = 0; f < static_cast<Index>(triangles_.size()); ++f) {
        for (int k = 0; k < 3; ++k) flipped = flip({f, k}) || flipped;
      }
    }
  }

  [[nodiscard]] const std::vector<Vector3>& points() const { return points_; }
  [[nodiscard]] PolygonMesh mesh(const std::vector<Vector3>& positions) const {
    MeshBuilder builder;
    for (const Vector3& p : positions) builder.add_node(p);
    for (const auto& triangle : triangles_) builder.add_face(triangle);
    return builder.take();
  }

 private:
  /// Of a triangle, from corner k to the next.
  struct Side {
    Index triangle = -1;
    int k = 0;
  };

  [[nodiscard]] Index corner(Index f, int k) const { return triangles_[f][k % 3]; }
  [[nodiscard]] double turn(Index a, Index b, Index c) const {
    return (points_[b] - points_[a]).cross(points_[c] - points_[a]).z();
  }
  void join(Side a, Side b) {
    if (a.triangle >= 0) across_[a.triangle][a.k] = b;
    if (b.triangle >= 0) across_[b.triangle][b.k] = a;
  }

  bool flip(Side side) {
    const Side other = across_[side.triangle][side.k];
    if (other.triangle < 0) return false;
    const Index a = corner(side.triangle, side.k);
    const Index b = corner(side.triangle, side.k + 1);
    const Index c = corner(side.triangle, side.k + 2);
    const Index d = corner(other.triangle, other.k + 2);
    const auto cotangent = [&](Index at) { return (points_[a] - points_[at]).dot(points_[b] - points_[at]); };
    const double sum = cotangent(c) * turn(a, d, b) + cotangent(d) * turn(a, b, c);
    if (sum > -1e-12 * std::abs(cotangent(c) * turn(a, d, b)) || turn(a, d, c) <= 0 || turn(d, b, c) <= 0) return false;
    const Side after_b = across_[side.triangle][(side.k + 1) % 3];
    const Side after_c = across_[side.triangle][(side.k + 2) % 3];
    const Side after_a = across_[other.triangle][(other.k + 1) % 3];
    const Side after_d = across_[other.triangle][(other.k + 2) % 3];
    triangles_[side.triangle] = {a, d, c};
    triangles_[other.triangle] = {d, b, c};
    join({side.triangle, 0}, after_a);
    join({side.triangle, 1}, {other.triangle, 2});
    join({side.triangle, 2}, after_c);
    join({other.triangle, 0}, after_d);
    join({other.triangle, 1}, after_b);
    return true;
  }

  std::vector<Vector3> points_;
  std::vector<std::array<Index, 3>> triangles_;
  std::vector<std::array<Side, 3>> across_;
};

/// Spacing alike everywhere on the surface, connectivity at random.
PolygonMesh random_mesh(const Meridian& meridian, Index nodes) {
  const PolygonMesh even = generate::funnel(nodes);
  const std::vector<std::uint8_t> boundary = boundary_nodes(even);
  const double edge = std::sqrt(4.0 / nodes);
  const auto flattened_radius = [&](double share) {
    const auto k = static_cast<std::size_t>(share * static_cast<double>(meridian.conformal.size() - 1));
    return std::exp(-meridian.conformal[k]);
  };
  std::vector<Vector3> flat;
  std::vector<double> reach;
  for (Index i = 0; i < nodes; ++i) {
    const Vector3& p = even.position(i);
    const double share = std::clamp(p.z() / height, 0.0, 1.0);
    const double radius = flattened_radius(share);
    flat.push_back(radius * Vector3(p.x(), p.y(), 0).normalized());
    const double scale = radius / meridian.at(share, 0).x();
    reach.push_back(boundary[static_cast<std::size_t>(i)] != 0 ? 0 : 0.3 * edge * scale);
  }
  Random random(7);
  MovingDelaunay delaunay(std::move(flat), even);
  for (int k = 0; k < 12; ++k) delaunay.shake(reach, random);
  std::vector<Vector3> positions;
  for (const Vector3& p : delaunay.points())
    positions.push_back(meridian.at(meridian.share_at(-std::log(p.norm())), std::atan2(p.y(), p.x())));
  return delaunay.mesh(positions);
}

struct Kind {
  std::string name;
  std::function<PolygonMesh(Index nodes)> make;
  Distribution distribution = Distribution::even;
  Index most = 100'000;  ///< nodes; beyond, it takes minutes to end nowhere
};

/// Rings with so many times as many columns as rows; ratio: of the longest rows to the shortest, turn: of the widest
/// columns to the narrowest.
Kind rings(const std::string& name, const Meridian& meridian, generate::Faces faces, double columns, double ratio = 1,
           double turn = 1, Distribution distribution = Distribution::even, Index most = 100'000) {
  return {name,
          [=, &meridian](Index nodes) {
            const int rows = static_cast<int>(std::lround(std::sqrt(nodes / columns)));
            const int wide = 4 * static_cast<int>(std::lround(columns * rows / 4));
            const PolygonMesh tube = generate::tube({.columns = wide, .rows = rows, .faces = faces}, 1, 1);
            std::vector<Vector3> positions;
            for (const Vector3& p : tube.positions()) {
              const double around = std::atan2(p.y(), p.x()) / (2 * pi);
              positions.push_back(
                  meridian.at(graded(p.z(), ratio), 2 * pi * graded(around < 0 ? around + 1 : around, turn)));
            }
            return with_positions(tube, std::move(positions));
          },
          distribution, most};
}

std::vector<Kind> kinds(const Meridian& meridian) {
  using generate::Faces;
  return {
      rings("rings of triangles", meridian, Faces::triangles, 4.5),
      rings("rings of triangles, narrow", meridian, Faces::triangles, 9),
      rings("rings of triangles, wide", meridian, Faces::triangles, 2.25, 1, 1, Distribution::even, 3000),
      rings("rings of quads", meridian, Faces::quads, 4.5),
      rings("rings of quads, narrow", meridian, Faces::quads, 9),
      {"even", [](Index nodes) { return generate::funnel(nodes); }},
      {"random", [&](Index nodes) { return random_mesh(meridian, nodes); }},
      rings("rings of triangles, rows 10 : 1, kept", meridian, Faces::triangles, 4.5, 10, 1, Distribution::keep),
      rings("rings of quads, rows 10 : 1, kept", meridian, Faces::quads, 4.5, 10, 1, Distribution::keep),
      rings("rings of triangles, columns 10 : 1", meridian, Faces::triangles, 4.5, 1, 10, Distribution::even, 3000),
      rings("rings of quads, columns 10 : 1", meridian, Faces::quads, 4.5, 1, 10, Distribution::even, 3000),
      rings("rings of triangles, wide, smooth", meridian, Faces::triangles, 2.25, 1, 1, Distribution::smooth, 10'000),
      rings("rings of quads, wide, smooth", meridian, Faces::quads, 2.25, 1, 1, Distribution::smooth, 10'000),
      rings("rings of triangles, columns 10 : 1, smooth", meridian, Faces::triangles, 4.5, 1, 10, Distribution::smooth,
            10'000),
      rings("rings of quads, columns 10 : 1, smooth", meridian, Faces::quads, 4.5, 1, 10, Distribution::smooth,
            10'000)};
}

}  // namespace

int main(int argc, char** argv) {
  const int last = argc > 1 ? std::atoi(argv[1]) : 32'000;
  const std::string way = argc > 2 ? argv[2] : "";
  const FairBy fair_by = way == "bending" ? FairBy::bending : FairBy::curvature;
  for (const bool clamped : {true, false}) {
    const Meridian meridian(clamped, fair_by);
    fmt::print(
        "\n{}:\n\n| mesh | nodes | rms distance | greatest | greatest turn, ° | iterations |\n"
        "|---|---|---|---|---|---|\n",
        clamped ? "Positions and normals held" : "Positions held");
    for (const Kind& kind : kinds(meridian)) {
      for (Index nodes = 500; nodes <= std::min(last, kind.most); nodes *= 4) {
        const PolygonMesh start = kind.make(nodes);
        const Constraints constraints =
            clamped ? held_boundary(start, [](const Vector3&) { return Vector3::UnitZ(); }) : held_boundary(start);
        const FairOptions options = {.method = equilibrium_alone(1e-7),
                                     .springs = way == "edge" ? Springs::edge : Springs::sphere,
                                     .fair_by = fair_by,
                                     .distribution = kind.distribution};
        const FairResult result = fair(start, constraints, options);
        std::vector<Vector3> profile;
        for (const Vector3& p : result.positions) profile.emplace_back(p.head<2>().norm(), 0, p.z());
        const Distance off = distance(profile, PolygonCurve(meridian.points));
        fmt::print("| {} | {} | {:.1e} | {:.1e} | {:.0f} | {}{} |\n", kind.name, start.node_count(), off.rms,
                   off.greatest, fairness_of(start, constraints, result.positions).after.greatest_turn,
                   result.report.iterations,
                   result.report.outcome == Outcome::converged ? "" : fmt::format(", {}", name(result.report.outcome)));
        std::fflush(stdout);
      }
    }
  }
  return 0;
}
