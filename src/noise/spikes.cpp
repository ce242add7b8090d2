#include "noise/spikes.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <utility>

#include "base/dense_algebra.hpp"
#include "noise/noisy_places.hpp"
#include "noise/two_rings.hpp"

namespace vspring {

namespace {

using Terms = Eigen::Matrix<double, 6, 1>;

// Beside the six unknowns of a quadratic.
constexpr std::size_t fewest_around = 9;
constexpr std::size_t nodes_per_piece = 256;
constexpr int rounds_of_weights = 4;
// In standard deviations: where a point counts half (Cauchy's weights).
constexpr double half_weight = 2;
constexpr double least_pivot_of_quadratic = 1e-5;

Terms terms_at(double u, double v) { return (Terms() << 1, u, v, u * u, u * v, v * v).finished(); }

/// How far a node is off the quadratic through the nodes around it, in standard deviations; 0 if unknown.
double deviations_off(const Vector3& node, std::span<const Vector3> around, double noise) {
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : around) centre += p / static_cast<double>(around.size());
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : around) spread += (p - centre) * (p - centre).transpose();
  const double size = std::sqrt(spread.trace() / static_cast<double>(around.size()));
  if (!(size > 0) || !std::isfinite(size)) return 0;
  const Eigen::Matrix3d axes = principal_axes(spread / (size * size));
  const auto count = static_cast<Eigen::Index>(around.size());
  Eigen::MatrixXd terms(count, Terms::RowsAtCompileTime);
  Eigen::VectorXd heights(count);
  double reach = 0;
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector3 local = axes.transpose() * (around[static_cast<std::size_t>(k)] - centre) / size;
    terms.row(k) = terms_at(local[2], local[1]);
    heights[k] = local[0];
    reach = std::max(reach, local.tail<2>().norm());
  }
  const double freedom = std::sqrt(static_cast<double>(count) / static_cast<double>(count - terms.cols()));
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(count);
  Eigen::VectorXd solution;
  double deviation = 0;
  std::vector<double> left(around.size());
  for (int round = 0; round < rounds_of_weights; ++round) {
    const auto found =
        least_squares(weights.asDiagonal() * terms, weights.asDiagonal() * heights, least_pivot_of_quadratic);
    if (!found) return 0;
    solution = *found;
    const Eigen::VectorXd off = (heights - terms * solution).cwiseAbs();
    for (Eigen::Index k = 0; k < count; ++k) left[static_cast<std::size_t>(k)] = off[k];
    deviation = std::max(noise / size, freedom * value_at_share(left, 0.5) / median_of_noise);
    if (!(deviation > 0)) break;
    weights = (1 + (off / (half_weight * deviation)).array().square()).rsqrt().matrix();
  }
  // A node beside them all is measured from the quadratic at their rim: further out that means nothing.
  const Vector3 local = axes.transpose() * (node - centre) / size;
  const double way = local.tail<2>().norm();
  const double inside = way > reach ? reach / way : 1;
  const Terms at = terms_at(inside * local[2], inside * local[1]);
  // The quadratic is uncertain beside its points.
  const Eigen::MatrixXd gram = terms.transpose() * terms;
  const double uncertain = at.dot(inverse(gram) * at);
  const double off = std::hypot(local[0] - at.dot(solution), (1 - inside) * way);
  const double expected = deviation * std::sqrt(1 + std::max(0.0, uncertain));
  return off > 0 && std::isfinite(expected) ? off / expected : 0;
}

}  // namespace

std::vector<std::uint8_t> spikes_of(const PolygonMesh& mesh, const std::vector<std::uint8_t>& candidates,
                                    double deviation, double least, std::size_t most, ThreadTeam& team) {
  const Incidence incidence(mesh);
  const NodeGraph graph(mesh, incidence);
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<double> off(nodes, 0);
  parallel_ranges(team, nodes, nodes_per_piece, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> around;
    std::vector<Vector3> places;
    for (std::size_t i = begin; i < end; ++i) {
      if (candidates[i] == 0) continue;
      two_rings(graph, incidence, static_cast<Index>(i), around);
      places.clear();
      for (const Index j : around) {
        if (static_cast<std::size_t>(j) != i) places.push_back(mesh.position(j));
      }
      if (places.size() >= fewest_around)
        off[i] = deviations_off(mesh.position(static_cast<Index>(i)), places, deviation);
    }
  });
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < nodes; ++i) {
    if (off[i] > least) found.push_back(i);
  }
  std::sort(found.begin(), found.end(),
            [&](std::size_t a, std::size_t b) { return std::pair(-off[a], a) < std::pair(-off[b], b); });
  found.resize(std::min(found.size(), most));
  std::vector<std::uint8_t> spikes(nodes, 0);
  for (const std::size_t i : found) spikes[i] = 1;
  return spikes;
}

}  // namespace vspring
