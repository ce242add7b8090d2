#include "points/point_ties.hpp"

#include <algorithm>
#include <atomic>
#include <limits>
#include <numeric>
#include <utility>

#include "base/cancellation.hpp"
#include "points/nearest_nodes.hpp"
#include "points/point_clusters.hpp"

namespace vspring {

namespace {

// Around a hub of many faces all nodes are neighbours of second order: a search through it would cost the square of
// their number. Points can still cross by being tied to the hub itself.
constexpr std::size_t most_passed_on = 100;
// Least relative change of a factor.
constexpr double notable_change = 1e-3;
constexpr std::uint32_t none = UINT32_MAX;

/// Turns counts of groups into the begin of each group, and the end.
template <typename Count>
void add_up(std::vector<Count>& counts) {
  std::exclusive_scan(counts.begin(), counts.end(), counts.begin(), Count{0});
}

/// The first local node of every node of the shape.
std::vector<std::uint32_t> local_numbers(const Net& net) {
  std::vector<std::uint32_t> local(
      net.node.empty() ? 0 : static_cast<std::size_t>(*std::max_element(net.node.begin(), net.node.end())) + 1, none);
  for (std::size_t i = net.node.size(); i-- > 0;)
    local[static_cast<std::size_t>(net.node[i])] = static_cast<std::uint32_t>(i);
  return local;
}

}  // namespace

PointTies::PointTies(Net& net, std::span<const Vector3> points, std::span<const double> weights,
                     std::span<const Index> nearest, PointFactors factors, std::span<const Vector3> normals)
    : net_(&net), factors_(std::move(factors)) {
  find_same_nodes();
  join_neighbours();
  const std::vector<std::uint32_t> local = local_numbers(net);

  const auto tied_to = [&](std::size_t j) {
    const auto node = static_cast<std::size_t>(nearest[j]);
    return nearest[j] < 0 || node >= local.size() || !(weights[j] > 0) ? none : local[node];
  };
  // Points of one node, and of nodes close in memory, lie together.
  std::vector<std::uint32_t> place(net.node.size() + 1, 0);
  for (std::size_t j = 0; j < points.size(); ++j) {
    end_if_cancelled_at(j);
    if (tied_to(j) != none) ++place[tied_to(j)];
  }
  add_up(place);
  TiedPoints& tied = net.points;
  tied.positions.resize(place.back());
  tied.weights.resize(place.back());
  tied.numbers.resize(place.back());
  tied.normals.resize(normals.empty() ? 0 : place.back());
  node_.resize(place.back());
  for (std::size_t j = 0; j < points.size(); ++j) {
    end_if_cancelled_at(j);
    const std::uint32_t node = tied_to(j);
    if (node == none) continue;
    const std::uint32_t k = place[node]++;
    tied.positions[k] = net.frame.to_local(points[j]);
    tied.weights[k] = weights[j];
    tied.numbers[k] = static_cast<std::uint32_t>(j);
    if (!normals.empty()) tied.normals[k] = normals[j];
    node_[k] = node;
  }
  look_for_turned();
  group();
  (void)renew_factors();
}

PointTies::PointTies(Net& net, TiedPoints points, PointFactors factors, ThreadTeam& team)
    : net_(&net), factors_(std::move(factors)) {
  find_same_nodes();
  join_neighbours();
  net.points = std::move(points);
  tie_anew(team);
}

void PointTies::find_same_nodes() {
  const std::vector<std::uint32_t> local = local_numbers(*net_);
  same_.resize(net_->node.size());
  for (std::size_t i = 0; i < same_.size(); ++i) same_[i] = local[static_cast<std::size_t>(net_->node[i])];
}

void PointTies::tie_anew(ThreadTeam& team) {
  if (!net_->points.are_nodes) tie_to_nearest(team);
  look_for_turned();
  group();
  net_->points.factors.clear();
  (void)renew_factors();
}

void PointTies::tie_to_nearest(ThreadTeam& team) {
  std::vector<std::uint8_t> first(same_.size());
  for (std::size_t i = 0; i < same_.size(); ++i) first[i] = same_[i] == i ? 1 : 0;
  const TiedPoints& tied = net_->points;
  Preference alike;
  if (!tied.normals.empty())
    alike = {[&](std::size_t k, std::size_t node) { return may_pull(k, node, 0); }, reach_in_edges * mean_edge(*net_)};
  const std::vector<Index> nearest = nearest_places(tied.positions, net_->positions, first, team, alike);
  // If the shape has diverged, nodes have no finite place, and ties stay as they are.
  node_.resize(nearest.size(), 0);
  for (std::size_t k = 0; k < nearest.size(); ++k) {
    if (nearest[k] >= 0) node_[k] = static_cast<std::uint32_t>(nearest[k]);
  }
}

Vector3 PointTies::side(std::size_t node) const {
  if (node >= net_->moving && net_->normal_given(node)) return Vector3::Zero();
  return net_->normals[node];
}

bool PointTies::may_pull(std::size_t k, std::size_t node, double margin) const {
  return net_->points.normals.empty() || face_alike(net_->points.normals[k], side(node), margin);
}

void PointTies::look_for_turned() {
  turned_.assign(net_->points.normals.size(), 0);
  for (std::size_t k = 0; k < turned_.size(); ++k) turned_[k] = may_pull(k, node_[k], 0) ? 0 : 1;
}

void PointTies::join_neighbours() {
  const std::size_t nodes = net_->node.size();
  const auto for_each_link = [&](const auto& use) {
    for (std::size_t i = 0; i < net_->computed; ++i) {
      end_if_cancelled_at(i);
      for (const Link link : net_->rings.links(i)) {
        use(same_[i], same_[link.node()]);
        use(same_[link.node()], same_[i]);
      }
    }
  };
  std::vector<std::size_t> end(nodes + 1, 0);
  for_each_link([&](std::uint32_t from, std::uint32_t /*to*/) { ++end[from]; });
  add_up(end);
  std::vector<std::uint32_t> all(end.back());
  for_each_link([&](std::uint32_t from, std::uint32_t to) { all[end[from]++] = to; });
  // Inner edges come twice, once from each node.
  neighbours_.reserve(all.size() / 2);
  first_neighbour_.reserve(nodes + 1);
  auto begin = all.begin();
  for (std::size_t i = 0; i < nodes; ++i) {
    end_if_cancelled_at(i);
    first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
    const auto next = all.begin() + static_cast<std::ptrdiff_t>(end[i]);
    std::sort(begin, next);
    neighbours_.insert(neighbours_.end(), begin, std::unique(begin, next));
    begin = next;
  }
  first_neighbour_.push_back(static_cast<std::uint32_t>(neighbours_.size()));
}

void PointTies::gather_around(std::size_t node, std::vector<std::uint32_t>& around) const {
  around.assign(1, static_cast<std::uint32_t>(node));
  for (const std::uint32_t j : neighbours(node)) {
    around.push_back(j);
    const auto next = neighbours(j);
    if (next.size() > most_passed_on) continue;
    around.insert(around.end(), next.begin(), next.end());
  }
  std::sort(around.begin(), around.end());
  around.erase(std::unique(around.begin(), around.end()), around.end());
}

bool PointTies::renew(ThreadTeam& team, double margin) {
  const bool changed = !net_->points.are_nodes && reassign(team, margin);
  return renew_factors() || changed;
}

bool PointTies::reassign(ThreadTeam& team, double margin) {
  constexpr std::size_t searches_per_task = 256;
  std::atomic<bool> changed = false;
  const TiedPoints& tied = net_->points;
  parallel_ranges(team, net_->node.size(), searches_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<std::uint32_t> around;
    for (std::size_t i = begin; i < end; ++i) {
      const auto points = tied.all_of(i);
      if (points.empty()) continue;
      gather_around(i, around);
      for (const std::uint32_t k : points) {
        const bool pulled = turned_.empty() || turned_[k] == 0;
        const bool stays = may_pull(k, i, pulled ? -margin : margin);
        const double own =
            stays ? (net_->positions[i] - tied.positions[k]).squaredNorm() : std::numeric_limits<double>::infinity();
        double least = own;
        for (const std::uint32_t j : around) {
          const double square = (net_->positions[j] - tied.positions[k]).squaredNorm();
          if (!(square < least) || !may_pull(k, j, margin)) continue;
          if (!(own - square > 2 * margin * (net_->positions[j] - net_->positions[i]).squaredNorm())) continue;
          least = square;
          node_[k] = j;
        }
        const bool pulls = stays || node_[k] != i;
        if (!turned_.empty()) turned_[k] = pulls ? 0 : 1;
        if (node_[k] != i || pulls != pulled) changed.store(true, std::memory_order_relaxed);
      }
    }
  });
  if (changed) group();
  return changed;
}

