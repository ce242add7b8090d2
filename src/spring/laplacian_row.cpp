#include "spring/laplacian_row.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <span>

namespace vspring {

namespace {

// Bounds the angles of slivers.
constexpr double greatest_cotangent = 100;

/// From the cosine and the inverse of the sine, which may be infinite.
double cotangent(double cosine, double inverse_sine) {
  const double value = cosine * inverse_sine;
  if (!(value < greatest_cotangent)) return greatest_cotangent;
  return std::max(value, -greatest_cotangent);
}

/// Half the cotangents of the angles of a triangle with a corner at 0, and twice its area.
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

/// A place in a walk around a node, at most once around. No remainder: a division takes as long as a face.
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

}  // namespace

void find_laplacian_row(Net& net, std::size_t i, const LinkEdges& edges) {
  const std::size_t count = edges.size();
  double* row = net.spheres.stiffness.data() + net.rings.begin(i);
  std::fill_n(row, count, 0.0);
  double share_of_area = 0;
  const auto edge = [&](std::size_t k) -> const Vector3& { return edges[wrapped(k, count)]; };
  for_faces(edges.links(), [&](std::size_t first, std::size_t last) {
    const std::size_t nodes = last - first + 2;
    const Vector3& a = edge(first);
    const Vector3& b = edge(last);
    if (nodes == 3) {
      const HalfCotangents half(a, b);
      row[first] += half.at_b;
      row[wrapped(last, count)] += half.at_a;
      share_of_area += half.area / 6;
      return;
    }
    // Node 0 of the face is the centre, node k + 1 the place first + k of the walk.
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
    share_of_area += 0.5 * area.norm() / static_cast<double>(nodes);
    // Each node's weight of the edge to the middle is shared out evenly among all nodes of the face.
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
  net.spheres.areas[i] = share_of_area;
}

}  // namespace vspring
