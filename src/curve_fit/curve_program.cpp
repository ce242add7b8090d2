#include "curve_fit/curve_program.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace vspring {

namespace {

// For spacing by the inverse root of curvature: the number of nodes, and the steepest growth of spacing per length.
constexpr double nodes_of_spacing = 120;
constexpr double steepest_spacing = 0.25;
constexpr double power_of_spacing = 3;
constexpr double least_share_of_mean_curvature = 0.5;
// Least part of a direction across the moving coordinates: below it nodes would only move along the curve.
constexpr double least_across = 0.03;

}  // namespace

template <int K>
CurveProgram<K>::CurveProgram(const DenseCurve& curve, const Vector3& plane, bool ahead)
    : curve_(curve), plane_(plane) {
  number();
  bases_.resize(curve.size());
  program_.windows.resize(curve.size());
  for (std::uint32_t i = 0; i < curve.size(); ++i) {
    auto& window = program_.windows[i];
    window.fill(BallProgram<K>::none);
    if (curve.is_edge(i)) {
      const std::array<std::uint32_t, 4> nodes = {curve.before(i), i, curve.next(i), curve.next(curve.next(i))};
      for (std::size_t k = 0; k < 4; ++k) {
        if (nodes[k] != DenseCurve::none) window[k] = block_[nodes[k]];
      }
    } else if (curve.before(i) != DenseCurve::none) {
      window = {block_[curve.before(i)], block_[i], BallProgram<K>::none, BallProgram<K>::none};
    }
    const bool after = curve.node(i).corner ? ahead : curve.is_edge(i);
    if (block_[i] >= 0) bases_[i] = ways_of(curve.bend(i, after).tangent);
  }
}

/// Numbers a closed chain alternately from both ends, so that neighbours across its seam are near, too.
template <int K>
void CurveProgram<K>::number() {
  block_.assign(curve_.size(), BallProgram<K>::none);
  std::int32_t next = 0;
  const auto add = [&](std::uint32_t i) {
    if (!curve_.node(i).held) block_[i] = next++;
  };
  for (const auto& chain : curve_.chains()) {
    for (std::uint32_t k = 0; k < chain.count; ++k) {
      if (!chain.closed)
        add(chain.begin + k);
      else if (k % 2 == 0)
        add(chain.begin + k / 2);
      else
        add(chain.begin + chain.count - 1 - k / 2);
    }
  }
  program_.blocks = static_cast<std::size_t>(next);
}

template <int K>
typename CurveProgram<K>::Basis CurveProgram<K>::across(const Vector3& direction) const {
  Basis basis;
  if constexpr (K == 1) {
    basis.col(0) = plane_.cross(direction).normalized();
  } else {
    basis.col(0) = direction.unitOrthogonal();
    basis.col(1) = direction.cross(basis.col(0)).normalized();
  }
  return basis;
}

template <int K>
typename CurveProgram<K>::Basis CurveProgram<K>::axes() const {
  Basis basis = Basis::Zero();
  int k = 0;
  for (int axis = 0; axis < 3 && k < K; ++axis) {
    if (curve_.moving()[axis] != 0) basis(axis, k++) = 1;
  }
  return basis;
}

/// The directions in which a node may move: zero if it may not.
template <int K>
typename CurveProgram<K>::Basis CurveProgram<K>::ways_of(const Vector3& direction) const {
  if (curve_.moves_freely()) return across(direction);
  Basis basis = axes();
  if (curve_.station(direction).norm() >= least_across) return basis;
  const Eigen::Matrix<double, K, 1> along = (basis.transpose() * direction).normalized();
  return basis - basis * along * along.transpose();
}

template <int K>
void CurveProgram<K>::add_entry(Row& row, std::uint32_t node, const Eigen::Matrix<double, K, 3>& slope) const {
  const std::int32_t block = block_[node];
  if (block < 0) return;
  const auto& window = program_.windows[row.window];
  for (int k = 0; k < 4; ++k) {
    if (window[static_cast<std::size_t>(k)] != block) continue;
    row.entries.template block<K, K>(0, k * K) += slope * bases_[node];
    return;
  }
}

