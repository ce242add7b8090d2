#include "spring/sphere_springs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <utility>
#include <vector>

#include "shape/direction.hpp"
#include "spring/bending_factor.hpp"
#include "spring/height_equations.hpp"
#include "spring/laplacian_row.hpp"
#include "spring/link_edges.hpp"
#include "spring/net.hpp"

namespace vspring {

namespace {

// Shares of the diagonal of the normal equations: for forms that four neighbours do not determine, and for slopes that
// so few nodes do not.
constexpr double ridge_of_forms = 1e-4;
constexpr double ridge_of_slopes = 1e-6;
// As a share of 4 M, the sum in the plane of the Laplacian's entries times squared edges.
constexpr double least_spread = 2;
// Weight of heights over the neighbours' planes, relative to heights over a given normal's tangent plane: removes terms
// of third order if the neighbours' normals are computed.
constexpr double of_neighbours = 0.5;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// The traceless form q of heights, and the slopes by which to tilt the plane.
struct HeightFit {
  double q1 = 0;
  double q2 = 0;
  double slope1 = 0;
  double slope2 = 0;
};

HeightEquations<5> equations_inside(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& normal,
                                    const Vector3& t1, const Vector3& t2) {
  return equations_of_heights<5>(
      net, i, edges, t1, t2, {ridge_of_forms, ridge_of_forms, 0, 0, 0}, {0, 0, ridge_of_slopes, ridge_of_slopes, 0},
      [&](std::size_t, const Vector3& e) { return e.dot(normal); },
      [](double u, double v, double square) {
        return Unknowns<5>{u * u - v * v, 2 * u * v, -u, -v, square};
      });
}

template <typename Height>
HeightFit fit_given(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& t1, const Vector3& t2,
                    const Height& height) {
  auto [a, x] = equations_of_heights<3>(net, i, edges, t1, t2, {ridge_of_forms, ridge_of_forms, 0}, {0, 0, 0}, height,
                                        [](double u, double v, double square) {
                                          return Unknowns<3>{u * u - v * v, 2 * u * v, square};
                                        });
  solve_in_place(a, x);
  return {x[0], x[1], 0, 0};
}

/// At a rim along t1: no curvature across it.
HeightFit fit_rim(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& normal, const Vector3& t1,
                  const Vector3& t2) {
  auto [a, x] = equations_of_heights<4>(
      net, i, edges, t1, t2, {0, ridge_of_forms, 0, 0}, {0, 0, ridge_of_slopes, ridge_of_slopes},
      [&](std::size_t, const Vector3& e) { return e.dot(normal); },
      [](double u, double v, double) {
        return Unknowns<4>{2 * u * u, 2 * u * v, -u, -v};
      });
  solve_in_place(a, x);
  return {x[0], x[1], x[2], x[3]};
}

/// Two tangents perpendicular to a normal and each other.
std::pair<Vector3, Vector3> tangents_of(const Vector3& normal) {
  const Vector3 t1 = normal.unitOrthogonal();
  return {t1, normal.cross(t1)};
}

/// Sets the divisor of forces on a node.
void find_weight(Net& net, std::size_t i, const LinkEdges& edges) {
  const auto links = edges.links();
  double squares = 0;
  double spokes = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    squares += edges.square(k);
    spokes += 1;
  }
  const double mean_square = spokes > 0 ? squares / spokes : 0;
  net.spheres.weights[i] = 16 * net.spheres.areas[i] / std::max(mean_square * mean_square, net.tiny * net.tiny);
}

/// The curvature from the row: Σ K (height − q) / Σ K |e|².
template <typename Height>
double curvature_by_row(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& t1, const Vector3& t2,
                        const HeightFit& fit, const Height& height) {
  const auto links = edges.links();
  const double* row = net.spheres.stiffness.data() + net.rings.begin(i);
  const RowSpread spread = spread_of_row(net, i, edges);
  double sum = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vector3& e = edges[k];
    const double x = e.dot(t1);
    const double y = e.dot(t2);
    sum += (row[k] + spread.raised) * (height(links[k].node(), e) - fit.q1 * (x * x - y * y) - 2 * fit.q2 * x * y);
  }
  return spread.sum > 0 ? sum / spread.sum : unknown;
}

/// Whether the faces around a node form one run, from rim to rim.
bool has_one_run(std::span<const Link> links) {
  return std::count_if(links.begin(), links.end(), [](Link link) { return link.start(); }) == 1;
}

/// Tilts the normal by the slopes. Returns the factor by which that lengthens it.
double tilt(Vector3& normal, const HeightFit& fit, const Vector3& t1, const Vector3& t2) {
  const Vector3 tilted = normal + fit.slope1 * t1 + fit.slope2 * t2;
  const double length = tilted.norm();
  normal = tilted / length;
  return length;
}

/// Updates normal and curvature of a node at a rim; its normal is a guess at first.
void update_rim(Net& net, std::size_t i, const LinkEdges& edges) {
  // With several runs there is no single line through the node that would be the rim.
  if (!has_one_run(edges.links())) return;
  Vector3& normal = net.normals[i];
  const Vector3& before = edges[0];
  const Vector3& after = edges[edges.size() - 1];
  const Vector3 chord = after - before;
  const Vector3 t1 = direction(chord - chord.dot(normal) * normal, chord.norm());
  if (t1.isZero(0)) return;
  const Vector3 t2 = normal.cross(t1);
  (void)tilt(normal, fit_rim(net, i, edges, normal, t1, t2), t1, t2);
  net.spheres.curvatures[i] = 0.25 * (before.dot(normal) / std::max(before.squaredNorm(), net.tiny) +
                                      after.dot(normal) / std::max(after.squaredNorm(), net.tiny));
}

