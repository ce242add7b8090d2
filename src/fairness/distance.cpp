#include "vspring/distance.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/cancellation.hpp"
#include "base/threads.hpp"
#include "fairness/counted.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "shape/segment.hpp"
#include "shape/triangles.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

constexpr std::size_t points_per_task = 512;

double square_to_segment(const Vector3& point, const Vector3& a, const Vector3& b) {
  return (point - a - nearest_share(point, a, b) * (b - a)).squaredNorm();
}

double square_to_triangle(const Vector3& point, const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 normal = (b - a).cross(c - a);
  const double area2 = normal.squaredNorm();
  const auto inside = [&](const Vector3& from, const Vector3& to) {
    return (to - from).cross(point - from).dot(normal) >= 0;
  };
  if (area2 > 0 && inside(a, b) && inside(b, c) && inside(c, a)) {
    const double height = (point - a).dot(normal);
    return height * height / area2;
  }
  return std::min({square_to_segment(point, a, b), square_to_segment(point, b, c), square_to_segment(point, c, a)});
}

/// Sums in fixed pieces, so they do not depend on the number of threads.
class Gathering {
 public:
  Gathering(std::size_t points, double scale)
      : parts_((points + points_per_task - 1) / points_per_task), scale_(scale) {}

  void add(std::size_t point, double square) {
    Part& part = parts_[point / points_per_task];
    part.squares += square;
    ++part.count;
    if (square > part.greatest || part.node < 0) {
      part.greatest = square;
      part.node = static_cast<Index>(point);
    }
  }

  [[nodiscard]] Distance sum() const {
    Part all;
    for (const Part& part : parts_) {
      if (part.count == 0) continue;
      all.squares += part.squares;
      all.count += part.count;
      if (part.greatest > all.greatest || all.node < 0) {
        all.greatest = part.greatest;
        all.node = part.node;
      }
    }
    if (all.count == 0) return {};
    return {.greatest = std::sqrt(all.greatest) / scale_,
            .rms = std::sqrt(all.squares / static_cast<double>(all.count)) / scale_,
            .node = all.node,
            .count = all.count};
  }

 private:
  struct Part {
    double squares = 0;
    double greatest = 0;
    Index count = 0;
    Index node = -1;
  };
  std::vector<Part> parts_;
  double scale_;
};

Box box_around(std::span<const Vector3> first, std::span<const Vector3> second) {
  Box box;
  for (const auto& positions : {first, second}) {
    for (const Vector3& position : positions) {
      if (position.allFinite()) box.extend(position);
    }
  }
  return box;
}

/// Squares of distances in a frame; negative where there is none.
struct Squares {
  std::vector<double> squares;
  double scale;

  [[nodiscard]] Distance sum() const {
    Gathering gathering(squares.size(), scale);
    for (std::size_t i = 0; i < squares.size(); ++i) {
      if (squares[i] >= 0) gathering.add(i, squares[i]);
    }
    return gathering.sum();
  }
  [[nodiscard]] std::vector<double> distances() && {
    for (double& square : squares) square = std::sqrt(std::max(square, 0.0)) / scale;
    return std::move(squares);
  }
};

/// Elements: lists of equally many nodes, each the hull of its nodes. square(element, point, positions): the squared
/// distance.
template <typename Elements, typename Square>
Squares squares_to(std::span<const Vector3> points, const Elements& elements, std::span<const Vector3> positions,
                   const Context& context, const Square& square) {
  const Frame frame(box_around(points, positions));
  const std::vector<Vector3> from = placed(points, frame);
  const std::vector<Vector3> to = placed(positions, frame);
  std::vector<Box> boxes(elements.size());
  for (std::size_t k = 0; k < elements.size(); ++k) {
    end_if_cancelled_at(k);
    for (const Index node : elements[k]) boxes[k].extend(to[static_cast<std::size_t>(node)]);
  }
  ThreadTeam team(context.thread_count());
  const BoxTree tree(std::move(boxes), team);
  Squares result{std::vector<double>(points.size(), -1), frame.scale()};
  parallel_ranges(team, points.size(), points_per_task, [&](std::size_t begin, std::size_t end) {
    if (context.cancelled()) return;
    Index last = 0;
    for (std::size_t i = begin; i < end; ++i) {
      if (!from[i].allFinite()) continue;
      const auto square_to = [&](Index k) { return square(from[i], elements[static_cast<std::size_t>(k)], to); };
      // Successive points mostly lie at the same element or the next one, so little of the tree needs a visit.
      const Index next = last + 1 < static_cast<Index>(elements.size()) ? last + 1 : last;
      const double there = square_to(last);
      const double ahead = square_to(next);
      const auto nearer = tree.nearest(from[i], square_to, std::min(there, ahead));
      result.squares[i] = nearer.square;
      last = nearer.item >= 0 ? nearer.item : ahead < there ? next : last;
    }
  });
  return result;
}

