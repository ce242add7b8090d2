#include "spring/sphere_springs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <tuple>
#include <type_traits>
#include <utility>
#include <vector>

#include "shape/direction.hpp"
#include "spring/bending_factor.hpp"
#include "spring/near_nodes.hpp"
#include "spring/net.hpp"

namespace vspring {

namespace {

// Of angles of slivers.
constexpr double greatest_cotangent = 100;
// Of the normal equations' diagonal: what four neighbours leave open, and slopes that so few nodes tell nothing of.
constexpr double ridge_of_forms = 1e-4;
constexpr double ridge_of_slopes = 1e-6;
// Of 4 M, to which the Laplacian's entries times squared edges add up in the plane.
constexpr double least_spread = 2;
// Of heights over a given normal's tangent plane, what those over the neighbours' planes count: takes the terms of
// third order out where the neighbours' normals are computed.
constexpr double of_neighbours = 0.5;
constexpr double unknown = std::numeric_limits<double>::quiet_NaN();

/// From the cosine and the inverse of the sine, which may be infinite.
double cotangent(double cosine, double inverse_sine) {
  const double value = cosine * inverse_sine;
  if (!(value < greatest_cotangent)) return greatest_cotangent;
  return std::max(value, -greatest_cotangent);
}

/// Of a triangle with a corner at 0 and two others: the halves of its angles' cotangents, and twice its area.
struct HalfCotangents {
  double at_origin;
  double at_a;
  double at_b;
  double area;

  HalfCotangents(const Vector3& a, const Vector3& b) {
    const Vector3 side = b - a;
    area = a.cross(side).norm();
    const double inverse = 1 / area;
    at_origin = 0.5 * cotangent(a.dot(b), inverse);
    at_a = 0.5 * cotangent(-a.dot(side), inverse);
    at_b = 0.5 * cotangent(b.dot(side), inverse);
  }
};

/// A place in a walk around a node, once around at most: a division, as for a remainder, takes as long as a face.
std::size_t wrapped(std::size_t k, std::size_t count) { return k < count ? k : k - count; }

/// Calls use(first, last) for every face around a node: the places in the walk of its nodes beside the centre, first to
/// last, from spoke to spoke.
template <typename Use>
void for_faces(std::span<const Link> links, const Use& use) {
  const std::size_t count = links.size();
  for (std::size_t k = 0; k < count; ++k) {
    if (!links[k].spoke()) continue;
    std::size_t last = k;
    bool is_face = false;
    do {
      ++last;
      const Link link = links[wrapped(last, count)];
      if (link.start()) break;
      is_face = link.spoke();
    } while (!is_face && last < k + count);
    if (is_face) use(k, last);
  }
}

/// The edges from a node to all of its link, gathered once.
class LinkEdges {
 public:
  LinkEdges(const Net& net, std::size_t i)
      : links_(net.rings.links(i)), edges_(few_.data()), squares_(squares_of_few_.data()) {
    if (links_.size() > few) {
      many_.resize(links_.size());
      squares_of_many_.resize(links_.size());
      edges_ = many_.data();
      squares_ = squares_of_many_.data();
    }
    for (std::size_t k = 0; k < links_.size(); ++k) {
      edges_[k] = net.positions[links_[k].node()] - net.positions[i];
      squares_[k] = edges_[k].squaredNorm();
    }
  }
  LinkEdges(const LinkEdges&) = delete;
  LinkEdges& operator=(const LinkEdges&) = delete;

  [[nodiscard]] std::span<const Link> links() const { return links_; }
  [[nodiscard]] std::size_t size() const { return links_.size(); }
  [[nodiscard]] const Vector3& operator[](std::size_t k) const { return edges_[k]; }
  [[nodiscard]] double square(std::size_t k) const { return squares_[k]; }

 private:
  // Hardly any node has more; room on the stack costs nothing.
  static constexpr std::size_t few = 24;

