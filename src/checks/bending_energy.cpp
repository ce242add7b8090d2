#include "checks/bending_energy.hpp"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "spring/near_nodes.hpp"

namespace vspring {

namespace {

// In products of lengths as shares of that of a link: terms that few nodes do not determine become zero.
constexpr double ridge_of_quadratics = 1e-9;
// Step for differences, as a share of the mean edge at a node; rounding is far below.
constexpr double small_move = 1e-4;
// Share of the mean square of the residuals, over the squares of distances, that counts.
constexpr double share_of_what_is_left = 16;

/// The sum of the vector areas of the faces around a node, times two, and its share of their areas.
struct Surrounding {
  Vector3 normal = Vector3::Zero();
  double share = 0;
  bool has_rim = false;
};

Surrounding surrounding(const Net& net, const std::vector<Vector3>& positions, std::size_t i) {
  Surrounding result;
  const auto links = net.rings.links(i);
  const auto place = [&](std::size_t k) -> Vector3 { return positions[links[k].node()] - positions[i]; };
  // From spoke to spoke, a face each.
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    Vector3 area = Vector3::Zero();
    std::size_t corners = 2;
    bool is_face = links.size() > 1;
    for (std::size_t at = k; is_face;) {
      const std::size_t next = at + 1 < links.size() ? at + 1 : 0;
      is_face = !links[next].start();
      area += place(at).cross(place(next));
      ++corners;
      at = next;
      if (links[at].spoke()) break;
    }
    if (!is_face) {
      result.has_rim = true;
      continue;
    }
    result.normal += area;
    result.share += 0.5 * area.norm() / static_cast<double>(corners);
  }
  return result;
}

}  // namespace

BendingEnergy::BendingEnergy(const Net& net) : net_(&net), begin_(net.moving + 1, 0) {
  std::vector<std::vector<std::uint32_t>> around(net.moving);
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto take = [&](std::size_t j) {
      if (j < net.moving && (around[j].empty() || around[j].back() != i))
        around[j].push_back(static_cast<std::uint32_t>(i));
    };
    take(i);
    for_near_nodes(net, i, take);
    for (const Link link : net.rings.links(i)) take(link.node());
  }
  for (std::size_t j = 0; j < net.moving; ++j) begin_[j + 1] = begin_[j] + around[j].size();
  around_.reserve(begin_.back());
  for (const auto& nodes : around) around_.insert(around_.end(), nodes.begin(), nodes.end());
}

double BendingEnergy::of(const std::vector<Vector3>& positions, ThreadTeam& team) const {
  const auto add = [&](std::size_t begin, std::size_t end, double& sum) {
    for (std::size_t i = begin; i < end; ++i) sum += around(positions, i);
  };
  double energy = 0;
  for (const double part : parallel_parts(team, net_->computed, nodes_per_task, 0.0, add)) energy += part;
  return energy;
}

std::vector<double> BendingEnergy::slopes(const std::vector<Vector3>& positions, ThreadTeam& team) const {
  std::vector<double> slopes(net_->moving);
  parallel_ranges(team, net_->moving, nodes_per_task / 8, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector3> moved = positions;
    for (std::size_t j = begin; j < end; ++j) {
      const double move = small_move * mean_edge(*net_, j);
      if (!(move > 0)) continue;
      double difference = 0;
      for (const double way : {move, -move}) {
        moved[j] = positions[j] + way * net_->normals[j];
        for (std::size_t k = begin_[j]; k < begin_[j + 1]; ++k)
          difference += (way > 0 ? 1 : -1) * around(moved, around_[k]);
      }
      moved[j] = positions[j];
      slopes[j] = difference / (2 * move);
    }
  });
  return slopes;
}

Eigen::SparseMatrix<double> BendingEnergy::second_derivative(const std::vector<Vector3>& positions) const {
  const Net& net = *net_;
  std::vector<Eigen::Triplet<double>> entries;
  std::vector<std::size_t> nodes;
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto plane = plane_at(positions, i);
    if (!plane) continue;
    nodes.clear();
    for_near_nodes(net, i, [&](std::size_t j) { nodes.push_back(j); });
    const auto count = static_cast<Eigen::Index>(nodes.size());
    Eigen::Matrix<double, 5, Eigen::Dynamic> rows(5, count);
    Eigen::VectorXd scales(count);
    for (Eigen::Index k = 0; k < count; ++k)
      scales[k] = plane->equation(positions[nodes[static_cast<std::size_t>(k)]], rows.col(k).data());
    Eigen::Matrix<double, 5, 5> products = rows * rows.transpose();
    products.diagonal().array() += ridge_of_quadratics;
    const Eigen::Matrix<double, 5, Eigen::Dynamic> fit = products.ldlt().solve(rows);
    // By heights over the squares of distances: the energy of the fitted form, and of its residuals.
    Eigen::MatrixXd form = share_of_what_is_left / static_cast<double>(count) *
                           (Eigen::MatrixXd::Identity(count, count) - rows.transpose() * fit);
    for (const auto& [of_form, times] : {std::pair(2, 1.0), std::pair(3, 2.0), std::pair(4, 1.0)})
      form += times * fit.row(of_form).transpose() * fit.row(of_form);
    form = 2 * plane->share / (plane->unit * plane->unit) * scales.asDiagonal() * form * scales.asDiagonal();
    // If a node moves along its normal its height grows; if the one in the middle does, all others fall.
    Eigen::MatrixXd heights = Eigen::MatrixXd::Zero(count, count + 1);
    for (Eigen::Index k = 0; k < count; ++k) {
      heights(k, k) = net.normals[nodes[static_cast<std::size_t>(k)]].dot(plane->normal);
      heights(k, count) = -net.normals[i].dot(plane->normal);
    }
    const Eigen::MatrixXd all = heights.transpose() * form * heights;
    nodes.push_back(i);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      for (std::size_t m = 0; m < nodes.size(); ++m) {
        if (nodes[k] >= net.moving || nodes[m] > nodes[k]) continue;
        entries.emplace_back(static_cast<int>(nodes[k]), static_cast<int>(nodes[m]),
                             all(static_cast<Eigen::Index>(k), static_cast<Eigen::Index>(m)));
      }
    }
  }
  const auto size = static_cast<Eigen::Index>(net.moving);
  Eigen::SparseMatrix<double> result(size, size);
  result.setFromTriplets(entries.begin(), entries.end());
  return result;
}

