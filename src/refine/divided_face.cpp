#include "refine/divided_face.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>

#include "shape/face_geometry.hpp"

namespace vspring {

namespace {

// Straight angles count as convex, to the rounding of coordinates.
constexpr double straight = 1e-9;

std::ptrdiff_t middle_count(const FaceToDivide& face) {
  return std::count_if(face.middles.begin(), face.middles.end(), [](Index middle) { return middle >= 0; });
}

/// Appends the parts of one face, with its corners counted from `first` on, so that each pattern is written once.
class Parts {
 public:
  Parts(const FaceToDivide& face, FaceParcel& parts) : face_(face), parts_(parts) {}

  std::size_t first = 0;

  [[nodiscard]] Index node(std::size_t k) const { return face_.nodes[(first + k) % face_.nodes.size()]; }
  /// The new node between corners k and k + 1.
  [[nodiscard]] Index middle(std::size_t k) const { return face_.middles[(first + k) % face_.nodes.size()]; }
  [[nodiscard]] bool has(std::size_t k) const { return middle(k) >= 0; }
  void add(std::initializer_list<Index> nodes) { parts_.add(std::span(nodes.begin(), nodes.size()), face_.from); }

 private:
  const FaceToDivide& face_;
  FaceParcel& parts_;
};

void divide_triangle(Parts& parts, std::ptrdiff_t count, const std::vector<Vector3>& positions) {
  const auto square = [&](Index a, Index b) {
    return (positions[static_cast<std::size_t>(a)] - positions[static_cast<std::size_t>(b)]).squaredNorm();
  };
  if (count == 3) {
    for (std::size_t k = 0; k < 3; ++k) parts.add({parts.node(k), parts.middle(k), parts.middle(k + 2)});
    parts.add({parts.middle(0), parts.middle(1), parts.middle(2)});
  } else if (count == 1) {
    while (!parts.has(0)) ++parts.first;
    parts.add({parts.node(0), parts.middle(0), parts.node(2)});
    parts.add({parts.middle(0), parts.node(1), parts.node(2)});
  } else {
    // Both divided edges meet at corner 2.
    while (parts.has(0)) ++parts.first;
    const Index a = parts.node(0);
    const Index b = parts.node(1);
    const Index right = parts.middle(1);
    const Index left = parts.middle(2);
    parts.add({right, parts.node(2), left});
    if (square(a, right) <= square(b, left)) {
      parts.add({a, b, right});
      parts.add({a, right, left});
    } else {
      parts.add({a, b, left});
      parts.add({b, right, left});
    }
  }
}

void divide_quad(Parts& parts, std::ptrdiff_t count, const std::function<Index()>& make_middle) {
  if (count == 1) {
    while (!parts.has(0)) ++parts.first;
    parts.add({parts.node(0), parts.middle(0), parts.node(3)});
    parts.add({parts.middle(0), parts.node(1), parts.node(2)});
    parts.add({parts.middle(0), parts.node(2), parts.node(3)});
    return;
  }
  if (count == 2 && parts.has(0) == parts.has(2)) {
    while (!parts.has(0)) ++parts.first;
    parts.add({parts.node(0), parts.middle(0), parts.middle(2), parts.node(3)});
    parts.add({parts.middle(0), parts.node(1), parts.node(2), parts.middle(2)});
    return;
  }
  const Index centre = make_middle();
  if (count == 4) {
    for (std::size_t k = 0; k < 4; ++k) parts.add({parts.node(k), parts.middle(k), centre, parts.middle(k + 3)});
  } else if (count == 3) {
    while (parts.has(0)) ++parts.first;
    parts.add({parts.node(0), parts.node(1), centre});
    parts.add({parts.node(1), parts.middle(1), centre});
    parts.add({parts.node(2), parts.middle(2), centre, parts.middle(1)});
    parts.add({parts.node(3), parts.middle(3), centre, parts.middle(2)});
    parts.add({parts.node(0), centre, parts.middle(3)});
  } else {
    // Both divided edges meet at corner 1.
    while (!parts.has(0) || !parts.has(1)) ++parts.first;
    parts.add({parts.node(0), parts.middle(0), centre, parts.node(3)});
    parts.add({parts.node(1), parts.middle(1), centre, parts.middle(0)});
    parts.add({parts.node(2), parts.node(3), centre, parts.middle(1)});
  }
}

void divide_around(Parts& parts, std::size_t size, bool is_whole, Index centre) {
  for (std::size_t k = 0; k < size; ++k) {
    if (is_whole) {
      parts.add({parts.node(k), parts.middle(k), centre, parts.middle(k + size - 1)});
    } else if (parts.has(k)) {
      parts.add({parts.node(k), parts.middle(k), centre});
      parts.add({parts.middle(k), parts.node(k + 1), centre});
    } else {
      parts.add({parts.node(k), parts.node(k + 1), centre});
    }
  }
}

/// A face without self-crossings, seen along its vector area, from which triangles are cut at its convex corners.
class Ears {
 public:
  Ears(std::vector<Index> nodes, const std::vector<Vector3>& positions) : nodes_(std::move(nodes)) {
    const Vector3 normal = twice_vector_area(std::span<const Index>(nodes_), positions).stableNormalized();
    const Vector3 x = normal.unitOrthogonal();
    const Vector3 y = normal.cross(x);
    for (const Index node : nodes_) {
      const Vector3 place = positions[static_cast<std::size_t>(node)] - positions[static_cast<std::size_t>(nodes_[0])];
      places_.emplace_back(place.dot(x), place.dot(y));
    }
    for (std::size_t k = 0; k < nodes_.size(); ++k) left_.push_back(k);
  }

