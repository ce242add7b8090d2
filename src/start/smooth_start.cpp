#include "start/smooth_start.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "precondition/curve_bending_rows.hpp"

namespace vspring {

namespace {

// The k of a smoothing length of thirty edges.
constexpr double least_pull = 1e-7;

using Matrix = Eigen::SparseMatrix<double>;

/// Rows whose sum of squares is the bending of a curve, and their targets by held nodes and given directions.
struct Bending {
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<Vector3> targets;
};

Bending bending_of(const Net& net) {
  Bending bending;
  for (const MovingRun& moving_run : net.moving_runs) {
    for_each_bending_row(net, moving_run, [&](const CurveBendingRow& row) {
      Vector3 target = Vector3::Zero();
      for (const auto& [place, entry] : row.entries) {
        const std::size_t node = moving_run.nodes[place];
        if (node < net.moving)
          bending.entries.emplace_back(static_cast<int>(bending.targets.size()), static_cast<int>(node), entry);
        else
          target -= entry * net.positions[node];
      }
      if (row.given) {
        const auto& [from, to] =
            std::pair(moving_run.nodes[row.entries[0].first], moving_run.nodes[row.entries[1].first]);
        Vector3 way = net.positions[to] - net.positions[from];
        const std::size_t given = moving_run.nodes[*row.given];
        if (net.tangent_given(given)) way = std::sqrt(way.dot(way) + net.tiny) * net.tangents[given];
        target += row.entries[1].second * way;
      }
      bending.targets.push_back(target);
    });
  }
  return bending;
}

/// Moves nodes to where the sum of the bending and Σ force |x − place|² is least. False, and nothing is changed, if
/// rounding prevents that.
bool bend_towards(Net& net, const std::vector<double>& forces, const std::vector<Vector3>& places) {
  const auto count = static_cast<Eigen::Index>(net.moving);
  const Bending bending = bending_of(net);
  Matrix rows(static_cast<Eigen::Index>(bending.targets.size()), count);
  rows.setFromTriplets(bending.entries.begin(), bending.entries.end());
  Eigen::MatrixX3d targets(rows.rows(), 3);
  for (Eigen::Index k = 0; k < rows.rows(); ++k)
    targets.row(k) = bending.targets[static_cast<std::size_t>(k)].transpose();
  Matrix matrix = rows.transpose() * rows;
  Eigen::MatrixX3d right = rows.transpose() * targets;
  std::vector<Eigen::Triplet<double>> diagonal_entries;
  for (Eigen::Index i = 0; i < count; ++i) {
    const double force = forces[static_cast<std::size_t>(i)];
    if (!(force > 0)) continue;
    diagonal_entries.emplace_back(static_cast<int>(i), static_cast<int>(i), force);
    right.row(i) += force * places[static_cast<std::size_t>(i)].transpose();
  }
  Matrix diagonal(count, count);
  diagonal.setFromTriplets(diagonal_entries.begin(), diagonal_entries.end());
  matrix += diagonal;
  const Eigen::SimplicialLDLT<Matrix> factor(matrix);
  if (factor.info() != Eigen::Success) return false;
  const Eigen::MatrixX3d found = factor.solve(right);
  if (!found.allFinite()) return false;
  for (Eigen::Index i = 0; i < count; ++i) net.positions[static_cast<std::size_t>(i)] = found.row(i).transpose();
  return true;
}

}  // namespace

void start_smooth(Net& net, const std::vector<double>& pull) {
  std::vector<double> forces(net.moving, 0);
  std::vector<Vector3> places(net.moving, Vector3::Zero());
  for (std::size_t i = 0; i < net.moving && !net.points.empty(); ++i) {
    double weight = 0;
    for (const Link link : net.rings.links(i)) {
      const Vector3 d = net.positions[link.node()] - net.positions[i];
      weight += 2 / std::pow(d.dot(d) + net.tiny, 1.5);
    }
    double weights = 0;
    for (const std::uint32_t k : net.points.of(i)) {
      places[i] += net.points.weights[k] * net.points.positions[k];
      weights += net.points.weights[k];
    }
    if (!(weights > 0)) continue;
    places[i] /= weights;
    forces[i] = weight * std::max(pull[i], least_pull);
  }
  (void)bend_towards(net, forces, places);
}

bool smooth_near(Net& net, const std::vector<Vector3>& home, double smoothing_length) {
  std::vector<double> forces(net.moving, 0);
  for (std::size_t i = 0; i < net.moving; ++i) {
    double lengths = 0;
    for (const Link link : net.rings.links(i)) lengths += (net.positions[link.node()] - net.positions[i]).norm();
    // The rows of bending come to half of ∫ κ² ds.
    forces[i] = lengths / (4 * std::pow(smoothing_length, 4));
  }
  return bend_towards(net, forces, home);
}

}  // namespace vspring