Squares squares_to(std::span<const Vector3> of_points, const PolygonMesh& to_shape, const Context& context) {
  std::vector<std::array<Index, 3>> triangles;
  for (const Triangle& triangle : cut_into_triangles(to_shape)) triangles.push_back(triangle.nodes);
  if (triangles.empty()) throw Error(ErrorCode::unusable_shape, "no face to measure the distance to");
  return squares_to(of_points, triangles, to_shape.positions(), context,
                    [](const Vector3& point, const std::array<Index, 3>& nodes, const std::vector<Vector3>& at) {
                      return square_to_triangle(point, at[static_cast<std::size_t>(nodes[0])],
                                                at[static_cast<std::size_t>(nodes[1])],
                                                at[static_cast<std::size_t>(nodes[2])]);
                    });
}

Squares squares_to(std::span<const Vector3> of_points, const PolygonCurve& to_shape, const Context& context) {
  std::vector<std::array<Index, 2>> edges;
  for (const auto& chain : to_shape.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k + 1 < count + (chain.closed ? 1 : 0); ++k) {
      const std::array<Index, 2> edge = {chain.nodes[k], chain.nodes[(k + 1) % count]};
      if (to_shape.position(edge[0]).allFinite() && to_shape.position(edge[1]).allFinite()) edges.push_back(edge);
    }
  }
  if (edges.empty()) throw Error(ErrorCode::unusable_shape, "no edge to measure the distance to");
  return squares_to(of_points, edges, to_shape.positions(), context,
                    [](const Vector3& point, const std::array<Index, 2>& nodes, const std::vector<Vector3>& at) {
                      return square_to_segment(point, at[static_cast<std::size_t>(nodes[0])],
                                               at[static_cast<std::size_t>(nodes[1])]);
                    });
}

/// The positions of these nodes; none of the others.
std::vector<Vector3> positions_of(const std::vector<Vector3>& positions, const std::vector<std::uint8_t>& counted) {
  std::vector<Vector3> result = positions;
  for (std::size_t i = 0; i < result.size(); ++i) {
    if (counted[i] == 0) result[i].setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  return result;
}

}  // namespace

Distance node_distance(std::span<const Vector3> before, std::span<const Vector3> after) {
  if (before.size() != after.size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} nodes before and {} after: compare the shapes and not their nodes", before.size(),
                            after.size()));
  const Frame frame(box_around(before, after));
  Gathering gathering(before.size(), frame.scale());
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!before[i].allFinite() || !after[i].allFinite()) continue;
    gathering.add(i, ((after[i] - before[i]) * frame.scale()).squaredNorm());
  }
  return gathering.sum();
}

Distance distance(std::span<const Vector3> of_points, const PolygonMesh& to_shape, const Context& context) {
  return squares_to(of_points, to_shape, context).sum();
}

Distance distance(std::span<const Vector3> of_points, const PolygonCurve& to_shape, const Context& context) {
  return squares_to(of_points, to_shape, context).sum();
}

Distance distance(const PolygonMesh& of_shape, const PolygonMesh& to_shape, const Context& context) {
  std::vector<std::uint8_t> in_faces(of_shape.positions().size(), 0);
  for (const Index node : of_shape.corners()) in_faces[static_cast<std::size_t>(node)] = 1;
  return distance(positions_of(of_shape.positions(), in_faces), to_shape, context);
}

Distance distance(const PolygonCurve& of_shape, const PolygonCurve& to_shape, const Context& context) {
  std::vector<std::uint8_t> in_edges(of_shape.positions().size(), 0);
  for (const auto& chain : of_shape.chains()) {
    if (chain.nodes.size() < 2) continue;
    for (const Index node : chain.nodes) in_edges[static_cast<std::size_t>(node)] = 1;
  }
  return distance(positions_of(of_shape.positions(), in_edges), to_shape, context);
}

std::vector<double> point_distances(std::span<const Vector3> of_points, const PolygonMesh& to_shape,
                                    const Context& context) {
  return squares_to(of_points, to_shape, context).distances();
}

std::vector<double> point_distances(std::span<const Vector3> of_points, const PolygonCurve& to_shape,
                                    const Context& context) {
  return squares_to(of_points, to_shape, context).distances();
}

Distance distance(std::span<const Vector3> of_points, const PolygonMesh& to_shape) {
  return distance(of_points, to_shape, Context());
}

Distance distance(std::span<const Vector3> of_points, const PolygonCurve& to_shape) {
  return distance(of_points, to_shape, Context());
}

}  // namespace vspring
