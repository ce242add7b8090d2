#include "precondition/curve_preconditioner.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "precondition/curve_bending_rows.hpp"
#include "spring/curve_force.hpp"

namespace vspring {

namespace {

// A ratio of weights 1/ℓ³: when lengths have changed by 10 %, corrections are off by a third.
constexpr double greatest_change_of_weights = 1.3;

}  // namespace

bool CurvePreconditioner::free(const MovingRun& moving_run) const {
  return moving_run.closed && moving_run.nodes.front() < net_->moving;
}

bool CurvePreconditioner::refresh(const Model& model) {
  weigh();
  bool fits = !built_weight_.empty();
  for (std::size_t i = 0; i < weight_.size() && fits; ++i) {
    const double change = weight_[i] / built_weight_[i];
    fits = change < greatest_change_of_weights && change * greatest_change_of_weights > 1;
  }
  const bool pulled_otherwise = stiffness_.renew(*net_, model, alone_);
  if (fits && !pulled_otherwise) return false;
  built_weight_ = weight_;
  runs_.clear();
  for (const MovingRun& moving_run : net_->moving_runs) build_bending(moving_run);
  build_spreading();
  return true;
}

void CurvePreconditioner::weigh() {
  const Net& net = *net_;
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

void CurvePreconditioner::build_bending(const MovingRun& moving_run) {
  const Net& net = *net_;
  const auto& nodes = moving_run.nodes;
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
  BandedQr bending(size);

  std::vector<double> pull(size, 0);
  if (!stiffness_.values().empty()) {
    for (std::size_t i = 0; i < size; ++i) pull[i] = weight_[begin + i] * stiffness_.values()[begin + i];
  }
  // Without rows across the seam a free run may be nearly unheld: these rows are removed again.
  std::vector<BandedQr::Entry> crutches;
  if (free(moving_run)) {
    for (const std::size_t column : {std::size_t{0}, size / 2})
      crutches.push_back({column, std::sqrt(weight_[begin + column])});
  }
  for (const auto& [column, entry] : crutches) pull[column] += entry * entry;
  std::size_t pulled = 0;
  const auto add_pulls = [&](std::size_t end) {
    for (; pulled < end; ++pulled) {
      if (pull[pulled] > 0) bending.add_row(pulled, {std::sqrt(pull[pulled]), 0, 0});
    }
  };
  std::vector<std::vector<BandedQr::Entry>> far;
  // Held nodes are left out; moving ones are numbered in succession.
  for_each_bending_row(net, moving_run, [&](const CurveBendingRow& bent) {
    std::vector<BandedQr::Entry> row;
    for (const auto& [place, entry] : bent.entries) {
      if (moves(place)) row.push_back({nodes[place] - begin, entry});
    }
    if (row.empty()) return;
    if (bent.across_seam) {
      far.push_back(std::move(row));
      return;
    }
    std::array<double, BandedQr::width> banded{};
    for (std::size_t n = 0; n < row.size(); ++n) banded[n] = row[n].value;
    add_pulls(row.front().column);
    bending.add_row(row.front().column, banded);
  });
  add_pulls(size);
  for (auto& row : far) bending.add_low_rank_row(std::move(row));
  for (const BandedQr::Entry& crutch : crutches) bending.add_low_rank_row({crutch}, -1);
  runs_.push_back({begin, std::move(bending)});
}

void CurvePreconditioner::build_spreading() {
  const Net& net = *net_;
  below_.assign(net.moving, 0);
  above_.assign(net.moving, 0);
  pivot_.assign(net.moving, 1);
  slides_.assign(net.moving, 1);
  // Target positions draw each node separately.
  if (!net.target_positions.empty()) return;
  for (const MovingRun& moving_run : net_->moving_runs) {
    if (free(moving_run)) slides_[moving_run.nodes.front()] = 0;
  }
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    const auto shares = net.weights_of(i);
    for (std::size_t k = 0; k < links.size(); ++k) {
      const std::size_t j = links[k].node();
      if (slides_[i] == 0 || (j < net.moving && slides_[j] == 0)) continue;
      const double share = shares.empty() ? 1 / static_cast<double>(links.size()) : shares[k];
      if (j + 1 == i) below_[i] = share;
      if (j == i + 1 && j < net.moving) above_[i] = share;
    }
    if (i > 0 && below_[i] != 0) pivot_[i] = 1 - below_[i] * above_[i - 1] * pivot_[i - 1];
    pivot_[i] = 1 / pivot_[i];
  }
}

void CurvePreconditioner::carry_frames() {
  const Net& net = *net_;
  axis_.assign(net.positions.size(), Vector3::Zero());
  for (const MovingRun& moving_run : net_->moving_runs) {
    Vector3 axis = Vector3::Zero();
    std::size_t before = 0;
    for (const std::uint32_t i : moving_run.nodes) {
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
    if (free(moving_run)) close_frames(moving_run);
  }
}

void CurvePreconditioner::close_frames(const MovingRun& moving_run) {
  const Net& net = *net_;
  const std::size_t first = moving_run.nodes.front();
  const std::size_t last = moving_run.nodes.back();
  const Vector3& tangent = net.tangents[first];
  const Vector3 d = net.positions[first] - net.positions[last];
  if (tangent.isZero(0) || net.tangents[last].isZero(0) || !(d.dot(d) > net.tiny)) return;
  const Vector3 around = carried(axis_[last], d, net.tangents[last], tangent);
  const double turn = std::atan2(axis_[first].cross(around).dot(tangent), axis_[first].dot(around));
  const auto count = static_cast<double>(moving_run.nodes.size());
  for (std::size_t k = 0; k < moving_run.nodes.size(); ++k) {
    Vector3& axis = axis_[moving_run.nodes[k]];
    const double angle = -turn * static_cast<double>(k) / count;
    axis = std::cos(angle) * axis + std::sin(angle) * net.tangents[moving_run.nodes[k]].cross(axis);
  }
}

void CurvePreconditioner::correct(const Model& model, double /*enough*/, std::vector<Vector3>& correction) {
  const Net& net = *net_;
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
    const auto shares = net.weights_of(i);
    for (std::size_t k = 0; k < links.size() && net.target_positions.empty(); ++k) {
      const double share = shares.empty() ? 1 / static_cast<double>(links.size()) : shares[k];
      if (links[k].node() < net.moving) asked += share * correction[links[k].node()];
    }
    along[i] = slides_[i] == 0 ? 0 : asked.dot(net.tangents[i]);
    if (below_[i] != 0) along[i] += below_[i] * along[i - 1];
    along[i] *= pivot_[i];
  }
  for (std::size_t i = net.moving; i-- > 0;) {
    if (above_[i] != 0) along[i] += pivot_[i] * above_[i] * along[i + 1];
  }
  for (std::size_t i = 0; i < net.moving; ++i) {
    // A node without a tangent has no spring force, and goes where the regularisation sends it.
    correction[i] += net.tangents[i].isZero(0) ? forces_[i].regularisation : Vector3(along[i] * net.tangents[i]);
  }
}

}  // namespace vspring