double BendingEnergy::weight(const std::vector<Vector3>& positions, std::size_t i) const {
  double squares = 0;
  double spokes = 0;
  for (const Link link : net_->rings.links(i)) {
    if (!link.spoke()) continue;
    squares += (positions[link.node()] - positions[i]).squaredNorm();
    spokes += 1;
  }
  const double mean = spokes > 0 ? squares / spokes : 0;
  return 16 * area(positions, i) / std::max(mean * mean, net_->tiny * net_->tiny);
}

double BendingEnergy::area(const std::vector<Vector3>& positions, std::size_t i) const {
  return surrounding(*net_, positions, i).share;
}

double BendingEnergy::around(const std::vector<Vector3>& positions, std::size_t i) const {
  const auto plane = plane_at(positions, i);
  return plane ? bending_over(*plane, *net_, positions, i, share_of_what_is_left) : 0;
}

std::optional<HeightPlane> BendingEnergy::plane_at(const std::vector<Vector3>& positions, std::size_t i) const {
  // Of very many neighbours each would ask for all.
  if (net_->rings.links(i).size() > most_links_beside) return std::nullopt;
  const bool is_given = net_->normal_given(i);
  const Surrounding around = surrounding(*net_, positions, i);
  if (around.has_rim && !is_given) return std::nullopt;
  return height_plane(*net_, positions, i, is_given ? net_->normals[i] : around.normal, around.share, !is_given);
}

std::optional<HeightPlane> height_plane(const Net& net, const std::vector<Vector3>& positions, std::size_t i,
                                        const Vector3& normal, double share, bool tilts) {
  if (!(normal.squaredNorm() > 0)) return std::nullopt;
  HeightPlane plane;
  plane.origin = positions[i];
  plane.normal = normal.normalized();
  plane.aside = plane.normal.unitOrthogonal();
  plane.ahead = plane.normal.cross(plane.aside);
  plane.share = share;
  plane.tilts = tilts;
  const auto links = net.rings.links(i);
  double squares = 0;
  for (const Link link : links) squares += (positions[link.node()] - positions[i]).squaredNorm();
  plane.unit = std::sqrt(squares / static_cast<double>(links.size()));
  return plane;
}

double HeightPlane::equation(const Vector3& place, double* row) const {
  const Vector3 e = (place - origin) / unit;
  const double square = e.squaredNorm();
  const double scale = square > 0 ? 1 / square : 0;
  const double x = scale * e.dot(aside);
  const double y = scale * e.dot(ahead);
  row[0] = tilts ? x : 0;
  row[1] = tilts ? y : 0;
  row[2] = square * x * x / 2;
  row[3] = square * x * y;
  row[4] = square * y * y / 2;
  return scale / unit;
}

double bending_over(const HeightPlane& plane, const Net& net, const std::vector<Vector3>& positions, std::size_t i,
                    double share_of_rest) {
  using Unknowns = Eigen::Matrix<double, 5, 1>;
  Eigen::Matrix<double, 5, 5> products = Eigen::Matrix<double, 5, 5>::Zero();
  Unknowns right = Unknowns::Zero();
  double heights = 0;
  double count = 0;
  for_near_nodes(net, i, [&](std::size_t j) {
    Unknowns row;
    const double scale = plane.equation(positions[j], row.data());
    const double height = scale * (positions[j] - plane.origin).dot(plane.normal);
    products += row * row.transpose();
    right += height * row;
    heights += height * height;
    count += 1;
  });
  products.diagonal().array() += ridge_of_quadratics;
  const Unknowns fit = products.ldlt().solve(right);
  // Of a graph of heights; κ₁² + κ₂² = (κ₁ + κ₂)² − 2 κ₁ κ₂.
  const double p = fit[0];
  const double q = fit[1];
  const double stretch = 1 + p * p + q * q;
  const double sum = ((1 + q * q) * fit[2] - 2 * p * q * fit[3] + (1 + p * p) * fit[4]) / std::pow(stretch, 1.5);
  const double product = (fit[2] * fit[4] - fit[3] * fit[3]) / (stretch * stretch);
  const double rest = share_of_rest > 0 ? share_of_rest * std::max(0.0, heights - fit.dot(right)) / count : 0;
  return (sum * sum - 2 * product + rest) * plane.share / (plane.unit * plane.unit);
}

}  // namespace vspring
