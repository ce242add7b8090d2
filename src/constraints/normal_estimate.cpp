// Estimates normals to second order from the nodes around, even if these lie on one side only.
//
// For points of a sphere through the node, e·N = c|e|² holds exactly (e: from the node to the point); a smooth surface
// adds a quadratic form without trace in the tangent plane and terms of third order. So least squares over these five
// unknowns reproduce planes and spheres. Elsewhere their error is of second order in the spacing; that of one-sided
// averages of face normals is of first.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/dense_algebra.hpp"
#include "shape/direction.hpp"
#include "shape/fan.hpp"
#include "shape/frame.hpp"
#include "shape/incidence.hpp"
#include "shape/sharp_edges.hpp"
#include "shape/sheets.hpp"
#include "vspring/constraints.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

// Two rings of nodes determine the five unknowns in most meshes; with few faces a third is used.
constexpr std::size_t enough_nodes = 8;
constexpr int most_rings = 3;
// Below this ratio of pivots an unknown is determined by rounding or noise only.
constexpr double independent = 1e-3;
constexpr int rounds = 3;

class Estimator {
 public:
  Estimator(const PolygonMesh& mesh, std::span<const std::uint8_t> usable)
      : mesh_(mesh),
        usable_(usable),
        incidence_(mesh),
        walker_(mesh, incidence_),
        seen_(static_cast<std::size_t>(mesh.node_count()), 0) {
    Eigen::AlignedBox<double, 3> box;
    for (const Vector3& position : mesh.positions()) {
      if (position.allFinite()) box.extend(position);
    }
    frame_ = Frame(box);
  }

  Vector3 at(Index node) {
    const Vector3 first = corner_normal(node);
    Vector3 normal = first;
    if (first.isZero(0)) return normal;
    collect(node);
    for (int round = 0; round < rounds; ++round) normal = fit(normal);
    return normal.dot(first) < 0 ? Vector3(-normal) : normal;
  }

 private:
  [[nodiscard]] Vector3 position(Index node) const { return frame_.to_local(mesh_.position(node)); }
  [[nodiscard]] bool usable(Index face) const {
    return usable_.empty() || usable_[static_cast<std::size_t>(face)] != 0;
  }