  /// Cuts off the roundest triangle whose new edge may be: is_edge(low, high) says if there is one already. Empty if
  /// there is no such triangle.
  template <typename IsEdge>
  std::optional<std::array<Index, 3>> cut(const IsEdge& is_edge) {
    std::optional<std::size_t> best;
    double roundest = 0;
    for (std::size_t k = 0; k < left_.size(); ++k) {
      const double roundness = roundness_at(k);
      if (!(roundness > roundest)) continue;
      const auto [low, high] = std::minmax(node(k + left_.size() - 1), node(k + 1));
      if (left_.size() > 3 && (!is_empty(k) || is_edge(low, high))) continue;
      roundest = roundness;
      best = k;
    }
    if (!best) return std::nullopt;
    const std::array<Index, 3> triangle = {node(*best + left_.size() - 1), node(*best), node(*best + 1)};
    left_.erase(left_.begin() + static_cast<std::ptrdiff_t>(*best));
    return triangle;
  }
  [[nodiscard]] bool any_left() const { return left_.size() >= 3; }

 private:
  using Place = Eigen::Vector2d;

  [[nodiscard]] Index node(std::size_t k) const { return nodes_[left_[k % left_.size()]]; }
  [[nodiscard]] const Place& place(std::size_t k) const { return places_[left_[k % left_.size()]]; }
  [[nodiscard]] static double twice_area(const Place& a, const Place& b, const Place& c) {
    return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
  }
  /// Twice the area over the squares of the sides; not positive at a corner that is not convex.
  [[nodiscard]] double roundness_at(std::size_t k) const {
    const Place& a = place(k + left_.size() - 1);
    const Place& b = place(k);
    const Place& c = place(k + 1);
    const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
    return squares > 0 ? twice_area(a, b, c) / squares : 0;
  }
  /// Whether no other corner lies in or on the triangle at a corner.
  [[nodiscard]] bool is_empty(std::size_t k) const {
    const Place& a = place(k + left_.size() - 1);
    const Place& b = place(k);
    const Place& c = place(k + 1);
    const double none = straight * std::abs(twice_area(a, b, c));
    for (std::size_t other = k + 2; other + 1 < k + left_.size(); ++other) {
      const Place& p = place(other);
      if (twice_area(a, b, p) >= -none && twice_area(b, c, p) >= -none && twice_area(c, a, p) >= -none) return false;
    }
    return true;
  }

  std::vector<Index> nodes_;
  std::vector<Place> places_;
  std::vector<std::size_t> left_;
};

/// Cuts a face that is not convex into triangles between its corners and the nodes on its edges. Cubic in these.
/// Returns whether that can be done without an edge that is there already.
bool cut(const FaceToDivide& face, DivisionContext& context, FaceParcel& parts) {
  std::vector<Index> nodes;
  for (std::size_t k = 0; k < face.nodes.size(); ++k) {
    nodes.push_back(face.nodes[k]);
    if (face.middles[k] >= 0) nodes.push_back(face.middles[k]);
  }
  Ears ears(std::move(nodes), context.positions);
  std::vector<std::array<Index, 3>> triangles;
  while (ears.any_left()) {
    const auto triangle = ears.cut([&](Index low, Index high) {
      return context.is_edge(low, high) || context.new_edges.contains({low, high});
    });
    if (!triangle) return false;
    triangles.push_back(*triangle);
  }
  for (const auto& triangle : triangles) {
    parts.add(triangle, face.from);
    context.new_edges.insert(std::minmax(triangle[0], triangle[2]));
  }
  return true;
}

}  // namespace

bool is_convex(std::span<const Index> face, const std::vector<Vector3>& positions) {
  if (face.size() == 3) return true;
  const Vector3 area = twice_vector_area(face, positions);
  for (std::size_t k = 0; k < face.size(); ++k) {
    const Vector3& here = positions[static_cast<std::size_t>(face[k])];
    const Vector3 in = here - positions[static_cast<std::size_t>(face[(k + face.size() - 1) % face.size()])];
    const Vector3 out = positions[static_cast<std::size_t>(face[(k + 1) % face.size()])] - here;
    if (in.cross(out).dot(area) < -straight * in.norm() * out.norm() * area.norm()) return false;
  }
  return true;
}

void divide(const FaceToDivide& face, DivisionContext& context, FaceParcel& parts) {
  Parts made(face, parts);
  const auto count = middle_count(face);
  const std::size_t size = face.nodes.size();
  const auto middle = [&] { return context.add_mean(face.nodes); };
  if (size == 3)
    divide_triangle(made, count, context.positions);
  else if (!face.is_convex && cut(face, context, parts))
    return;
  else if (size == 4 && face.is_convex)
    divide_quad(made, count, middle);
  else
    divide_around(made, size, face.is_convex && count == static_cast<std::ptrdiff_t>(size), middle());
}

}  // namespace vspring
