#include "points/point_factors.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <utility>

#include "base/cancellation.hpp"
#include "spring/bending_factor.hpp"

namespace vspring {

namespace {

// Beyond it nodes reach their points anyway.
constexpr double greatest_factor = 1e50;

/// The mean of powers of the lengths of a node's edges.
double mean_power(const Net& net, std::size_t i, double power) {
  double sum = 0;
  double edges = 0;
  for (const Link link : net.rings.links(i)) {
    if (!link.spoke()) continue;
    sum += std::pow((net.positions[link.node()] - net.positions[i]).squaredNorm() + net.tiny, power / 2);
    edges += 1;
  }
  return edges > 0 ? sum / edges : 0;
}

/// factor(node) for every moving node that has points.
template <typename Factor>
void set_factors(Net& net, const Factor& factor) {
  net.points.factors.assign(net.moving, 0);
  if (net.points.empty()) return;
  for (std::size_t i = 0; i < net.moving; ++i) {
    end_if_cancelled_at(i);
    if (net.points.of(i).empty()) continue;
    const double value = factor(i, static_cast<double>(net.points.of(i).size()));
    net.points.factors[i] = value < greatest_factor ? value : greatest_factor;
  }
}

/// A node's area: faces divide theirs evenly among their nodes.
double area_at(const Net& net, std::size_t i) {
  const auto links = net.rings.links(i);
  if (links.empty()) return 0;
  const auto edge = [&](Link link) -> Vector3 { return net.positions[link.node()] - net.positions[i]; };
  double area = 0;
  Vector3 face = Vector3::Zero();
  double nodes = 2;
  Vector3 previous = edge(links.front());
  const auto go_on = [&](const Vector3& next, bool face_ends) {
    face += previous.cross(next) / 2;
    previous = next;
    nodes += 1;
    if (!face_ends) return;
    area += face.norm() / nodes;
    face.setZero();
    nodes = 2;
  };
  for (std::size_t k = 1; k < links.size(); ++k) {
    if (links[k].start()) {
      previous = edge(links[k]);
      face.setZero();
      nodes = 2;
    } else {
      go_on(edge(links[k]), links[k].spoke() || (k + 1 == links.size() ? links.front() : links[k + 1]).start());
    }
  }
  if (!links.front().start()) go_on(edge(links.front()), true);
  return area;
}

/// Half the length of the edges at a node of a curve.
double length_at(const Net& net, std::size_t i) {
  return mean_power(net, i, 1) * static_cast<double>(net.rings.links(i).size()) / 2;
}

}  // namespace

double pull_power(const Net& net) { return !net.is_curve ? 2 : 3; }

PointFactors pull_by_sums() {
  return [](Net& net) {
    const double power = pull_power(net);
    set_factors(net, [&](std::size_t i, double count) { return count * std::pow(mean_power(net, i, 1), power); });
  };
}

PointFactors pull_by_edges(std::shared_ptr<const double> length) {
  return [length = std::move(length)](Net& net) {
    const double factor = bending_factor(net) * std::pow(mean_edge(net) / *length, 4) / 16;
    set_factors(net, [&](std::size_t /*node*/, double count) { return factor * count; });
  };
}

PointFactors pull_by_smoothing(std::shared_ptr<const double> length, std::size_t points) {
  return [length = std::move(length), points](Net& net) {
    const bool surface = !net.is_curve;
    double size = 0;
    double tied = 0;
    for (std::size_t i = 0; i < net.moving; ++i) {
      end_if_cancelled_at(i);
      size += surface ? area_at(net, i) : length_at(net, i);
      tied += net.points.empty() ? 0.0 : static_cast<double>(net.points.of(i).size());
    }
    const double per_point = size / (points > 0 ? static_cast<double>(points) : std::max(tied, 1.0));
    const double scale = per_point / std::pow(*length, 4);
    const double kappa = surface ? bending_factor(net) : 0;
    set_factors(net, [&](std::size_t i, double count) {
      if (surface) {
        const double square = mean_power(net, i, 2);
        return scale * count * kappa * square * square / (16 * std::max(area_at(net, i), net.tiny));
      }
      return scale * count / (4 * mean_power(net, i, -3) * static_cast<double>(net.rings.links(i).size()));
    });
  };
}

}  // namespace vspring