template <int K>
void CurveProgram<K>::add_variation(std::span<const double> weights) {
  for (std::uint32_t b = 0; b < curve_.size(); ++b) {
    if (!curve_.is_edge(b)) continue;
    const std::uint32_t c = curve_.next(b);
    const auto first = curve_.curvature_row(b, true);
    const auto second = curve_.curvature_row(c, false);
    if (first.count == 0 || second.count == 0) continue;
    const Vector3 edge = curve_.place(c) - curve_.place(b);
    const double length = edge.norm();
    const Vector3 along = edge / length;
    const Eigen::Matrix<double, K, 3> sideways = across(along).transpose();
    const Vector3 change = second.curvature - first.curvature;
    Row row;
    row.window = b;
    row.weight = weights[b];
    row.offset = sideways * change;
    for (int k = 0; k < second.count; ++k) add_entry(row, second.nodes[k], sideways * second.slopes[k]);
    for (int k = 0; k < first.count; ++k) add_entry(row, first.nodes[k], -sideways * first.slopes[k]);
    // The direction across turns with the edge.
    const Eigen::Matrix<double, K, 3> turn = along.dot(change) / length * sideways;
    add_entry(row, c, -turn);
    add_entry(row, b, turn);
    program_.rows.push_back(row);
  }
}

template <int K>
void CurveProgram<K>::add_bending(double weight, bool as_springs) {
  for (std::uint32_t i = 0; i < curve_.size(); ++i) {
    const bool is_smooth = curve_.is_smooth(i);
    for (const bool after : {false, true}) {
      if (is_smooth && !after) continue;
      const auto bent = curve_.curvature_row(i, after);
      if (bent.count == 0) continue;
      const std::uint32_t before = curve_.before(i);
      double share = 0;
      if (after || is_smooth) share += curve_.edge_length(i) / 2;
      if (!after || is_smooth) share += curve_.edge_length(before) / 2;
      const auto bend = curve_.bend(i, after);
      const Eigen::Matrix<double, K, 3> sideways = across(bend.tangent).transpose();
      Row row;
      row.window = after || is_smooth ? i : before;
      row.weight = weight * share;
      row.offset = sideways * bent.curvature;
      if (as_springs && is_smooth) {
        const double ahead = 1 / (share * curve_.edge_length(i));
        const double behind = 1 / (share * curve_.edge_length(before));
        add_entry(row, curve_.next(i), ahead * sideways);
        add_entry(row, before, behind * sideways);
        add_entry(row, i, -(ahead + behind) * sideways);
      } else {
        for (int k = 0; k < bent.count; ++k) add_entry(row, bent.nodes[k], sideways * bent.slopes[k]);
      }
      program_.rows.push_back(row);
    }
  }
}

template <int K>
void CurveProgram<K>::add_greatest_curvature(double most) {
  for (std::uint32_t i = 0; i < curve_.size(); ++i) {
    const bool is_smooth = curve_.is_smooth(i);
    for (const bool after : {false, true}) {
      if (is_smooth && !after) continue;
      const auto bent = curve_.curvature_row(i, after);
      if (bent.count == 0) continue;
      const Eigen::Matrix<double, K, 3> sideways = across(curve_.bend(i, after).tangent).transpose();
      Row row;
      row.window = after ? i : curve_.before(i);
      row.bound = most;
      row.offset = sideways * bent.curvature;
      for (int k = 0; k < bent.count; ++k) add_entry(row, bent.nodes[k], sideways * bent.slopes[k]);
      program_.rows.push_back(row);
    }
  }
}

template <int K>
std::size_t CurveProgram<K>::add_point(const CurvePoint& point, double data_weight) {
  return add_row_of(point, data_weight * point.weight, curve_.moves_freely() ? across(along(point)) : axes());
}

template <int K>
std::size_t CurveProgram<K>::add_bound(const CurvePoint& point) {
  return add_row_of(point, 0, across(along(point)));
}