  std::span<const Link> links_;
  std::array<Vector3, few> few_;
  std::array<double, few> squares_of_few_;
  std::vector<Vector3> many_;
  std::vector<double> squares_of_many_;
  Vector3* edges_;
  double* squares_;
};

/// The row of the Laplacian, and the node's share of area.
void find_row(Net& net, std::size_t i, const LinkEdges& edges) {
  SphereSprings& spheres = net.spheres;
  const std::size_t count = edges.size();
  double* row = spheres.stiffness.data() + net.rings.begin(i);
  std::fill_n(row, count, 0.0);
  spheres.areas[i] = 0;
  const auto edge = [&](std::size_t k) -> const Vector3& { return edges[wrapped(k, count)]; };
  for_faces(edges.links(), [&](std::size_t first, std::size_t last) {
    const std::size_t nodes = last - first + 2;
    const Vector3& a = edge(first);
    const Vector3& b = edge(last);
    if (nodes == 3) {
      const HalfCotangents half(a, b);
      row[first] += half.at_b;
      row[wrapped(last, count)] += half.at_a;
      spheres.areas[i] += half.area / 6;
      return;
    }
    // Nodes of the face: 0 is the centre, k + 1 the place first + k of the walk.
    const auto place = [&](std::size_t k) -> Vector3 {
      return k == 0 || k == nodes ? Vector3::Zero() : edge(first + k - 1);
    };
    Vector3 middle = Vector3::Zero();
    Vector3 area = Vector3::Zero();
    Vector3 before = a;
    for (std::size_t k = 1; k < nodes; ++k) {
      const Vector3 after = place(k + 1);
      middle += before;
      area += before.cross(after);
      before = after;
    }
    middle /= static_cast<double>(nodes);
    spheres.areas[i] += 0.5 * area.norm() / static_cast<double>(nodes);
    // Weights of the edges from each node to the middle go to the node by its share, and their sum to all.
    const double share = 1 / static_cast<double>(nodes);
    double sum = 0;
    double own = 0;
    const auto add = [&](std::size_t k, double weight) {
      sum += weight;
      if (k == 0 || k == nodes)
        own += weight;
      else
        row[wrapped(first + k - 1, count)] += share * weight;
    };
    before.setZero();
    for (std::size_t k = 0; k < nodes; ++k) {
      const Vector3 after = place(k + 1);
      const HalfCotangents half(before - middle, after - middle);
      add(k, half.at_b);
      add(k + 1, half.at_a);
      if (k == 0) row[first] += half.at_origin;
      if (k + 1 == nodes) row[wrapped(last, count)] += half.at_origin;
      before = after;
    }
    for (std::size_t k = first; k <= last; ++k) row[wrapped(k, count)] += share * (own - share * sum);
  });
}

/// Calls use(0) … use(n − 1) with numbers that are constants there: what is indexed by them alone stays in registers.
template <std::size_t n, typename Use>
void unrolled(const Use& use) {
  [&]<std::size_t... k>(std::index_sequence<k...>) { (use(std::integral_constant<std::size_t, k>()), ...); }
  (std::make_index_sequence<n>());
}

/// value: a number, or one for each of several nodes.
template <std::size_t n, typename Value = double>
using Unknowns = std::array<Value, n>;

/// The lower triangle of a symmetric matrix, row by row.
template <std::size_t n, typename Value = double>
struct Triangle {
  std::array<Value, n*(n + 1) / 2> values = {};

  Value& operator()(std::size_t row, std::size_t column) { return values[row * (row + 1) / 2 + column]; }
};

/// One value for each of the nodes whose equations are solved together: divisions follow on one another, and those of
/// one node alone would be waited for.
using Together = Eigen::Array<double, spheres_together, 1>;

// What nothing tells of gets nothing.
double inverse_of_pivot(double pivot) { return pivot > 0 ? 1 / pivot : 0; }

Together inverse_of_pivot(const Together& pivots) { return (pivots > 0).select(pivots.inverse(), Together::Zero()); }

/// Puts x of a x = b in the place of b, for a symmetric positive definite a, which is replaced by its factor L of L D
/// Lᵀ.
template <std::size_t n, typename Value>
void solve_in_place(Triangle<n, Value>& a, Unknowns<n, Value>& b) {
  Unknowns<n, Value> inverse;
  for (std::size_t j = 0; j < n; ++j) {
    // Row j of L D, then of L.
    for (std::size_t k = 0; k < j; ++k) {
      for (std::size_t m = 0; m < k; ++m) a(j, k) -= a(k, m) * a(j, m);
    }
    Value pivot = a(j, j);
    for (std::size_t k = 0; k < j; ++k) {
      const Value entry = a(j, k) * inverse[k];
      pivot -= a(j, k) * entry;
      b[j] -= entry * b[k];
      a(j, k) = entry;
    }
    inverse[j] = inverse_of_pivot(pivot);
  }
  for (std::size_t j = n; j-- > 0;) {
    b[j] *= inverse[j];
    for (std::size_t m = j + 1; m < n; ++m) b[j] -= a(m, j) * b[m];
  }
}

/// Σ r rᵀ of rows r of n numbers and a right side, on and above its diagonal, without the last row: by pairs of
/// columns, each as fast as one.
template <std::size_t n>
class RowProducts {
 public:
  RowProducts() {
    for (auto& row : sums_) row.fill(Pair::Zero());
  }

