#include "solve/bending_form.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vspring {

namespace {

constexpr std::size_t nodes_per_task = 2048;
// Of the diagonal: keeps a net that nothing holds from having no factor.
constexpr double shift = 1e-13;
// Shares of nodes that lie unevenly may be negative; the matrix is to stay definite.
constexpr double least_weight = 0.1;
// Of the sum of a node's weights, what has to be left of it where they are made to take linear functions to zero.
constexpr double least_left = 0.3;

double edge_weight(const Net& net, std::size_t i, std::size_t j) {
  const Vector3 d = net.positions[j] - net.positions[i];
  return 1 / std::sqrt(d.dot(d) + net.tiny);
}

/// The row of curvature of a node with a normal, over the links that are wanted: what (node, share) are, times the sum
/// of the weights. Returns that sum.
template <typename Wanted>
double curvature_row(const Net& net, std::size_t i, const Wanted& wanted, SparseRows::Row& row) {
  const auto links = net.rings.links(i);
  const Vector3& normal = net.normals[i];
  row.clear();
  double sum = 0;
  Vector3 mean = Vector3::Zero();
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  const auto across = [&](std::size_t j) -> Vector3 {
    const Vector3 d = net.positions[j] - net.positions[i];
    return d - d.dot(normal) * normal;
  };
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke() || !wanted(k)) continue;
    const std::size_t j = links[k].node();
    const double w = edge_weight(net, i, j);
    const Vector3 u = across(j);
    sum += w;
    mean += w * u;
    spread += w * u * u.transpose();
    row.push_back({static_cast<std::uint32_t>(j), w});
  }
  const double size = spread.trace();
  if (!(size > 0) || row.size() < 3) return sum;
  spread += size * normal * normal.transpose() + 1e-9 * size * Eigen::Matrix3d::Identity();
  Vector3 slope = spread.ldlt().solve(mean);
  // Neighbours all to one side leave next to nothing.
  const double left = 1 - mean.dot(slope) / sum;
  if (left < least_left) slope *= (1 - least_left) / (1 - left);
  double total = 0;
  for (auto& [j, value] : row) {
    value *= 1 - slope.dot(across(j));
    total += value;
  }
  for (auto& [j, value] : row) value *= sum / total;
  return sum;
}

/// Terms of C, each the square of a sum of a few displacements.
class Extra {
 public:
  explicit Extra(const Net& net) : net_(&net) {}

  /// (Σ w_j (h_j − h_i))² / Σ w_j over the edges to some neighbours.
  template <typename Wanted>
  void add_bend(std::size_t i, const Wanted& wanted) {
    const double sum = curvature_row(*net_, i, wanted, row_);
    if (sum == 0) return;
    std::erase_if(row_, [&](const auto& entry) { return entry.column >= net_->moving; });
    if (i < net_->moving) row_.push_back({static_cast<std::uint32_t>(i), -sum});
    for (const auto& a : row_) {
      for (const auto& b : row_) terms_.push_back({a.column, {b.column, a.value * b.value / sum}});
    }
  }

  /// w (h_j − h_i)².
  void add_edge(std::size_t i, std::size_t j) {
    const double w = edge_weight(*net_, i, j);
    const auto a = static_cast<std::uint32_t>(i);
    const auto b = static_cast<std::uint32_t>(j);
    if (i < net_->moving) terms_.push_back({a, {a, w}});
    if (j < net_->moving) terms_.push_back({b, {b, w}});
    if (i >= net_->moving || j >= net_->moving) return;
    terms_.push_back({a, {b, -w}});
    terms_.push_back({b, {a, -w}});
  }

  /// The terms of every row; columns may occur repeatedly.
  [[nodiscard]] std::vector<std::vector<SparseRows::Entry>> by_rows() const {
    std::vector<std::vector<SparseRows::Entry>> rows(terms_.empty() ? 0 : net_->moving);
    for (const Term& term : terms_) rows[term.row].push_back(term.entry);
    return rows;
  }

 private:
  struct Term {
    std::uint32_t row;
    SparseRows::Entry entry;
  };
  const Net* net_;
  std::vector<Term> terms_;
  SparseRows::Row row_;
};