/// The direction of the curve. A point whose nearest place is a corner may also lie ahead of it.
template <int K>
Vector3 CurveProgram<K>::along(const CurvePoint& point) const {
  const Vector3 offset = curve_.at(point.at) - point.place;
  Vector3 direction = curve_.direction(point.at);
  const bool at_corner = (point.at.share == 0 && curve_.node(point.at.edge).corner) ||
                         (point.at.share == 1 && curve_.node(curve_.next(point.at.edge)).corner);
  if (!at_corner || offset.isZero(0)) return direction;
  const Vector3 aside = offset.cross(direction).cross(offset);
  return K == 1 ? plane_.cross(offset) : aside.isZero(0) ? offset.unitOrthogonal() : aside;
}

template <int K>
std::size_t CurveProgram<K>::add_row_of(const CurvePoint& point, double weight, const Basis& ways) {
  const auto place = curve_.place_row(point.at);
  const Vector3 offset = curve_.at(point.at) - point.place;
  const Eigen::Matrix<double, K, 3> sideways = ways.transpose();
  Row row;
  row.window = point.at.edge;
  row.weight = weight;
  row.bound = point.bound;
  row.price = point.price;
  row.offset = sideways * offset;
  for (std::size_t k = 0; k < 4; ++k) {
    if (place.nodes[k] != DenseCurve::none) add_entry(row, place.nodes[k], place.weights[k] * sideways);
  }
  program_.rows.push_back(row);
  return program_.rows.size() - 1;
}

template class CurveProgram<1>;
template class CurveProgram<2>;

std::vector<double> weights_of_change(const DenseCurve& curve, bool evenly) {
  std::vector<double> weights(curve.size(), 0);
  std::vector<double> spacing(curve.size(), 1);
  for (const auto& chain : curve.chains()) {
    const std::uint32_t end = chain.begin + chain.count;
    double turned = 0;
    double length = 0;
    std::vector<double> curvature(chain.count, 0);
    const auto edge = [&](std::uint32_t i) { return curve.is_edge(i) ? curve.edge_length(i) : 0.0; };
    for (std::uint32_t i = chain.begin; i < end; ++i) {
      const std::uint32_t before = curve.before(i);
      double& bent = curvature[i - chain.begin];
      bent = curve.greatest_curvature(i);
      turned += bent * (edge(i) + (before == DenseCurve::none ? 0 : edge(before))) / 2;
      length += edge(i);
    }
    if (!(length > 0)) continue;
    const double floor = turned > 0 ? least_share_of_mean_curvature * turned / length : 1;
    double nodes = 0;
    for (std::uint32_t i = chain.begin; i < end; ++i) {
      spacing[i] = 1 / std::sqrt(floor + curvature[i - chain.begin]);
      nodes += edge(i) / spacing[i];
    }
    for (std::uint32_t i = chain.begin; i < end; ++i) spacing[i] *= nodes / nodes_of_spacing;
    // Twice around a closed chain, as it begins anywhere.
    for (int around = 0; around < (chain.closed ? 2 : 1); ++around) {
      for (std::uint32_t i = chain.begin; i < end; ++i) {
        if (curve.is_edge(i))
          spacing[curve.next(i)] = std::min(spacing[curve.next(i)], spacing[i] + steepest_spacing * edge(i));
      }
      for (std::uint32_t i = end; i-- > chain.begin;) {
        if (curve.is_edge(i)) spacing[i] = std::min(spacing[i], spacing[curve.next(i)] + steepest_spacing * edge(i));
      }
    }
    for (std::uint32_t i = chain.begin; i < end; ++i) spacing[i] *= nodes_of_spacing / length;
    for (std::uint32_t i = chain.begin; i < end; ++i) {
      if (!curve.is_edge(i)) continue;
      const double mean = (spacing[i] + spacing[curve.next(i)]) / 2;
      weights[i] = (evenly ? 1 : std::pow(mean, power_of_spacing)) / edge(i);
    }
  }
  return weights;
}

}  // namespace vspring
