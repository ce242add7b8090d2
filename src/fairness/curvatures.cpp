#include "fairness/curvatures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "fairness/counted.hpp"
#include "fairness/jet.hpp"
#include "fairness/neighbourhood.hpp"
#include "shape/fan.hpp"
#include "spring/pseudo_normal.hpp"

namespace vspring {

namespace {

constexpr std::size_t jets_per_task = 1024;
// A node this high over the tangent plane, relative to its distance along it, is more than 70° around a sphere, or on
// the other side of a thin part: a height over the plane does not describe the way to it.
constexpr double steepest = 0.7;

/// A tangent plane with coordinates u, v.
struct Plane {
  Vector3 normal;
  Vector3 u = normal.unitOrthogonal();
  Vector3 v = normal.cross(u);
};

/// A node around, in the coordinates of the plane.
struct Point {
  double u;
  double v;
  double height;
  [[nodiscard]] double along2() const { return u * u + v * v; }
  [[nodiscard]] bool steep() const { return height * height > steepest * steepest * along2(); }
};

/// The jet and the length in which it is measured.
struct ScaledJet {
  Jet jet;
  double size = 1;
};

ScaledJet fit(std::vector<Point>& points) {
  if (points.empty()) return {};
  const auto steep = std::count_if(points.begin(), points.end(), [](const Point& point) { return point.steep(); });
  // At a spike everything is steep; it is better seen badly than not at all.
  if (2 * static_cast<std::size_t>(steep) < points.size())
    std::erase_if(points, [](const Point& p) { return p.steep(); });
  double squares = 0;
  for (const Point& point : points) squares += point.along2();
  const double size = std::sqrt(squares / static_cast<double>(points.size()));
  if (!(size > 0)) return {};
  JetFit fit;
  for (const Point& point : points) {
    const double distance2 = point.along2() / (size * size);
    fit.add(point.u / size, point.v / size, point.height / size, 1 / std::sqrt(0.25 + distance2));
  }
  return {fit.solve(), size};
}

/// The curvatures of the graph of a height function, and their derivatives, at the origin.
///
/// With h_i the derivatives of the height and W² = 1 + |∇h|², the second fundamental form is h_ij/W and its covariant
/// derivative, symmetric in all indices (Codazzi), C_ijk = (h_ijk − (h_ij g_k + h_jk g_i + h_ki g_j)/W²)/W, where
/// g_k = Σ_m h_m h_mk. In principal directions of unit length, the derivative of κ_i along e_j is ± C_iij.
void bend(const Jet& jet, double size, const Plane& plane, NodeCurvature& result) {
  const double p = jet.first[0];
  const double q = jet.first[1];
  const double w2 = 1 + p * p + q * q;
  const double w = std::sqrt(w2);
  result.normal = (plane.normal - p * plane.u - q * plane.v) / w;
  result.degree = jet.degree;
  if (jet.degree < 2) return;

  // Two tangents of unit length at right angles, in coordinates u, v.
  const double e = std::sqrt(1 + p * p);
  Eigen::Matrix2d frame;
  frame << 1 / e, -p * q / (e * w), 0, e / w;
  Eigen::Matrix2d hessian;
  hessian << jet.second[0], jet.second[1], jet.second[1], jet.second[2];
  const Eigen::Matrix2d form = frame.transpose() * hessian * frame / w;
  // Away from the normal is down, so the greatest curvature is the least of the form.
  const double angle = std::atan2(-2 * form(0, 1), form(1, 1) - form(0, 0)) / 2;
  const double cosine = std::cos(angle);
  const double sine = std::sin(angle);
  Eigen::Matrix2d turn;
  turn << cosine, -sine, sine, cosine;
  const Eigen::Matrix2d principal = frame * turn;
  const auto tangent = [&](Eigen::Index k) -> Vector3 {
    const double a = principal(0, k);
    const double b = principal(1, k);
    return a * plane.u + b * plane.v + (p * a + q * b) * plane.normal;
  };
  result.direction1 = tangent(0);
  result.direction2 = tangent(1);
  const Eigen::Matrix2d diagonal = principal.transpose() * hessian * principal / w;
  result.k1 = -diagonal(0, 0) / size;
  result.k2 = -diagonal(1, 1) / size;
  if (result.k1 < result.k2) std::swap(result.k1, result.k2);  // equal but for rounding
  if (jet.degree < 3) return;

  const Eigen::Vector2d g = hessian * Eigen::Vector2d(p, q);
  const auto derivative = [&](Eigen::Index i, Eigen::Index j, Eigen::Index k) {
    const Eigen::Vector2d a = principal.col(i);
    const Eigen::Vector2d b = principal.col(j);
    const Eigen::Vector2d c = principal.col(k);
    const double third = jet.third[0] * a[0] * b[0] * c[0] +
                         jet.third[1] * (a[0] * b[0] * c[1] + a[0] * b[1] * c[0] + a[1] * b[0] * c[0]) +
                         jet.third[2] * (a[0] * b[1] * c[1] + a[1] * b[0] * c[1] + a[1] * b[1] * c[0]) +
                         jet.third[3] * a[1] * b[1] * c[1];
    const double bent = a.dot(hessian * b) * g.dot(c) + b.dot(hessian * c) * g.dot(a) + c.dot(hessian * a) * g.dot(b);
    return -(third - bent / w2) / (w * size * size);
  };
  result.k1_along_1 = derivative(0, 0, 0);
  result.k1_along_2 = derivative(0, 0, 1);
  result.k2_along_1 = derivative(0, 1, 1);
  result.k2_along_2 = derivative(1, 1, 1);
}

/// Looks at nodes one by one; one per task.
class NodeFitter {
 public:
  NodeFitter(const PolygonMesh& mesh, const Incidence& incidence, const std::vector<Vector3>& positions)
      : positions_(&positions), walker_(mesh, incidence), neighbourhood_(mesh, incidence) {}

