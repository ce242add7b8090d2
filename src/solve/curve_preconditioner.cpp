#include "solve/curve_preconditioner.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "spring/curve_force.hpp"

namespace vspring {

namespace {

// Of the weights 1/ℓ³: where lengths have changed by some 10 %, corrections are off by a third.
constexpr double greatest_change = 1.3;

}  // namespace

bool CurvePreconditioner::refresh() {
  weigh();
  bool fits = !built_weight_.empty();
  for (std::size_t i = 0; i < weight_.size() && fits; ++i) {
    const double change = weight_[i] / built_weight_[i];
    fits = change < greatest_change && change * greatest_change > 1;
  }
  if (fits) return false;
  built_weight_ = weight_;
  runs_.clear();
  for (const Strand& strand : curve_->strands) build_bending(strand);
  build_spreading();
  return true;
}

void CurvePreconditioner::weigh() {
  const Net& net = curve_->net;
  weight_.resize(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) {
    weight_[i] = 0;
    for (const Link link : net.rings.links(i)) {
      const Vector3 d = net.positions[link.node()] - net.positions[i];
      const double inverse2 = 1 / (d.dot(d) + net.tiny);
      weight_[i] += 2 * inverse2 * std::sqrt(inverse2);
    }
  }
}

void CurvePreconditioner::build_bending(const Strand& strand) {
  const Net& net = curve_->net;
  const auto& nodes = strand.nodes;
  const std::size_t count = nodes.size();
  const auto moves = [&](std::size_t place) { return nodes[place] < net.moving; };
  std::size_t begin = net.moving;
  std::size_t size = 0;
  for (std::size_t k = 0; k < count; ++k) {
    if (!moves(k)) continue;
    begin = std::min<std::size_t>(begin, nodes[k]);
    ++size;
  }
  if (size == 0) return;
  BendingMatrix bending(size);

  const auto edge = [&](std::size_t a, std::size_t b) {
    const Vector3 d = net.positions[nodes[b]] - net.positions[nodes[a]];
    return std::sqrt(d.dot(d) + net.tiny);
  };
  /// A row of entries at successive places of the strand; held nodes drop out, and moving ones follow each other.
  const auto add = [&](std::span<const std::pair<std::size_t, double>> entries) {
    std::array<double, BendingMatrix::width> row{};
    std::size_t used = 0;
    std::size_t first = 0;
    for (const auto& [place, entry] : entries) {
      if (!moves(place)) continue;
      if (used == 0) first = nodes[place] - begin;
      row[used++] = entry;
    }
    if (used > 0) bending.add_row(first, row);
  };
  double closing_first = 0;
  double closing_last = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = nodes[k];
    const bool has_before = k > 0 || strand.closed;
    const bool has_after = k + 1 < count || strand.closed;
    const std::size_t before = (k + count - 1) % count;
    const std::size_t after = (k + 1) % count;
    const double length_before = has_before ? edge(before, k) : 0;
    const double length_after = has_after ? edge(k, after) : 0;
    if (net.given[i] != 0) {
      if (has_before) {
        const double entry = 1 / (length_before * std::sqrt(length_before));
        // The first place of a closed strand comes after its last.
        if (k == 0) {
          if (moves(before)) closing_last = entry;
        } else {
          add(std::array{std::pair(before, entry), std::pair(k, -entry)});
        }
      }
      if (has_after) {
        const double entry = 1 / (length_after * std::sqrt(length_after));
        add(std::array{std::pair(k, -entry), std::pair(after, entry)});
      }
    } else if (has_before && has_after) {
      const double scale = 1 / std::sqrt(length_before + length_after);
      const double entry_before = scale / length_before;
      const double entry_after = scale / length_after;
      if (k == 0) {
        if (moves(after)) closing_first = entry_after;
        if (moves(before)) closing_last = entry_before;
      } else if (after == 0) {
        add(std::array{std::pair(before, entry_before), std::pair(k, -entry_before - entry_after)});
      } else {
        add(std::array{std::pair(before, entry_before), std::pair(k, -entry_before - entry_after),
                       std::pair(after, entry_after)});
      }
    }
  }
  if (closing_first != 0 || closing_last != 0) bending.add_closing_row(closing_first, closing_last);
  runs_.push_back({begin, std::move(bending)});
}

void CurvePreconditioner::build_spreading() {
  const Net& net = curve_->net;
  below_.assign(net.moving, 0);
  above_.assign(net.moving, 0);
  pivot_.assign(net.moving, 1);
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    const auto shares = net.shares_of(i);
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::size_t j = links[k].node();
      const double share = shares.empty() ? 1 / static_cast<double>(links.size()) : shares[k];
      if (j + 1 == i) below_[i] = share;
      if (j == i + 1 && j < net.moving) above_[i] = share;
    }
    if (i > 0 && below_[i] != 0) pivot_[i] = 1 - below_[i] * above_[i - 1] * pivot_[i - 1];
    pivot_[i] = 1 / pivot_[i];
  }
}

void CurvePreconditioner::carry_frames() {
  const Net& net = curve_->net;
  axis_.assign(net.positions.size(), Vector3::Zero());
  for (const Strand& strand : curve_->strands) {
    Vector3 axis = Vector3::Zero();
    std::size_t before = 0;
    for (const std::uint32_t i : strand.nodes) {
      const Vector3& tangent = net.tangents[i];
      if (tangent.isZero(0)) continue;
      if (!axis.isZero(0)) {
        const Vector3 d = net.positions[i] - net.positions[before];
        if (d.dot(d) > net.tiny) axis = carried(axis, d, net.tangents[before], tangent);
        axis -= axis.dot(tangent) * tangent;
      }
      const double length = axis.norm();
      axis = length > 0.5 ? Vector3(axis / length) : tangent.unitOrthogonal();
      axis_[i] = axis;
      before = i;
    }
  }
}

void CurvePreconditioner::correct(const Model& model, double /*enough*/, std::vector<Vector3>& correction) {
  const Net& net = curve_->net;
  forces_.resize(net.moving);
  model.find_forces(net, {0, net.moving}, forces_);
  carry_frames();
  across_.resize(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Vector3 force = weight_[i] * forces_[i].spring;
    across_[i] = {force.dot(axis_[i]), force.dot(net.tangents[i].cross(axis_[i]))};
  }
  for (const Run& run : runs_) run.bending.solve(std::span(across_).subspan(run.begin, run.bending.size()));
  correction.resize(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i)
    correction[i] = across_[i][0] * axis_[i] + across_[i][1] * net.tangents[i].cross(axis_[i]);

  std::vector<double> along(net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) {
    Vector3 asked = forces_[i].regularisation - correction[i];
    const auto links = net.rings.links(i);
    const auto shares = net.shares_of(i);
    for (std::size_t k = 0; k < links.size(); ++k) {
      const double share = shares.empty() ? 1 / static_cast<double>(links.size()) : shares[k];
      if (links[k].node() < net.moving) asked += share * correction[links[k].node()];
    }
    along[i] = asked.dot(net.tangents[i]);
    if (below_[i] != 0) along[i] += below_[i] * along[i - 1];
    along[i] *= pivot_[i];
  }
  for (std::size_t i = net.moving; i-- > 0;) {
    if (above_[i] != 0) along[i] += pivot_[i] * above_[i] * along[i + 1];
  }
  for (std::size_t i = 0; i < net.moving; ++i) {
    // A node without a tangent is not sprung, and goes where the regularisation sends it.
    correction[i] += net.tangents[i].isZero(0) ? forces_[i].regularisation : Vector3(along[i] * net.tangents[i]);
  }
}

}  // namespace vspring