  /// A row and its right side, both times a weight.
  void add(const Unknowns<n>& row, double right, double weight) {
    const auto at = [&](std::size_t c) { return c < n ? row[c] : c == n ? right : 0.0; };
    std::array<Pair, pairs> weighted;
    unrolled<pairs>([&](auto p) { weighted[p] = Pair(at(2 * p), at(2 * p + 1)) * weight; });
    unrolled<n>([&](auto r) {
      const double left = weighted[r / 2][r % 2];
      unrolled<pairs - r / 2>([&](auto p) { sums_[r][r / 2 + p] += left * weighted[r / 2 + p]; });
    });
  }

  [[nodiscard]] double operator()(std::size_t r, std::size_t c) const {
    return sums_[r][c / 2][static_cast<Eigen::Index>(c % 2)];
  }

 private:
  using Pair = Eigen::Array2d;
  static constexpr std::size_t pairs = n / 2 + 1;

  std::array<std::array<Pair, pairs>, n> sums_;
};

/// Calls use(node, e, |e|²) for the nodes that heights are fitted to, see for_near_nodes().
template <typename Use>
void for_near_edges(const Net& net, std::size_t i, const LinkEdges& edges, const Use& use) {
  if (edges.size() >= enough_near_nodes) {
    for (std::size_t k = 0; k < edges.size(); ++k) use(edges.links()[k].node(), edges[k], edges.square(k));
    return;
  }
  for_near_nodes(net, i, [&](std::size_t j) {
    const Vector3 e = net.positions[j] - net.positions[i];
    use(j, e, e.squaredNorm());
  });
}

/// The equations a x = b of n unknowns.
template <std::size_t n>
struct HeightEquations {
  Triangle<n> a;
  Unknowns<n> b;
};

/// Those of least squares of heights over a node's link, by x and y in its tangent plane: height(j, e) for node j
/// against the n unknowns of row(x, y, |e|²), both weighed by |e|⁻². forms_ridge and slopes_ridge: what is added to the
/// diagonal for each unknown, times the number of nodes and times Σ |e|⁻², as their units ask.
template <std::size_t n, typename Height, typename Row>
HeightEquations<n> equations_of_heights(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& t1,
                                        const Vector3& t2, const Unknowns<n>& forms_ridge,
                                        const Unknowns<n>& slopes_ridge, const Height& height, const Row& row_of) {
  RowProducts<n> products;
  double inverses = 0;
  double count = 0;
  for_near_edges(net, i, edges, [&](std::size_t j, const Vector3& e, double length2) {
    if (!(length2 > 0)) return;
    const double inverse = 1 / length2;
    inverses += inverse;
    count += 1;
    products.add(row_of(e.dot(t1), e.dot(t2), length2), height(j, e), inverse);
  });
  HeightEquations<n> equations;
  unrolled<n>([&](auto r) {
    unrolled<r + 1>([&](auto c) { equations.a(r, c) = products(c, r); });
    equations.a(r, r) += count * forms_ridge[r] + inverses * slopes_ridge[r];
    equations.b[r] = products(r, n);
  });
  return equations;
}

/// The form q of heights without its trace, and the slopes by which the plane is to tilt.
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

/// At a rim, along which t1 goes: not curved across it.
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

/// Two directions across a normal.
std::pair<Vector3, Vector3> tangents_of(const Vector3& normal) {
  const Vector3 t1 = normal.unitOrthogonal();
  return {t1, normal.cross(t1)};
}

/// The sum of the Laplacian's entries, raised where that is too little, times squared edges; and the node's weight.
void find_spread(Net& net, std::size_t i, const LinkEdges& edges) {
  SphereSprings& spheres = net.spheres;
  const auto links = edges.links();
  const double* row = spheres.stiffness.data() + net.rings.begin(i);
  double spread = 0;
  double squares = 0;
  double spokes_squares = 0;
  double spokes = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const double square = edges.square(k);
    spread += row[k] * square;
    squares += square;
    if (!links[k].spoke()) continue;
    spokes_squares += square;
    spokes += 1;
  }
  const double least = least_spread * spheres.areas[i];
  spheres.raised[i] = spread < least && squares > 0 ? (least - spread) / squares : 0;
  spheres.spreads[i] = std::max(spread, least);
  const double mean_square = spokes > 0 ? spokes_squares / spokes : 0;
  spheres.weights[i] = 16 * spheres.areas[i] / std::max(mean_square * mean_square, net.tiny * net.tiny);
}

/// The curvature from the row: Σ K (height − q) / Σ K |e|².
template <typename Height>
double curvature_by_row(const Net& net, std::size_t i, const LinkEdges& edges, const Vector3& t1, const Vector3& t2,
                        const HeightFit& fit, const Height& height) {
  const SphereSprings& spheres = net.spheres;
  const auto links = edges.links();
  const double* row = spheres.stiffness.data() + net.rings.begin(i);
  double sum = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vector3& e = edges[k];
    const double x = e.dot(t1);
    const double y = e.dot(t2);
    sum += (row[k] + spheres.raised[i]) * (height(links[k].node(), e) - fit.q1 * (x * x - y * y) - 2 * fit.q2 * x * y);
  }
  return spheres.spreads[i] > 0 ? sum / spheres.spreads[i] : unknown;
}