bool PointTies::renew_factors() {
  if (!factors_) return false;
  std::vector<double> before = std::move(net_->points.factors);
  try {
    factors_(*net_);
  } catch (const Cancelled&) {
    net_->points.factors = std::move(before);
    throw;
  }
  const std::vector<double>& now = net_->points.factors;
  const auto alike = [](double a, double b) { return std::abs(a - b) <= notable_change * std::min(a, b); };
  if (!std::equal(before.begin(), before.end(), now.begin(), now.end(), alike)) return true;
  net_->points.factors = std::move(before);
  return false;
}

void PointTies::group() {
  TiedPoints& tied = net_->points;
  tied.order.resize(node_.size());
  tied.begin.assign(net_->node.size() + 1, 0);
  for (const std::uint32_t node : node_) ++tied.begin[node];
  add_up(tied.begin);
  const auto put = [&](bool turned) {
    for (std::size_t k = 0; k < node_.size(); ++k) {
      if ((!turned_.empty() && turned_[k] != 0) == turned)
        tied.order[tied.begin[node_[k]]++] = static_cast<std::uint32_t>(k);
    }
  };
  put(false);
  if (!turned_.empty()) {
    tied.end.assign(tied.begin.begin(), tied.begin.end() - 1);
    put(true);
  }
  // Each begin has advanced to the next one's.
  std::rotate(tied.begin.begin(), tied.begin.end() - 1, tied.begin.end());
  tied.begin.front() = 0;
}

}  // namespace vspring
