#include "spring/shares.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "base/dense_algebra.hpp"
#include "base/linear_precision.hpp"
#include "spring/pseudo_normal.hpp"

namespace vspring {

namespace {

// Least share, relative to that by inverse squares of distances. Without it, nodes outside their neighbours, or on a
// line with two of them, would hardly be held on some side.
constexpr double least_share = 0.25;
// Coarser levels must unfold whatever edges they have, rather than keep a spacing.
constexpr double least_share_of_coarse = 0.8;
// The sine of an angle that counts as zero.
constexpr double least_sine = 1e-9;
// Least share, relative to that by inverse squares, of a node outside its neighbours.
constexpr double least_mean_value = 0.01;
// The least share of the sum of shares that is left when they are corrected to keep a node in its place.
constexpr double least_left = 0.2;

/// Mean value coordinates of a node among its neighbours. ways: vectors to them, in a plane. None if the node lies
/// outside them.
void find_mean_value_shares(std::span<const Vector3> ways, const Vector3& normal, std::vector<double>& shares) {
  const std::size_t count = ways.size();
  shares.assign(count, 0);
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    const double lengths = ways[k].norm() * ways[next].norm();
    const double product = ways[k].cross(ways[next]).dot(normal);
    // The tangent of half the angle between the two; very large if they are opposite.
    const double least = least_sine * lengths;
    const double half = (lengths - ways[k].dot(ways[next])) / (std::abs(product) > least ? product : least);
    shares[k] += half;
    shares[next] += half;
  }
  double sum = 0;
  for (std::size_t k = 0; k < count; ++k) sum += shares[k] /= ways[k].norm();
  if (!(std::abs(sum) > 0) || !std::isfinite(sum)) {
    std::fill(shares.begin(), shares.end(), 1);
    return;
  }
  for (double& share : shares) share /= sum;
}

/// Shares of a node among its neighbours, see laplacian_weights_at(). tiny: see Net. least: least share, relative to
/// that by inverse squares.
void find_shares(std::span<const Vector3> ways, const Vector3& normal, double tiny, double least,
                 std::vector<double>& shares) {
  double inverse_squares = 0;
  for (const Vector3& way : ways) inverse_squares += 1 / (way.squaredNorm() + tiny);
  const auto by_distance = [&](const Vector3& way) { return 1 / ((way.squaredNorm() + tiny) * inverse_squares); };
  find_mean_value_shares(ways, normal, shares);
  LinearPrecision linear;
  for (std::size_t k = 0; k < ways.size(); ++k) {
    const double by = by_distance(ways[k]);
    shares[k] = std::sqrt(by * std::max(shares[k], least_mean_value * by));
    linear.add(shares[k], ways[k]);
  }
  const Vector3 slope =
      linear.size() > 0 ? linear.leaving(least_left, linear.slope_across(normal)) : Vector3(Vector3::Zero());
  double sum = 0;
  for (std::size_t k = 0; k < ways.size(); ++k) sum += shares[k] *= 1 - slope.dot(ways[k]);
  double raised_sum = 0;
  for (std::size_t k = 0; k < ways.size(); ++k)
    raised_sum += shares[k] = std::max(shares[k] / sum, least * by_distance(ways[k]));
  for (double& share : shares) share /= raised_sum;
}

}  // namespace

void even_shares(const Net& net, std::size_t i, const Vector3& normal, std::span<const Vector3> places,
                 std::span<double> shares) {
  const auto links = net.rings.links(i);
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  Vector3 mean = Vector3::Zero();
  double spokes = 0;
  const auto across = [&](Link link) -> Vector3 {
    const Vector3 d = places[link.node()] - places[i];
    return d - d.dot(normal) * normal;
  };
  for (const Link link : links) {
    if (!link.spoke()) continue;
    mean += across(link);
    spokes += 1;
  }
  mean /= std::max(spokes, 1.0);
  for (const Link link : links) {
    if (link.spoke()) spread += (across(link) - mean) * (across(link) - mean).transpose();
  }
  spread += spread.trace() * normal * normal.transpose();
  // If all neighbours lie on a line or at a point, directions are undetermined: the smallest solution is zero there.
  const Vector3 a = smallest_solution(spread, mean);
  for (std::size_t k = 0; k < links.size(); ++k)
    shares[k] = links[k].spoke() ? 1 / spokes - (across(links[k]) - mean).dot(a) : 0;
}

void share_by_length(const Net& net, std::size_t i, std::span<const Vector3> places, std::span<double> shares) {
  const auto links = net.rings.links(i);
  double whole = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    const Vector3 d = places[links[k].node()] - places[i];
    shares[k] = std::sqrt(d.dot(d) + net.tiny);
    whole += shares[k];
  }
  for (std::size_t k = 0; k < links.size(); ++k) shares[k] = links.size() > 1 ? 1 - shares[k] / whole : 1;
}

std::vector<double> laplacian_weights_at(const Net& net, std::span<const Vector3> places, ThreadTeam& team,
                                         bool coarse) {
  const double least = coarse ? least_share_of_coarse : least_share;
  std::vector<double> result(net.rings.link_count(), 0);
  if (net.is_curve) {
    for (std::size_t i = 0; i < net.moving; ++i)
      share_by_length(net, i, places, std::span(result).subspan(net.rings.begin(i)));
    return result;
  }
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector3> ways;
    std::vector<double> shares;
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      if (links.empty()) continue;
      const auto of_node = std::span(result).subspan(net.rings.begin(i), links.size());
      const Vector3 normal = LinkNormal()(places[i], links, places);
      if (on_boundary(links)) {
        even_shares(net, i, normal, places, of_node);
        continue;
      }
      ways.clear();
      for (const Link link : links) {
        if (!link.spoke()) continue;
        const Vector3 d = places[link.node()] - places[i];
        ways.push_back(d - d.dot(normal) * normal);
      }
      find_shares(ways, normal, net.tiny, least, shares);
      std::size_t next = 0;
      for (std::size_t k = 0; k < links.size(); ++k) {
        if (links[k].spoke()) of_node[k] = shares[next++];
      }
    }
  });
  return result;
}

}  // namespace vspring
