#include "precondition/preconditioner.hpp"

#include <algorithm>
#include <cmath>

namespace vspring {

namespace {

// As a share of all stiffness.
constexpr double greatest_share = 0.1;
// A single node matters if its points count about as much as its springs.
constexpr double greatest_change_of_node = 0.3;
constexpr double notable = 0.1;

bool differs(std::span<const double> a, std::span<const double> b) {
  double sum = 0;
  double differences = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::abs(a[i] - b[i]) > greatest_change_of_node * (std::min(a[i], b[i]) + notable)) return true;
    // Stiffness beyond that of the springs makes no difference.
    sum += std::min(a[i], 1.0);
    differences += std::abs(std::min(a[i], 1.0) - std::min(b[i], 1.0));
  }
  return differences > greatest_share * sum;
}

}  // namespace

bool PointStiffness::renew(const Net& net, const Model& model, ThreadTeam& team) {
  if (net.points.empty()) {
    const bool had_points = !values_.empty();
    values_.clear();
    return had_points;
  }
  now_.resize(net.moving);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<NodeForce> forces(end - begin);
    model.find_forces(net, {begin, end}, forces);
    for (std::size_t i = begin; i < end; ++i) now_[i] = forces[i - begin].stiffness;
  });
  if (values_.size() == now_.size() && !differs(values_, now_)) return false;
  values_.swap(now_);
  return true;
}

}  // namespace vspring
