#include "solve/bending_form.hpp"

#include <algorithm>
#include <cmath>

namespace vspring {

namespace {

using Triplet = Eigen::Triplet<double>;

constexpr std::size_t nodes_per_task = 2048;
// Of the diagonal: keeps a net that nothing holds from having no factor.
constexpr double shift = 1e-13;

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

/// Terms of C.
class Extra {
 public:
  explicit Extra(const Net& net) : net_(&net) {}

  /// (Σ w_j (h_j − h_i))² / Σ w_j over the edges to some neighbours.
  template <typename Wanted>
  void add_bend(std::size_t i, const Wanted& wanted) {
    row_.clear();
    double sum = 0;
    const auto links = net_->rings.links(i);
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (!links[k].spoke() || !wanted(k)) continue;
      const double w = edge_weight(*net_, i, links[k].node());
      sum += w;
      if (links[k].node() < net_->moving) row_.emplace_back(links[k].node(), w);
    }
    if (sum == 0) return;
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
  const Eigen::SparseMatrix<double> half = compliance.cwiseSqrt().asDiagonal() * laplacian;
  return Eigen::SparseMatrix<double>(half.transpose() * half) + extra;
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
  form.laplacian = laplacian(net, [&](std::size_t i, std::size_t j) { return edge_weight(net, i, j); });
  form.compliance = form.laplacian.diagonal().cwiseMax(1e-300).cwiseInverse();
  Extra extra(net);
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    const bool moves = i < net.moving;
    const bool open = on_boundary(links);
    if (moves && (net.normal_given(i) || open)) form.compliance[static_cast<Eigen::Index>(i)] = 0;
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
  return laplacian(net, [](std::size_t, std::size_t) { return 1.0; });
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