bool on_boundary(std::span<const Link> links) { return !links.empty() && links.front().start(); }

}  // namespace

void weigh_edges(const Net& net, ThreadTeam& team, std::vector<double>& sums) {
  sums.resize(net.moving);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      sums[i] = 0;
      for (const Link link : net.rings.links(i)) {
        if (link.spoke()) sums[i] += edge_weight(net, i, link.node());
      }
    }
  });
}

SparseRows bending_form(const Net& net, ThreadTeam& team) {
  const auto bends_evenly = [&](std::size_t i) { return !net.normal_given(i) && !on_boundary(net.rings.links(i)); };
  // √D L, without the rows that C takes care of.
  const SparseRows curvature = SparseRows::build(team, net.moving, net.moving, [&] {
    return [&, whole = SparseRows::Row()](std::size_t i, SparseRows::Row& row) mutable {
      if (!bends_evenly(i)) return;
      const double sum = curvature_row(
          net, i, [](std::size_t) { return true; }, whole);
      const double scale = sum > 0 ? 1 / std::sqrt(sum) : 0;
      row.push_back({static_cast<std::uint32_t>(i), -sum * scale});
      for (const SparseRows::Entry& entry : whole) {
        if (entry.column < net.moving) row.push_back({entry.column, entry.value * scale});
      }
    };
  });
  Extra extra(net);
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    const bool moves = i < net.moving;
    const bool open = on_boundary(links);
    if (moves && net.normal_given(i)) {
      for (const Link link : links) {
        if (link.spoke()) extra.add_edge(i, link.node());
      }
    } else if (moves && open) {
      extra.add_bend(i, [&](std::size_t k) { return k == 0 || k + 1 == links.size(); });
    } else if (!moves && !open && !net.normal_given(i)) {
      extra.add_bend(i, [](std::size_t) { return true; });
    }
    if (!moves || net.normal_given(i)) continue;
    for (const Link link : links) {
      if (link.spoke() && link.node() >= net.moving && net.normal_given(link.node())) extra.add_edge(i, link.node());
    }
  }
  const auto extra_rows = extra.by_rows();
  const SparseRows squared = product(curvature.transposed(), curvature, team);
  return SparseRows::build(team, net.moving, net.moving, [&] {
    return [&](std::size_t i, SparseRows::Row& row) {
      const std::size_t begin = row.size();
      const auto add = [&](const SparseRows::Entry& entry) {
        for (std::size_t k = begin; k < row.size(); ++k) {
          if (row[k].column != entry.column) continue;
          row[k].value += entry.value;
          return;
        }
        row.push_back(entry);
      };
      const auto square = squared.row(i);
      row.insert(row.end(), square.begin(), square.end());
      if (!extra_rows.empty()) std::for_each(extra_rows[i].begin(), extra_rows[i].end(), add);
    };
  });
}

SparseRows spreading_form(const Net& net, ThreadTeam& team) {
  // Symmetric: of two different shares of an edge, half each.
  const auto one_way = [&](std::size_t from, std::size_t to) {
    const auto links = net.rings.links(from);
    const auto shares = net.shares_of(from);
    if (shares.empty()) return 1.0;
    double spokes = 0;
    double share = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (!links[k].spoke()) continue;
      spokes += 1;
      if (links[k].node() == to) share = shares[k];
    }
    return std::max(spokes * share, least_weight);
  };
  return SparseRows::build(team, net.moving, net.moving, [&] {
    return [&](std::size_t i, SparseRows::Row& row) {
      double sum = 0;
      for (const Link link : net.rings.links(i)) {
        if (!link.spoke()) continue;
        const std::size_t j = link.node();
        const double weight = j < net.moving ? 0.5 * (one_way(i, j) + one_way(j, i)) : one_way(i, j);
        sum += weight;
        if (j < net.moving) row.push_back({static_cast<std::uint32_t>(j), -weight});
      }
      row.push_back({static_cast<std::uint32_t>(i), sum * (1 + shift)});
    };
  });
}

double bending_factor(const Net& net) {
  std::size_t edges = 0;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    edges +=
        static_cast<std::size_t>(std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }));
  }
  return static_cast<double>(edges) > 5 * static_cast<double>(net.moving) ? 0.75 : 1;
}

}  // namespace vspring