/// One value for each of the nodes whose equations are solved together, as the divisions of a single node would wait
/// for each other.
using Together = Eigen::Array<double, spheres_together, 1>;

/// Solves the equations of several nodes with faces all around together. Their normals are guesses at first.
class SpheresInside {
 public:
  SpheresInside() {
    // Solvable values if there are fewer nodes.
    for (Together& values : a_.values) values.setZero();
    for (Together& values : b_) values.setZero();
  }

  /// The edges of the node that may be added next.
  const LinkEdges& edges(const Net& net, std::size_t i) { return nodes_[count_].edges.emplace(net, i); }

  void add(const Net& net, std::size_t i) {
    Node& node = nodes_[count_];
    node.number = i;
    std::tie(node.t1, node.t2) = tangents_of(net.normals[i]);
    const auto [a, b] = equations_inside(net, i, *node.edges, net.normals[i], node.t1, node.t2);
    const auto place = static_cast<Eigen::Index>(count_++);
    for (std::size_t k = 0; k < a.values.size(); ++k) a_.values[k][place] = a.values[k];
    for (std::size_t k = 0; k < b.size(); ++k) b_[k][place] = b[k];
  }

  /// Finds normals and curvatures.
  void finish(Net& net) {
    if (count_ == 0) return;
    solve_in_place(a_, b_);
    for (std::size_t k = 0; k < count_; ++k) {
      const auto place = static_cast<Eigen::Index>(k);
      finish_node(net, nodes_[k], {b_[0][place], b_[1][place], b_[2][place], b_[3][place]});
    }
  }

 private:
  struct Node {
    std::size_t number;
    Vector3 t1;
    Vector3 t2;
    std::optional<LinkEdges> edges;
  };

  static void finish_node(Net& net, const Node& node, HeightFit fit) {
    const std::size_t i = node.number;
    Vector3& normal = net.normals[i];
    const double length = tilt(normal, fit, node.t1, node.t2);
    fit.q1 /= length;
    fit.q2 /= length;
    net.spheres.curvatures[i] = curvature_by_row(net, i, *node.edges, node.t1, node.t2, fit,
                                                 [&](std::size_t, const Vector3& e) { return e.dot(normal); });
    if (i < net.spheres.differences.size()) net.spheres.differences[i] = 4 * (fit.q1 * fit.q1 + fit.q2 * fit.q2);
  }

  std::array<Node, spheres_together> nodes_;
  std::size_t count_ = 0;
  LowerTriangle<5, Together> a_;
  Unknowns<5, Together> b_;
};

}  // namespace

void use_sphere_springs(Net& net) {
  net.spheres.curvatures.assign(net.positions.size(), unknown);
  net.spheres.stiffness.assign(net.rings.link_count(), 0);
  net.spheres.areas.assign(net.computed, 0);
  net.spheres.weights.assign(net.computed, 0);
  net.spheres.factor = bending_factor(net);
}

void use_least_bending(Net& net) { net.spheres.differences.assign(net.moving, 0); }

RowSpread spread_of_row(const Net& net, std::size_t i, const LinkEdges& edges) {
  const double* row = net.spheres.stiffness.data() + net.rings.begin(i);
  double sum = 0;
  double squares = 0;
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const double square = edges.square(k);
    sum += row[k] * square;
    squares += square;
  }
  const double least = least_spread * net.spheres.areas[i];
  return {std::max(sum, least), sum < least && squares > 0 ? (least - sum) / squares : 0};
}

void update_spheres(Net& net, std::size_t begin, std::span<const Vector3> first) {
  SpheresInside inside;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::size_t i = begin + k;
    const LinkEdges& edges = inside.edges(net, i);
    find_laplacian_row(net, i, edges);
    find_weight(net, i, edges);
    if (net.normal_given(i)) continue;
    net.spheres.curvatures[i] = unknown;
    net.normals[i] = first[k];
    if (first[k].isZero(0)) continue;
    if (on_boundary(edges.links()))
      update_rim(net, i, edges);
    else
      inside.add(net, i);
  }
  inside.finish(net);
}

void find_given_curvature(Net& net, std::size_t i) {
  const Vector3& normal = net.normals[i];
  const auto [t1, t2] = tangents_of(normal);
  const auto height = [&](std::size_t j, const Vector3& e) {
    const Vector3& other = net.normals[j];
    const double own = e.dot(normal);
    // Further nodes have no normal of this state.
    if (!(j < net.computed || net.normal_given(j)) || other.isZero(0)) return own;
    const double theirs = other.dot(normal) < 0 ? -e.dot(other) : e.dot(other);
    return (1 + of_neighbours) * own + of_neighbours * theirs;
  };
  const LinkEdges edges(net, i);
  const HeightFit fit = fit_given(net, i, edges, t1, t2, height);
  net.spheres.curvatures[i] = curvature_by_row(net, i, edges, t1, t2, fit, height);
}

double sphere_force(const Net& net, std::size_t i) {
  const auto links = net.rings.links(i);
  const SphereSprings& spheres = net.spheres;
  const double own = spheres.curvatures[i];
  if (!(own == own)) return 0;
  const double* row = spheres.stiffness.data() + net.rings.begin(i);
  double sum = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const std::size_t j = links[k].node();
    const double theirs = spheres.curvatures[j];
    if (!(theirs == theirs)) continue;
    sum += row[k] * ((net.normals[i].dot(net.normals[j]) < 0 ? -theirs : theirs) - own);
  }
  if (!spheres.differences.empty()) sum += 2 * spheres.areas[i] * own * spheres.differences[i];
  const double weight = spheres.weights[i];
  return weight > 0 ? -4 * spheres.factor * sum / weight : 0;
}

}  // namespace vspring
