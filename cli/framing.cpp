#include "framing.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vspring::cli {

namespace {

using Box3 = Eigen::AlignedBox<double, 3>;

constexpr double least_move = 1e-6;        // as a share of the size: more than rounding in single precision
constexpr double surroundings = 1.6;       // the part shown, relative to the part that moved
constexpr double largest_part = 0.5;       // as a share of the whole diagonal
constexpr double goes_round = 0.2;         // length of the mean unit normal, below which normals face everywhere
constexpr double least_side = 1e-6;        // as a share of what is shown, for parts without extent
constexpr double nearly_upright = 0.9999;  // cosine to z from which on z cannot be up in the picture

/// The nodes of faces or edges that moved, before and after.
class MovedPart {
 public:
  MovedPart(std::span<const Vector3> before, std::span<const Vector3> after, double size = 1)
      : before_(before), after_(after), least_(least_move * size), taken_(before.size(), 0) {}

  [[nodiscard]] bool moved(Index node) const {
    const auto i = static_cast<std::size_t>(node);
    return (after_[i] - before_[i]).cwiseAbs().maxCoeff() > least_;
  }
  /// Nodes of a face or an edge.
  void add(std::span<const Index> nodes) {
    const bool taken = std::any_of(nodes.begin(), nodes.end(), [&](Index node) { return moved(node); });
    for (const Index node : nodes) {
      const auto i = static_cast<std::size_t>(node);
      if (taken) taken_[i] = 1;
      for (const Vector3* position : {&before_[i], &after_[i]}) {
        all_.extend(*position);
        if (taken) box_.extend(*position);
      }
    }
  }

  void add(const std::vector<PolygonCurve::Chain>& chains) {
    for (const PolygonCurve::Chain& chain : chains) {
      for (std::size_t k = 1; k < chain.nodes.size(); ++k) add(std::span(chain.nodes).subspan(k - 1, 2));
      if (chain.closed && !chain.nodes.empty()) add(std::vector{chain.nodes.back(), chain.nodes.front()});
    }
  }

  [[nodiscard]] bool small() const {
    return !box_.isEmpty() && box_.diagonal().norm() > 0 &&
           box_.diagonal().norm() <= largest_part * all_.diagonal().norm();
  }

  /// The box in a view: to the right, upwards and towards the eye.
  [[nodiscard]] Box3 seen(const Eigen::Matrix3d& view) const {
    Box3 box;
    for (std::size_t i = 0; i < taken_.size(); ++i) {
      if (taken_[i] == 0) continue;
      for (const Vector3* position : {&before_[i], &after_[i]}) box.extend(Vector3(view * *position));
    }
    return box;
  }

  [[nodiscard]] ShownPart shown(const Eigen::Matrix3d& view) const {
    const Box3 box = seen(view);
    const Vector3 size = surroundings * box.sizes();
    return {.middle = view.transpose() * box.center(),
            .width = std::max(size.x(), least_side),
            .height = std::max(size.y(), least_side),
            .radius = std::max(size.norm() / 2, least_side)};
  }

 private:
  std::span<const Vector3> before_;
  std::span<const Vector3> after_;
  double least_;
  std::vector<char> taken_;
  Box3 all_;
  Box3 box_;
};

/// The vector area of a face.
Vector3 area_of(std::span<const Index> face, std::span<const Vector3> positions) {
  Vector3 area = Vector3::Zero();
  const Vector3& origin = positions[static_cast<std::size_t>(face[0])];
  for (std::size_t k = 1; k + 1 < face.size(); ++k)
    area += (positions[static_cast<std::size_t>(face[k])] - origin)
                .cross(positions[static_cast<std::size_t>(face[k + 1])] - origin) /
            2;
  return area;
}

/// Whether more of the other faces lie before the part than behind it.
bool is_hidden(const PolygonMesh& mesh, const MovedPart& part, std::span<const Vector3> positions,
               const Eigen::Matrix3d& view) {
  const Box3 place = part.seen(view);
  double before = 0;
  double behind = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    Box3 face;
    for (const Index node : mesh.face(f)) face.extend(Vector3(view * positions[static_cast<std::size_t>(node)]));
    const Vector3 common = face.intersection(place).sizes();
    if (!(common.x() > 0 && common.y() > 0)) continue;
    const double depth = face.center().z();
    if (depth > place.max().z()) before += common.x() * common.y();
    if (depth < place.min().z()) behind += common.x() * common.y();
  }
  return before > behind;
}