  /// Per corner of the node −1 where its face goes round in the other sense than the first one of its fan; empty where
  /// none does.
  std::vector<double> senses(Index node) {
    if (walker_.walk(node).flipped_neighbour < 0) return {};
    struct Side {
      Index neighbour;
      std::size_t corner;
      bool forward;  // the face goes to the neighbour
    };
    const auto corners = incidence_.corners(node);
    std::vector<std::array<Side, 2>> sides_of;
    std::vector<Side> sides;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto face = mesh_.face(corners[k].face);
      const auto place = static_cast<std::size_t>(corners[k].place);
      sides_of.push_back({Side{face[(place + 1) % face.size()], k, true},
                          Side{face[(place + face.size() - 1) % face.size()], k, false}});
      sides.insert(sides.end(), sides_of.back().begin(), sides_of.back().end());
    }
    std::stable_sort(sides.begin(), sides.end(),
                     [](const Side& a, const Side& b) { return a.neighbour < b.neighbour; });
    std::vector<double> sense(corners.size(), 0);
    std::vector<std::size_t> queue;
    for (std::size_t first = 0; first < sense.size(); ++first) {
      if (sense[first] != 0) continue;
      sense[first] = 1;
      queue.assign(1, first);
      for (std::size_t head = 0; head < queue.size(); ++head) {
        for (const Side& own : sides_of[queue[head]]) {
          auto other = std::lower_bound(sides.begin(), sides.end(), own.neighbour,
                                        [](const Side& side, Index neighbour) { return side.neighbour < neighbour; });
          for (; other != sides.end() && other->neighbour == own.neighbour; ++other) {
            if (sense[other->corner] != 0) continue;
            sense[other->corner] = other->forward == own.forward ? -sense[own.corner] : sense[own.corner];
            queue.push_back(other->corner);
          }
        }
      }
    }
    return sense;
  }

  /// The normal with Max's weights over the corners of usable faces at the node, in the sense of the first; zero if
  /// they cancel, and then the sense of the faces is unknown, too.
  [[nodiscard]] Vector3 corner_normal(Index node) {
    Vector3 sum = Vector3::Zero();
    double scale = 0;
    const std::vector<double> sense = senses(node);
    const auto corners = incidence_.corners(node);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Corner corner = corners[c];
      if (!usable(corner.face)) continue;
      const auto face = mesh_.face(corner.face);
      Vector3 previous = Vector3::Zero();
      for (std::size_t k = 1; k < face.size(); ++k) {
        const Vector3 e = position(face[(static_cast<std::size_t>(corner.place) + k) % face.size()]) - position(node);
        const double length2 = e.dot(e);
        const Vector3 inverted = length2 > 0 ? Vector3(e / length2) : Vector3(Vector3::Zero());
        if (length2 > 0) scale += 1 / length2;
        sum += sense.empty() ? previous.cross(inverted) : Vector3(sense[c] * previous.cross(inverted));
        previous = inverted;
      }
    }
    return direction(sum, scale);
  }

  /// The nodes around over usable faces, ring by ring.
  void collect(Index node) {
    around_.assign(1, node);
    seen_[static_cast<std::size_t>(node)] = 1;
    std::size_t begin = 0;
    for (int ring = 0; ring < most_rings && (ring < 2 || around_.size() <= enough_nodes); ++ring) {
      const std::size_t end = around_.size();
      for (; begin < end; ++begin) {
        for (const Corner corner : incidence_.corners(around_[begin])) {
          if (!usable(corner.face)) continue;
          for (const Index j : mesh_.face(corner.face)) {
            if (seen_[static_cast<std::size_t>(j)] != 0 || !mesh_.position(j).allFinite()) continue;
            seen_[static_cast<std::size_t>(j)] = 1;
            around_.push_back(j);
          }
        }
      }
    }
    for (const Index j : around_) seen_[static_cast<std::size_t>(j)] = 0;
    edges_.clear();
    double squares = 0;
    for (std::size_t k = 1; k < around_.size(); ++k) {
      const Vector3 e = position(around_[k]) - position(node);
      if (e.isZero(0)) continue;
      edges_.push_back(e);
      squares += e.dot(e);
    }
    const double size = std::sqrt(squares / static_cast<double>(std::max<std::size_t>(edges_.size(), 1)));
    for (Vector3& e : edges_) e /= size > 0 ? size : 1;
  }

  /// One least-squares fit in the frame of `normal`.
  [[nodiscard]] Vector3 fit(const Vector3& normal) const {
    const Vector3 x = normal.unitOrthogonal();
    const Vector3 y = normal.cross(x);
    const auto rows = static_cast<Eigen::Index>(edges_.size());
    Eigen::Matrix<double, Eigen::Dynamic, 5> terms(rows, 5);
    Eigen::VectorXd heights(rows);
    for (Eigen::Index k = 0; k < rows; ++k) {
      const Vector3& e = edges_[static_cast<std::size_t>(k)];
      const double u = e.dot(x);
      const double v = e.dot(y);
      const double length2 = e.dot(e);
      // Near nodes count more for the tangent plane than far ones: rows are divided by |e|².
      terms.row(k) << u / length2, v / length2, 1, (u * u - v * v) / length2, 2 * u * v / length2;
      heights[k] = e.dot(normal) / length2;
    }
    for (const Eigen::Index unknowns : {5, 3, 2}) {
      if (rows < unknowns) continue;
      const auto solution = least_squares(terms.leftCols(unknowns), heights, independent);
      if (!solution) continue;
      return (normal - (*solution)[0] * x - (*solution)[1] * y).normalized();
    }
    return normal;
  }

  const PolygonMesh& mesh_;
  std::span<const std::uint8_t> usable_;
  Incidence incidence_;
  FanWalker walker_;
  Frame frame_;
  std::vector<std::uint8_t> seen_;
  std::vector<Index> around_;
  std::vector<Vector3> edges_;
};

}  // namespace

void fix_boundary_normals(Constraints& constraints, const PolygonMesh& mesh, const MeshEdges& given) {
  if (given.empty()) return fix_boundary_normals(constraints, mesh);
  const MeshEdges sharp = as_sharp_edges(mesh, given).edges;
  const MeshOfSheets sides = into_sheets(mesh, nodes_of(sharp), sharp);
  const auto boundary = boundary_nodes(mesh);
  std::vector<Index> nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0 && !std::binary_search(sides.origin.begin(), sides.origin.end(), i))
      nodes.push_back(i);
  }
  const std::vector<Vector3> normals = estimate_normals(sides.mesh, nodes);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!normals[k].isZero(0)) constraints.fix_normal(nodes[k], normals[k]);
  }
}

std::vector<Vector3> estimate_normals(const PolygonMesh& mesh, std::span<const Index> nodes,
                                      std::span<const std::uint8_t> usable_face) {
  Estimator estimator(mesh, usable_face);
  std::vector<Vector3> normals;
  normals.reserve(nodes.size());
  for (const Index node : nodes) normals.push_back(estimator.at(node));
  return normals;
}

}  // namespace vspring
