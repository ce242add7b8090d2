#include "fit/side_places.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"

namespace vspring {

namespace {

constexpr int fewest_rings = 2;
constexpr int most_rings = 8;
// Terms of a plane and of a quadratic.
constexpr int terms_of_plane = 3;
constexpr int most_terms = 6;
// Nodes, more than the terms.
constexpr int fewest_more = 3;
// Share of the deviation that is due to chance in the residuals.
constexpr double most_chance = 0.5;
// In deviations of a quadratic: a plane further from it than that misses a bend.
constexpr double most_difference = 1;
// Where so many sides meet, each is a wedge, for which planes are more reliable than quadratics.
constexpr std::size_t sides_of_corner = 3;
// The weight of a node's own place in each direction, with squares of the noise for units.
constexpr double weight_of_place = 0.02;

/// The tangent plane of a side at a node.
struct SidePlane {
  Vector3 normal;
  double offset;    ///< of the plane from the node, along the normal
  double variance;  ///< of that, in squares of the noise
};

/// Fits a polynomial of so many terms over the plane nearest to the nodes.
std::optional<SidePlane> plane_by(const std::vector<Vector3>& nodes, const Vector3& at, int terms, double noise) {
  const auto count = static_cast<Eigen::Index>(nodes.size());
  if (count < terms + fewest_more) return std::nullopt;
  Vector3 mean = Vector3::Zero();
  for (const Vector3& p : nodes) mean += (p - at) / static_cast<double>(count);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : nodes) spread += (p - at - mean) * (p - at - mean).transpose();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> axes(spread);
  const double size = std::sqrt(axes.eigenvalues()[2] / static_cast<double>(count));
  if (!(size > 0)) return std::nullopt;
  Eigen::MatrixXd rows(count, terms);
  Eigen::VectorXd heights(count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector3 local = axes.eigenvectors().transpose() * (nodes[static_cast<std::size_t>(k)] - at);
    const double u = local[2] / size;
    const double v = local[1] / size;
    const Eigen::Matrix<double, most_terms, 1> all{1, u, v, u * u, u * v, v * v};
    rows.row(k) = all.head(terms).transpose();
    heights[k] = local[0];
  }
  const Eigen::FullPivLU<Eigen::MatrixXd> solver(rows.transpose() * rows);
  if (!solver.isInvertible()) return std::nullopt;
  const Eigen::VectorXd found = solver.solve(rows.transpose() * heights);
  const double freedom = static_cast<double>(count - terms);
  const double left = std::sqrt((heights - rows * found).squaredNorm() / freedom);
  if (left > noise * (1 + most_chance * std::sqrt(2 / freedom))) return std::nullopt;
  const Eigen::VectorXd first = Eigen::VectorXd::Unit(terms, 0);
  const Vector3 normal = axes.eigenvectors() * Vector3(1, -found[2] / size, -found[1] / size);
  const double length = normal.norm();
  return SidePlane{normal / length, found[0] / length, first.dot(solver.solve(first))};
}

bool agree(const SidePlane& plane, const SidePlane& quadratic, double noise) {
  const double difference = quadratic.normal.dot(plane.offset * plane.normal) - quadratic.offset;
  return std::abs(difference) < most_difference * noise * std::sqrt(quadratic.variance);
}

class SideFitter {
 public:
  SideFitter(const PolygonMesh& cut, double noise)
      : cut_(cut), incidence_(cut), graph_(cut, incidence_), noise_(noise), ring_of_(cut.positions().size(), -1) {}

  /// By the nodes about one of a chain, as one side has it; of so many sides there.
  std::optional<SidePlane> plane_at(Index node, std::size_t sides) {
    std::vector<Index> seen = {node};
    std::vector<Vector3> nodes = {cut_.position(node)};
    ring_of_[static_cast<std::size_t>(node)] = 0;
    std::optional<SidePlane> plane;
    std::optional<SidePlane> quadratic;
    std::size_t done = 0;
    for (int ring = 1; ring <= most_rings; ++ring) {
      for (const std::size_t end = seen.size(); done < end; ++done) {
        graph_.for_each_neighbour(seen[done], [&](Index j) {
          if (ring_of_[static_cast<std::size_t>(j)] >= 0) return;
          ring_of_[static_cast<std::size_t>(j)] = ring;
          seen.push_back(j);
          nodes.push_back(cut_.position(j));
        });
      }
      if (ring < fewest_rings) continue;
      take_better(plane_by(nodes, cut_.position(node), terms_of_plane, noise_), plane);
      take_better(plane_by(nodes, cut_.position(node), most_terms, noise_), quadratic);
    }
    for (const Index i : seen) ring_of_[static_cast<std::size_t>(i)] = -1;
    if (!plane || !quadratic) return plane ? plane : quadratic;
    const bool is_plane =
        plane->variance < quadratic->variance && (sides >= sides_of_corner || agree(*plane, *quadratic, noise_));
    return is_plane ? plane : quadratic;
  }

 private:
  static void take_better(const std::optional<SidePlane>& found, std::optional<SidePlane>& best) {
    if (found && (!best || found->variance < best->variance)) best = found;
  }

  const PolygonMesh& cut_;
  Incidence incidence_;
  NodeGraph graph_;
  double noise_;
  std::vector<int> ring_of_;
};

}  // namespace

SidePlaces places_by_sides(const PolygonMesh& mesh, const PolygonMesh& cut, const std::vector<Index>& origin,
                           double noise) {
  SideFitter fitter(cut, noise);
  std::vector<std::vector<Index>> copies(mesh.positions().size());
  for (std::size_t k = 0; k < origin.size(); ++k)
    copies[static_cast<std::size_t>(origin[k])].push_back(mesh.node_count() + static_cast<Index>(k));
  SidePlaces result{.positions = mesh.positions()};
  double variances = 0;
  std::size_t count = 0;
  for (std::size_t i = 0; i < copies.size(); ++i) {
    if (copies[i].empty()) continue;
    copies[i].push_back(static_cast<Index>(i));
    Eigen::Matrix3d squares = weight_of_place * Eigen::Matrix3d::Identity();
    Vector3 sum = Vector3::Zero();
    for (const Index node : copies[i]) {
      const auto plane = fitter.plane_at(node, copies[i].size());
      ++count;
      variances += plane ? plane->variance : 1;
      if (!plane) continue;
      squares += plane->normal * plane->normal.transpose() / plane->variance;
      sum += plane->offset / plane->variance * plane->normal;
    }
    result.positions[i] += squares.ldlt().solve(sum);
    if (copies[i].size() >= sides_of_corner) result.corners.push_back(static_cast<Index>(i));
  }
  result.deviation = noise * std::sqrt(variances / std::max<double>(1, static_cast<double>(count)));
  return result;
}

}  // namespace vspring
