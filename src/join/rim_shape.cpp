#include "join/rim_shape.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <unordered_set>

#include "base/cancellation.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"

namespace vspring {

namespace {

// What noise of a tenth of an edge needs.
constexpr std::size_t enough_outside = 70;
constexpr int most_rings_outside = 8;
// Heights, slopes, three of second and four of third degree; and some more nodes than these.
constexpr Eigen::Index terms_outside = 10;
constexpr std::size_t fewest_outside = 16;
constexpr Eigen::Index term_of_mean = 3;
// The plane of the heights turns into the tangent plane.
constexpr int passes = 3;
// Of the distances of the nodes, root mean square: what is off by more is no smooth surface.
constexpr double most_off = 0.1;
// The same, squared: what rounding leaves.
constexpr double least_left = 1e-28;

class OutsideShapes {
 public:
  OutsideShapes(const PolygonMesh& mesh, const std::vector<std::uint8_t>& moves)
      : mesh_(mesh), moves_(moves), incidence_(mesh) {}

  /// Of rings that tell it by ever more nodes, those by which it is known best.
  [[nodiscard]] std::optional<RimShape> at(Index node) const {
    Vector3 normal = normal_at(node);
    std::vector<Index> nodes = {node};
    std::unordered_set<Index> seen = {node};
    // In a notch a node has no face without one that moves.
    for (const Corner corner : incidence_.corners(node)) {
      for (const Index j : mesh_.face(corner.face)) {
        if (moves_[static_cast<std::size_t>(j)] != 0 || !seen.insert(j).second) continue;
        nodes.push_back(j);
        normal += normal_at(j);
      }
    }
    normal.stableNormalize();
    if (normal.isZero(0)) return std::nullopt;
    std::size_t done = 0;
    std::optional<Fitted> best;
    for (int ring = 0; ring < most_rings_outside && nodes.size() < enough_outside; ++ring) {
      for (const std::size_t end = nodes.size(); done < end; ++done) {
        for (const Corner corner : incidence_.corners(nodes[done])) {
          if (!is_outside(corner.face)) continue;
          for (const Index j : mesh_.face(corner.face)) {
            if (seen.insert(j).second) nodes.push_back(j);
          }
        }
      }
      if (nodes.size() < fewest_outside) continue;
      std::optional<Fitted> found;
      Vector3 plane = normal;
      for (int pass = 0; pass < passes; ++pass) {
        found = fitted(node, nodes, plane);
        if (!found) break;
        plane = found->shape.normal;
      }
      if (found && (!best || found->variance < best->variance)) best = found;
    }
    if (!best) return std::nullopt;
    return best->shape;
  }

 private:
  [[nodiscard]] bool is_outside(Index face) const {
    const auto nodes = mesh_.face(face);
    return std::none_of(nodes.begin(), nodes.end(), [&](Index j) { return moves_[static_cast<std::size_t>(j)] != 0; });
  }

  struct Fitted {
    RimShape shape;
    double variance;  ///< of the mean curvature, by what heights are off the polynomial
  };

  [[nodiscard]] Vector3 normal_at(Index node) const {
    Vector3 sum = Vector3::Zero();
    for (const Corner corner : incidence_.corners(node)) {
      if (is_outside(corner.face)) sum += twice_vector_area(mesh_.face(corner.face), mesh_.positions());
    }
    return sum.stableNormalized();
  }

  [[nodiscard]] std::optional<Fitted> fitted(Index node, const std::vector<Index>& nodes, const Vector3& normal) const {
    const Vector3& origin = mesh_.position(node);
    const Vector3 aside = normal.unitOrthogonal();
    const Vector3 ahead = normal.cross(aside);
    double squares = 0;
    for (const Index j : nodes) squares += (mesh_.position(j) - origin).squaredNorm();
    const double unit = std::sqrt(squares / static_cast<double>(nodes.size()));
    if (!(unit > 0) || !std::isfinite(unit)) return std::nullopt;
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Eigen::Matrix<double, Eigen::Dynamic, terms_outside> rows(count, terms_outside);
    Eigen::VectorXd heights(count);
    for (Eigen::Index k = 0; k < count; ++k) {
      const Vector3 d = (mesh_.position(nodes[static_cast<std::size_t>(k)]) - origin) / unit;
      const double u = d.dot(aside);
      const double v = d.dot(ahead);
      // On spheres exact: of second degree by the whole distance.
      rows.row(k) << 1, u, v, d.squaredNorm() / 2, (u * u - v * v) / 2, u * v, u * u * u, u * u * v, u * v * v,
          v * v * v;
      heights[k] = d.dot(normal);
    }
    const Eigen::Matrix<double, terms_outside, terms_outside> products = rows.transpose() * rows;
    const Eigen::FullPivLU<Eigen::Matrix<double, terms_outside, terms_outside>> solver(products);
    if (!solver.isInvertible()) return std::nullopt;
    const Eigen::Matrix<double, terms_outside, 1> c = solver.solve(rows.transpose() * heights);
    const double left = (heights - rows * c).squaredNorm() / static_cast<double>(count - terms_outside);
    if (!(left < most_off * most_off)) return std::nullopt;
    const Eigen::Matrix<double, terms_outside, 1> of_mean =
        solver.solve(Eigen::Matrix<double, terms_outside, 1>::Unit(terms_outside, term_of_mean));
    const double variance = std::max(left, least_left) * of_mean[term_of_mean] / (unit * unit);
    Eigen::Matrix2d second;
    second << c[3] + c[4], c[5], c[5], c[3] - c[4];
    Eigen::Matrix<double, 3, 2> plane;
    plane << aside, ahead;
    const Eigen::Matrix3d form = plane * second * plane.transpose() / unit;
    return Fitted{{(normal - c[1] * aside - c[2] * ahead).normalized(), form}, variance};
  }

  const PolygonMesh& mesh_;
  const std::vector<std::uint8_t>& moves_;
  Incidence incidence_;
};

}  // namespace

std::vector<std::optional<RimShape>> rim_shapes(const PolygonMesh& mesh, const std::vector<std::uint8_t>& moves,
                                                const std::vector<Index>& nodes) {
  const OutsideShapes outside(mesh, moves);
  std::vector<std::optional<RimShape>> shapes;
  shapes.reserve(nodes.size());
  for (const Index node : nodes) {
    end_if_cancelled();
    shapes.push_back(outside.at(node));
  }
  return shapes;
}

}  // namespace vspring