bool has_rim(std::span<const Link> links) { return !links.empty() && links.front().start(); }

/// Whether faces lie around a node in one run, from rim to rim.
bool has_one_run(std::span<const Link> links) {
  return std::count_if(links.begin(), links.end(), [](Link link) { return link.start(); }) == 1;
}

/// Tilts the normal by the slopes. Returns by how much that lengthens it.
double tilt(Vector3& normal, const HeightFit& fit, const Vector3& t1, const Vector3& t2) {
  const Vector3 tilted = normal + fit.slope1 * t1 + fit.slope2 * t2;
  const double length = tilted.norm();
  normal = tilted / length;
  return length;
}

/// Normal, from the guess that it is, and curvature of a node at a rim.
void update_rim(Net& net, std::size_t i, const LinkEdges& edges) {
  // Several runs have no line through the node in common that would be the rim.
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

/// Nodes with faces all around, whose equations are solved together. Their normals are guesses at first.
class SpheresInside {
 public:
  SpheresInside() {
    // What is solved where there are fewer nodes.
    for (Together& values : a_.values) values.setZero();
    for (Together& values : b_) values.setZero();
  }

  /// Of the node that may be added next.
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
  Triangle<5, Together> a_;
  Unknowns<5, Together> b_;
};

}  // namespace

void use_sphere_springs(Net& net) {
  net.spheres.curvatures.assign(net.positions.size(), unknown);
  net.spheres.stiffness.assign(net.rings.link_count(), 0);
  net.spheres.areas.assign(net.computed, 0);
  net.spheres.spreads.assign(net.computed, 0);
  net.spheres.raised.assign(net.computed, 0);
  net.spheres.weights.assign(net.computed, 0);
  net.spheres.factor = bending_factor(net);
}

void use_least_bending(Net& net) { net.spheres.differences.assign(net.moving, 0); }

void update_spheres(Net& net, std::size_t begin, std::span<const Vector3> first) {
  SpheresInside inside;
  for (std::size_t k = 0; k < first.size(); ++k) {
    const std::size_t i = begin + k;
    const LinkEdges& edges = inside.edges(net, i);
    find_row(net, i, edges);
    find_spread(net, i, edges);
    if (net.normal_given(i)) continue;
    net.spheres.curvatures[i] = unknown;
    net.normals[i] = first[k];
    if (first[k].isZero(0)) continue;
    if (has_rim(edges.links()))
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
    // Beyond, normals may be of another shape.
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
