#include "vspring/noise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <vector>

#include "base/dense_algebra.hpp"
#include "base/threads.hpp"
#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"
#include "shape/planarity.hpp"

namespace vspring {

namespace {

// Of the places; features are in the others.
constexpr double share = 0.3;
// Of the normal distribution at that share.
constexpr double quantile = -0.5244;
constexpr std::size_t nodes_in_a_row = 7;
// Least degrees of freedom that tell anything.
constexpr std::size_t least_freedom = 3;
// Of nodes, beyond which they are hubs that everybody is a neighbour of.
constexpr std::size_t most_faces = 100;
constexpr std::size_t most_neighbours = 2 * most_faces;
constexpr double least_pivot = 1e-5;
constexpr std::size_t places_per_task = 256;

/// The mean square, over its degrees of freedom, that 30 of 100 samples of unit noise are below (E. B. Wilson, M. M.
/// Hilferty, "The distribution of chi-square", 1931).
double expected_square(double freedom) {
  const double spread = 2 / (9 * freedom);
  const double root = 1 - spread + quantile * std::sqrt(spread);
  return root * root * root;
}

/// The root mean square height of points over their best quadratic, as a multiple of what noise of deviation 1 has;
/// none where they are too few, or one is no place. first_axes: in how many directions that is a quadratic, 1 or 2;
/// heights: in how many it is one.
std::optional<double> deviation_of(std::span<const Vector3> points, int first_axes, int heights) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index unknowns = first_axes == 2 ? 6 : 3;
  if (count < unknowns + static_cast<Eigen::Index>(least_freedom)) return std::nullopt;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points) centre += p / static_cast<double>(count);
  if (!centre.allFinite()) return std::nullopt;
  double size = 0;
  for (const Vector3& p : points) size = std::max(size, (p - centre).lpNorm<Eigen::Infinity>());
  if (!(size > 0)) return std::nullopt;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) spread += (p - centre) / size * ((p - centre) / size).transpose();
  // Columns in the order of rising eigenvalues.
  const Eigen::Matrix3d axes = principal_axes(spread);
  Eigen::MatrixXd matrix(count, unknowns);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector3 local = axes.transpose() * (points[static_cast<std::size_t>(k)] - centre) / size;
    const double u = local[2];
    const double v = local[1];
    if (first_axes == 2)
      matrix.row(k) << 1, u, v, u * u, u * v, v * v;
    else
      matrix.row(k) << 1, u, u * u;
  }
  double squares = 0;
  for (int height = 0; height < heights; ++height) {
    const auto axis = axes.col(first_axes == 2 ? 0 : 1 - height);
    Eigen::VectorXd right(count);
    for (Eigen::Index k = 0; k < count; ++k) right[k] = axis.dot(points[static_cast<std::size_t>(k)] - centre) / size;
    const auto solution = least_squares(matrix, right, least_pivot);
    if (!solution) return std::nullopt;
    squares += (matrix * *solution - right).squaredNorm();
  }
  const double freedom = static_cast<double>((count - unknowns) * heights);
  return size * std::sqrt(squares / freedom / expected_square(freedom));
}

double at_share(std::vector<double>& values, double part) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

NoiseEstimate summary(std::vector<double> deviations, std::vector<double> edges) {
  const auto unusable = [](double value) { return !std::isfinite(value); };
  deviations.erase(std::remove_if(deviations.begin(), deviations.end(), unusable), deviations.end());
  edges.erase(std::remove_if(edges.begin(), edges.end(), unusable), edges.end());
  NoiseEstimate result;
  if (deviations.empty() || edges.empty()) return result;
  result.nodes = static_cast<Index>(deviations.size());
  result.deviation = at_share(deviations, share);
  const double edge = at_share(edges, 0.5);
  result.edges = edge > 0 ? result.deviation / edge : 0;
  return result;
}

}  // namespace

NoiseEstimate estimate_noise(const PolygonMesh& mesh, const Context& context) {
  const Incidence incidence(mesh);
  const NodeGraph graph(mesh, incidence);
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<double> deviations(nodes, std::nan(""));
  ThreadTeam team(context.thread_count());
  parallel_ranges(team, nodes, places_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> around;
    std::vector<Vector3> places;
    for (std::size_t i = begin; i < end; ++i) {
      around.assign(1, static_cast<Index>(i));
      graph.for_each_neighbour(static_cast<Index>(i), [&](Index j) { around.push_back(j); });
      const std::size_t neighbours = around.size();
      if (neighbours > most_neighbours) continue;
      for (std::size_t k = 1; k < neighbours; ++k) {
        if (incidence.corners(around[k]).size() > most_faces) continue;
        graph.for_each_neighbour(around[k], [&](Index j) { around.push_back(j); });
      }
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      places.clear();
      for (const Index j : around) places.push_back(mesh.position(j));
      if (const auto deviation = deviation_of(places, 2, 1)) deviations[i] = *deviation;
    }
  });
  std::vector<double> edges;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    graph.for_each_neighbour(i, [&](Index j) {
      if (j > i) edges.push_back((mesh.position(j) - mesh.position(i)).norm());
    });
  }
  return summary(std::move(deviations), std::move(edges));
}

NoiseEstimate estimate_noise(const PolygonCurve& curve) {
  const int heights = plane_normal(curve.positions()) ? 1 : 2;
  std::vector<double> deviations;
  std::vector<double> edges;
  std::vector<Vector3> places;
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    const auto at = [&](std::size_t k) -> const Vector3& { return curve.position(chain.nodes[k % count]); };
    for (std::size_t k = 0; k + 1 < count + (chain.closed ? 1 : 0); ++k) edges.push_back((at(k + 1) - at(k)).norm());
    if (count < nodes_in_a_row) continue;
    for (std::size_t k = 0; k < (chain.closed ? count : count - nodes_in_a_row + 1); ++k) {
      places.clear();
      for (std::size_t n = 0; n < nodes_in_a_row; ++n) places.push_back(at(k + n));
      if (const auto deviation = deviation_of(places, 1, heights)) deviations.push_back(*deviation);
    }
  }
  return summary(std::move(deviations), std::move(edges));
}

}  // namespace vspring
