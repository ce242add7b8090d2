#include "fairness/curvatures.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "fairness/counted.hpp"
#include "fairness/jet.hpp"
#include "shape/arcs.hpp"
#include "shape/direction.hpp"
#include "shape/frame.hpp"
#include "spring/pseudo_normal.hpp"

namespace vspring {

namespace {

constexpr std::size_t jets_per_task = 1024;
// A node this high over the tangent plane, relative to its distance along it, is more than 70° away on a sphere, or on
// the other side of a thin part: its height over the plane does not describe the surface.
constexpr double steepest = 0.7;

/// A tangent plane with coordinates u, v.
struct Plane {
  Vector3 normal;
  Vector3 u = normal.unitOrthogonal();
  Vector3 v = normal.cross(u);
};

constexpr auto most_points = static_cast<int>(JetFit::most_points);
using Numbers = Eigen::Array<double, Eigen::Dynamic, 1, Eigen::ColMajor, most_points, 1>;

}  // namespace

/// Nodes around, in the coordinates of the plane.
class CurvatureFitter::Points {
 public:
  void clear() noexcept { count_ = 0; }
  void add(double u, double v, double height) {
    u_[count_] = u;
    v_[count_] = v;
    height_[count_] = height;
    ++count_;
  }

  /// The jet and the length in which it is measured.
  struct ScaledJet {
    Jet jet;
    double size = 1;
  };

  ScaledJet fit() {
    if (count_ == 0) return {};
    leave_steep_ones_out();
    double squares = 0;
    for (Eigen::Index k = 0; k < count_; ++k) squares += along2(k);
    const double size = std::sqrt(squares / static_cast<double>(count_));
    if (!(size > 0)) return {};
    const auto u = u_.head(count_);
    const auto v = v_.head(count_);
    const Numbers distance2 = (u * u + v * v) / (size * size);
    const Numbers weight = 1 / (0.25 + distance2).sqrt();
    const Numbers scaled_u = u / size;
    const Numbers scaled_v = v / size;
    const Numbers scaled_height = height_.head(count_) / size;
    fit_.clear();
    for (Eigen::Index k = 0; k < count_; ++k) fit_.add(scaled_u[k], scaled_v[k], scaled_height[k], weight[k]);
    return {fit_.solve(), size};
  }

 private:
  [[nodiscard]] double along2(Eigen::Index k) const { return u_[k] * u_[k] + v_[k] * v_[k]; }
  [[nodiscard]] bool steep(Eigen::Index k) const { return height_[k] * height_[k] > steepest * steepest * along2(k); }

  /// At a spike all nodes are steep; a poor estimate is better than none.
  void leave_steep_ones_out() {
    Eigen::Index steep_ones = 0;
    for (Eigen::Index k = 0; k < count_; ++k) steep_ones += steep(k) ? 1 : 0;
    if (steep_ones == 0 || 2 * steep_ones >= count_) return;
    const Eigen::Index all = std::exchange(count_, 0);
    for (Eigen::Index k = 0; k < all; ++k) {
      if (!steep(k)) add(u_[k], v_[k], height_[k]);
    }
  }

  Numbers u_ = Numbers(most_points);
  Numbers v_ = Numbers(most_points);
  Numbers height_ = Numbers(most_points);
  Eigen::Index count_ = 0;
  JetFit fit_;
};

namespace {

/// Axes along and across an edge. Nodes of a grid at a boundary lie on a few lines along an axis then, so that the fit
/// finds monomials dependent, as it does not with axes at another angle.
Plane plane_along(const Vector3& normal, const Vector3& edge) {
  const Vector3 u = direction(edge - normal * normal.dot(edge), edge.norm());
  return u.isZero(0) ? Plane{.normal = normal} : Plane{.normal = normal, .u = u};
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
  // Curvature is positive away from the normal, so the greatest is the least of the form.
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

}  // namespace

CurvatureFitter::CurvatureFitter(const FaceNeighbours& neighbours)
    : neighbourhood_(neighbours), points_(std::make_unique<Points>()) {}

CurvatureFitter::~CurvatureFitter() = default;

void CurvatureFitter::go_to(Index node, std::span<const Link> links) {
  node_ = node;
  links_ = links;
  neighbourhood_.go_to(node);
}

NodeCurvature CurvatureFitter::at(const ScaledPositions& positions) {
  NodeCurvature result;
  const Vector3 centre = positions[static_cast<std::size_t>(node_)];
  if (!centre.allFinite()) return result;
  const Vector3 normal = LinkNormal()(centre, links_, positions);
  if (!normal.allFinite() || normal.isZero(0)) return result;
  result.normal = normal;
  const Plane plane = plane_along(normal, positions[links_.front().node()] - centre);
  const auto look = [&](std::size_t wanted) {
    points_->clear();
    for (const Index i : neighbourhood_.around(wanted)) {
      const Vector3 e = positions[static_cast<std::size_t>(i)] - centre;
      if (!e.isZero(0)) points_->add(e.dot(plane.u), e.dot(plane.v), e.dot(plane.normal));
    }
    return points_->fit();
  };
  Points::ScaledJet scaled = look(Neighbourhood::enough);
  if (scaled.jet.degree < 4) scaled = look(Neighbourhood::plenty);
  if (scaled.jet.degree > 0) bend(scaled.jet, scaled.size, plane, result);
  return result;
}

NodeCurvature scaled(NodeCurvature at, double scale) {
  for (double* k : {&at.k1, &at.k2}) *k /= scale;
  for (double* rate : {&at.k1_along_1, &at.k1_along_2, &at.k2_along_1, &at.k2_along_2}) *rate = *rate / scale / scale;
  return at;
}

std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh, const Context& context) {
  const Frame frame(box_around(mesh, counted_faces(mesh, nullptr)));
  ThreadTeam team(context.thread_count());
  const Incidence incidence(mesh);
  const FaceNeighbours neighbours(mesh, incidence, finite_nodes(mesh), team);
  const ScaledPositions positions(mesh.positions(), frame.scale());
  std::vector<NodeCurvature> result(mesh.positions().size());
  parallel_ranges(team, result.size(), jets_per_task, [&](std::size_t begin, std::size_t end) {
    if (context.cancelled()) return;
    FanWalker walker(mesh, incidence);
    CurvatureFitter fitter(neighbours);
    for (std::size_t i = begin; i < end; ++i) {
      const auto node = static_cast<Index>(i);
      fitter.go_to(node, walker.walk(node).links);
      result[i] = scaled(fitter.at(positions), 1 / frame.scale());
    }
  });
  return result;
}

std::vector<NodeCurvature> curvatures(const PolygonMesh& mesh) { return curvatures(mesh, Context()); }

std::vector<double> curvatures(const PolygonCurve& curve) {
  Eigen::AlignedBox<double, 3> box;
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    for (const Index node : chain.nodes) {
      if (curve.position(node).allFinite()) box.extend(curve.position(node));
    }
  }
  const Frame frame(box);
  std::vector<double> result(static_cast<std::size_t>(curve.node_count()), 0);
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    const auto at = [&](std::size_t k) { return frame.to_local(curve.position(chain.nodes[k % count])); };
    const std::size_t ends = chain.closed ? 0 : 1;
    for (std::size_t k = ends; k + ends < count; ++k)
      result[static_cast<std::size_t>(chain.nodes[k])] =
          frame.scale() * circle_curvature(at(k + count - 1), at(k), at(k + 1)).norm();
  }
  return result;
}

}  // namespace vspring