Eigen::Matrix3d view_along(const Vector3& direction) {
  return seen_from(direction, std::abs(direction.z()) > nearly_upright ? Vector3::UnitY() : Vector3::UnitZ());
}

Eigen::Matrix3d best_view(const PolygonMesh& mesh, const MovedPart& part, std::span<const Vector3> positions) {
  Vector3 sum = Vector3::Zero();
  double area = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (!std::any_of(face.begin(), face.end(), [&](Index node) { return part.moved(node); })) continue;
    const Vector3 own = area_of(face, positions);
    sum += own;
    area += own.norm();
  }
  if (!(sum.norm() > goes_round * area)) return default_view();
  const Eigen::Matrix3d view = view_along(sum.normalized());
  return is_hidden(mesh, part, positions, view) ? view_along(-sum.normalized()) : view;
}

}  // namespace

Eigen::Matrix3d seen_from(const Vector3& direction, const Vector3& up) {
  const Vector3 towards = direction.normalized();
  const Vector3 across = up.cross(towards).normalized();
  Eigen::Matrix3d rows;
  rows << across.transpose(), towards.cross(across).transpose(), towards.transpose();
  return rows;
}

Eigen::Matrix3d default_view() { return seen_from(Vector3(1, -2, 1.5), Vector3::UnitZ()); }

Plane plane_of(const std::vector<Vector3>& points) {
  constexpr double flat = 1e-9;  // as a share of the box's side: more than rounding, less than visible
  Plane plane;
  const bool level = std::all_of(points.begin(), points.end(),
                                 [&](const Vector3& p) { return std::abs(p.z() - points.front().z()) <= flat; });
  if (level) return plane;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points) centre += p / static_cast<double>(points.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) spread += (p - centre) * (p - centre).transpose();
  const Eigen::Matrix3d axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(spread).eigenvectors();
  Vector3 across = axes.col(2);
  Vector3 up = axes.col(1);
  if (across.sum() < 0) across = -across;
  if (up.sum() < 0) up = -up;
  plane.rows << across.transpose(), up.transpose(), across.cross(up).transpose();
  plane.planar = std::all_of(points.begin(), points.end(),
                             [&](const Vector3& p) { return std::abs((p - centre).dot(axes.col(0))) <= flat; });
  return plane;
}

Framing framing_of(const PolygonMesh& mesh, std::span<const Vector3> before, std::span<const Vector3> after,
                   const std::optional<Eigen::Matrix3d>& view) {
  MovedPart part(before, after);
  for (Index f = 0; f < mesh.face_count(); ++f) part.add(mesh.face(f));
  Framing framing{.view = view.value_or(default_view()), .part = std::nullopt};
  if (!part.small()) return framing;
  if (!view) framing.view = best_view(mesh, part, after);
  framing.part = part.shown(framing.view);
  return framing;
}

Framing framing_of(const std::vector<PolygonCurve::Chain>& chains, std::span<const Vector3> before,
                   std::span<const Vector3> after, const Eigen::Matrix3d& view) {
  MovedPart part(before, after);
  part.add(chains);
  Framing framing{.view = view, .part = std::nullopt};
  if (part.small()) framing.part = part.shown(view);
  return framing;
}

std::optional<Box3> moved_part(const PolygonCurve& before, const PolygonCurve& after) {
  if (!same_chains(before, after)) return std::nullopt;
  Box3 all;
  for (const PolygonCurve* curve : {&before, &after}) {
    for (const Vector3& position : curve->positions()) {
      if (!position.allFinite()) return std::nullopt;
      all.extend(position);
    }
  }
  MovedPart part(before.positions(), after.positions(), all.sizes().maxCoeff());
  part.add(after.chains());
  if (!part.small()) return std::nullopt;
  const Box3 box = part.seen(Eigen::Matrix3d::Identity());
  const Vector3 half = surroundings / 2 * box.sizes();
  return Box3(box.center() - half, box.center() + half);
}

bool same_chains(const PolygonCurve& curve, const PolygonCurve& other) {
  return curve.node_count() == other.node_count() &&
         std::ranges::equal(curve.chains(), other.chains(),
                            [](const PolygonCurve::Chain& a, const PolygonCurve::Chain& b) {
                              return a.closed == b.closed && a.nodes == b.nodes;
                            });
}

}  // namespace vspring::cli
