#include "solve/bending_form.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace vspring {

namespace {

using Triplet = Eigen::Triplet<double>;

constexpr std::size_t nodes_per_task = 2048;
// Of the diagonal: keeps a net that nothing holds from having no factor.
constexpr double shift = 1e-13;
// Of the sum of a node's weights, what has to be left of it where they are made to take linear functions to zero.
constexpr double least_left = 0.3;

double edge_weight(const Net& net, std::size_t i, std::size_t j) {
  const Vector3 d = net.positions[j] - net.positions[i];
  return 1 / std::sqrt(d.dot(d) + net.tiny);
}

/// The Laplacian of the moving nodes' graph; held neighbours count on its diagonal only.
template <typename Weight>
Eigen::SparseMatrix<double> laplacian(const Net& net, const Weight& weight) {
  const auto size = static_cast<Eigen::Index>(net.moving);
  Eigen::SparseMatrix<double> matrix(size, size);
  std::vector<std::pair<std::size_t, double>> entries;
  matrix.reserve(Eigen::VectorXi::Constant(size, 8));
  for (std::size_t i = 0; i < net.moving; ++i) {
    entries.clear();
    double sum = 0;
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke()) continue;
      const double w = weight(i, link.node());
      sum += w;
      if (link.node() < net.moving) entries.emplace_back(link.node(), -w);
    }
    entries.emplace_back(i, sum * (1 + shift));
    std::sort(entries.begin(), entries.end());
    for (const auto& [j, value] : entries)
      matrix.insert(static_cast<Eigen::Index>(j), static_cast<Eigen::Index>(i)) = value;
  }
  matrix.makeCompressed();
  return matrix;
}

/// The row of curvature of a node with a normal, over the links that are wanted: what (node, share) are, times the sum
/// of the weights. Returns that sum.
template <typename Wanted>
double curvature_row(const Net& net, std::size_t i, const Wanted& wanted,
                     std::vector<std::pair<std::size_t, double>>& row) {
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
    row.emplace_back(j, w);
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

/// Terms of C.
class Extra {
 public:
  explicit Extra(const Net& net) : net_(&net) {}

  /// (Σ w_j (h_j − h_i))² / Σ w_j over the edges to some neighbours.
  template <typename Wanted>
  void add_bend(std::size_t i, const Wanted& wanted) {
    const double sum = curvature_row(*net_, i, wanted, row_);
    if (sum == 0) return;
    std::erase_if(row_, [&](const auto& entry) { return entry.first >= net_->moving; });
    if (i < net_->moving) row_.emplace_back(i, -sum);
    for (const auto& [a, value_a] : row_) {
      for (const auto& [b, value_b] : row_) add(a, b, value_a * value_b / sum);
    }
  }

  /// w (h_j − h_i)².
  void add_edge(std::size_t i, std::size_t j) {
    const double w = edge_weight(*net_, i, j);
    if (i < net_->moving) add(i, i, w);
    if (j < net_->moving) add(j, j, w);
    if (i >= net_->moving || j >= net_->moving) return;
    add(i, j, -w);
    add(j, i, -w);
  }

  [[nodiscard]] Eigen::SparseMatrix<double> take() const {
    const auto size = static_cast<Eigen::Index>(net_->moving);
    Eigen::SparseMatrix<double> matrix(size, size);
    matrix.setFromTriplets(triplets_.begin(), triplets_.end());
    return matrix;
  }

 private:
  void add(std::size_t a, std::size_t b, double value) {
    triplets_.emplace_back(static_cast<int>(a), static_cast<int>(b), value);
  }
  const Net* net_;
  std::vector<Triplet> triplets_;
  std::vector<std::pair<std::size_t, double>> row_;
};

bool on_boundary(std::span<const Link> links) { return !links.empty() && links.front().start(); }

}  // namespace

Eigen::SparseMatrix<double> BendingForm::assembled() const {
  const Eigen::SparseMatrix<double> half = curvature * stiffness.cwiseSqrt().asDiagonal();
  return Eigen::SparseMatrix<double>(half * half.transpose()) + extra;
}

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

BendingForm bending_form(const Net& net) {
  BendingForm form;
  const auto size = static_cast<Eigen::Index>(net.moving);
  form.curvature.resize(size, size);
  form.curvature.reserve(Eigen::VectorXi::Constant(size, 9));
  form.stiffness.resize(size);
  std::vector<std::pair<std::size_t, double>> row;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto column = static_cast<Eigen::Index>(i);
    const double sum = curvature_row(
        net, i, [](std::size_t) { return true; }, row);
    form.stiffness[column] = sum;
    std::erase_if(row, [&](const auto& entry) { return entry.first >= net.moving; });
    row.emplace_back(i, -sum);
    std::sort(row.begin(), row.end());
    for (const auto& [j, value] : row) form.curvature.insert(static_cast<Eigen::Index>(j), column) = value / sum;
  }
  form.curvature.makeCompressed();
  Extra extra(net);
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    const bool moves = i < net.moving;
    const bool open = on_boundary(links);
    if (moves && (net.normal_given(i) || open)) form.stiffness[static_cast<Eigen::Index>(i)] = 0;
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
  form.extra = extra.take();
  return form;
}

Eigen::SparseMatrix<double> spreading_form(const Net& net) {
  if (net.shares.empty()) return laplacian(net, [](std::size_t, std::size_t) { return 1.0; });
  return laplacian(net, [&](std::size_t i, std::size_t j) {
    const auto one_way = [&](std::size_t from, std::size_t to) {
      const auto links = net.rings.links(from);
      double spokes = 0;
      double share = 0;
      for (std::size_t k = 0; k < links.size(); ++k) {
        if (!links[k].spoke()) continue;
        spokes += 1;
        if (links[k].node() == to) share = net.shares_of(from)[k];
      }
      return spokes * share;
    };
    return j < net.moving ? 0.5 * (one_way(i, j) + one_way(j, i)) : one_way(i, j);
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