  NodeCurvature at(Index node) {
    NodeCurvature result;
    const Vector3& centre = position(node);
    if (!centre.allFinite()) return result;
    const Vector3 normal = LinkNormal()(centre, walker_.walk(node).links, *positions_);
    if (!normal.allFinite() || normal.isZero(0)) return result;
    result.normal = normal;
    const Plane plane{.normal = normal};
    ScaledJet scaled = look(node, Neighbourhood::enough, plane);
    if (scaled.jet.degree < 4) scaled = look(node, Neighbourhood::plenty, plane);
    if (scaled.jet.degree > 0) bend(scaled.jet, scaled.size, plane, result);
    return result;
  }

 private:
  ScaledJet look(Index node, std::size_t wanted, const Plane& plane) {
    points_.clear();
    for (const Index i : neighbourhood_.around(node, wanted)) {
      const Vector3 e = position(i) - position(node);
      if (!e.isZero(0)) points_.push_back({e.dot(plane.u), e.dot(plane.v), e.dot(plane.normal)});
    }
    return fit(points_);
  }

  [[nodiscard]] const Vector3& position(Index node) const { return (*positions_)[static_cast<std::size_t>(node)]; }

  const std::vector<Vector3>* positions_;
  FanWalker walker_;
  Neighbourhood neighbourhood_;
  std::vector<Point> points_;
};

}  // namespace

std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh, const Incidence& incidence, double scale,
                                      std::span<const std::uint8_t> marked, const Context& context, ThreadTeam& team) {
  // Only differences of positions matter. Were they moved to the origin, their last digits would depend on where it is.
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position *= scale;
  std::vector<NodeCurvature> result(positions.size());
  parallel_ranges(team, result.size(), jets_per_task, [&](std::size_t begin, std::size_t end) {
    if (context.cancelled()) return;
    NodeFitter fitter(mesh, incidence, positions);
    for (std::size_t i = begin; i < end; ++i) {
      if (marked.empty() || marked[i] != 0) result[i] = fitter.at(static_cast<Index>(i));
    }
  });
  return result;
}

std::vector<NodeCurvature> scaled(std::vector<NodeCurvature> values, double scale) {
  for (NodeCurvature& at : values) {
    for (double* k : {&at.k1, &at.k2}) *k /= scale;
    for (double* rate : {&at.k1_along_1, &at.k1_along_2, &at.k2_along_1, &at.k2_along_2}) *rate = *rate / scale / scale;
  }
  return values;
}

std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh, const Context& context) {
  const Frame frame(box_around(mesh, counted_faces(mesh, nullptr)));
  ThreadTeam team(context.thread_count());
  return scaled(curvatures(mesh, Incidence(mesh), frame.scale(), {}, context, team), 1 / frame.scale());
}

std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh) { return curvatures(mesh, Context()); }

}  // namespace vspring
