#include "precondition/bending_operator.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>

#include "base/linear_precision.hpp"
#include "linear/sparse_sum.hpp"
#include "spring/link_edges.hpp"
#include "spring/sphere_springs.hpp"

namespace vspring {

namespace {

// Shares of unevenly placed nodes may be negative; this bound keeps the matrix definite.
constexpr double least_weight = 0.1;
// The least share of the sum of a node's weights that is left when they are corrected to take linear functions to zero.
constexpr double least_left = 0.3;

// Least share of a node's area in its row of curvature.
constexpr double least_mass = 0.2;
constexpr double greatest_mass = 8;

// A node with more links has only so many in its row, spread evenly: all pairs of them have an entry in B.
constexpr std::size_t most_links = 64;

bool has_many(std::span<const Link> links) { return links.size() > most_links; }

/// Calls use(k) for the places of a node's links, or of a selection if they are many.
template <typename Use>
void for_some_links(std::span<const Link> links, const Use& use) {
  if (!has_many(links)) {
    for (std::size_t k = 0; k < links.size(); ++k) use(k);
    return;
  }
  for (std::size_t part = 0; part < most_links; ++part) {
    std::size_t k = part * links.size() / most_links;
    const std::size_t end = (part + 1) * links.size() / most_links;
    // Rows of edges only have entries for spokes.
    while (k + 1 < end && !links[k].spoke()) ++k;
    use(k);
  }
}

double edge_weight(const Net& net, std::size_t i, std::size_t j) {
  const Vector3 d = net.positions[j] - net.positions[i];
  return 1 / std::sqrt(d.dot(d) + net.tiny);
}

/// The row of curvature of a node with a normal: (node, share) times the sum of the weights. Returns that sum.
/// for_links(use) calls use(k) for the places of the links that count.
template <typename ForLinks>
double curvature_row_of(const Net& net, std::size_t i, const ForLinks& for_links, SparseRows::Row& row) {
  const auto links = net.rings.links(i);
  const Vector3& normal = net.normals[i];
  row.clear();
  LinearPrecision linear;
  const auto across = [&](std::size_t j) -> Vector3 {
    const Vector3 d = net.positions[j] - net.positions[i];
    return d - d.dot(normal) * normal;
  };
  for_links([&](std::size_t k) {
    if (!links[k].spoke()) return;
    const std::size_t j = links[k].node();
    const double w = edge_weight(net, i, j);
    linear.add(w, across(j));
    row.push_back({static_cast<std::uint32_t>(j), w});
  });
  const double sum = linear.sum();
  if (!(linear.size() > 0) || row.size() < 3) return sum;
  const Vector3 slope = linear.leaving(least_left, linear.slope_across(normal));
  double total = 0;
  for (auto& [j, value] : row) {
    value *= 1 - slope.dot(across(j));
    total += value;
  }
  for (auto& [j, value] : row) value *= sum / total;
  return sum;
}

/// The row of curvature over all links; if they are many, a selection represents them.
double curvature_row(const Net& net, std::size_t i, SparseRows::Row& row) {
  const auto links = net.rings.links(i);
  const double sum = curvature_row_of(
      net, i, [&](const auto& use) { for_some_links(links, use); }, row);
  if (!has_many(links) || !(sum > 0)) return sum;
  double all = 0;
  for (const Link link : links) {
    if (link.spoke()) all += edge_weight(net, i, link.node());
  }
  for (auto& [j, value] : row) value *= all / sum;
  return all;
}

/// The row of a node with sphere springs, over all of its link: its curvature times 2 √(Σ K |e|²).
void sphere_row(const Net& net, std::size_t i, SparseRows::Row& row) {
  const auto links = net.rings.links(i);
  const SphereSprings& spheres = net.spheres;
  row.clear();
  const RowSpread spread = spread_of_row(net, i, LinkEdges(net, i));
  if (!(spread.sum > 0)) return;
  const double* stiffness = spheres.stiffness.data() + net.rings.begin(i);
  double plain = 0;
  double raised = 0;
  for (std::size_t k = 0; k < links.size(); ++k) {
    plain += stiffness[k];
    raised += stiffness[k] + spread.raised;
  }
  // Forces have the plain entries, curvatures the raised ones; the symmetric form takes their geometric mean.
  const double area = std::clamp(raised > 0 ? spread.sum / 4 * plain / raised : 0, least_mass * spheres.areas[i],
                                 greatest_mass * spheres.areas[i]);
  const double scale = 4 * std::sqrt(area) / spread.sum;
  double sum = 0;
  for_some_links(links, [&](std::size_t k) {
    const double value = scale * (stiffness[k] + spread.raised);
    row.push_back({static_cast<std::uint32_t>(links[k].node()), value});
    sum += value;
  });
  if (has_many(links) && sum > 0) {
    for (auto& [j, value] : row) value *= scale * raised / sum;
    sum = scale * raised;
  }
  row.push_back({static_cast<std::uint32_t>(i), -sum});
}

/// Whether a node bends as at a free boundary. With sphere springs one that slides there bends as inside: its normal is
/// given, and with that slope the Laplacian of its faces on one side is its curvature.
bool bends_at_boundary(const Net& net, std::size_t i) {
  return on_boundary(net.rings.links(i)) && !(net.spheres.on() && net.slides(i));
}

bool has_spokes_only(std::span<const Link> links) {
  return std::all_of(links.begin(), links.end(), [](Link link) { return link.spoke(); });
}

}  // namespace

void sum_edge_weights(const Net& net, ThreadTeam& team, std::vector<float>& sums) {
  sums.resize(net.moving);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      double sum = 0;
      if (net.spheres.on() && !bends_at_boundary(net, i)) {
        sum = net.spheres.weights[i];
      } else {
        for (const Link link : net.rings.links(i)) {
          if (link.spoke()) sum += edge_weight(net, i, link.node());
        }
      }
      sums[i] = static_cast<float>(sum);
    }
  });
}

namespace {

/// A row of G, also over held nodes.
struct BendingRow {
  std::size_t centre;  ///< displacements along its normal count
  SparseRows::Row entries;
};

/// The rows of C.
class Extra {
 public:
  explicit Extra(const Net& net) : net_(&net) {}

  /// (Σ w_j (h_j − h_i)) / √(Σ w_j) over the edges of a node.
  void add_bend(std::size_t i) {
    SparseRows::Row row;
    const double sum = curvature_row(*net_, i, row);
    add_bend(i, sum, std::move(row));
  }
  /// (Σ w_j (h_j − h_i)) / √(Σ w_j) over the two boundary edges of a node.
  void add_bend_along_boundary(std::size_t i) {
    SparseRows::Row row;
    const std::size_t count = net_->rings.links(i).size();
    const double sum = curvature_row_of(
        *net_, i,
        [&](const auto& use) {
          use(0);
          if (count > 1) use(count - 1);
        },
        row);
    add_bend(i, sum, std::move(row));
  }

  void add_sphere(std::size_t i) {
    SparseRows::Row row;
    sphere_row(*net_, i, row);
    rows_.push_back({i, std::move(row)});
  }

  /// √w (h_j − h_i).
  void add_edge(std::size_t centre, std::size_t i, std::size_t j) {
    const double root = std::sqrt(edge_weight(*net_, i, j));
    rows_.push_back({centre, {{static_cast<std::uint32_t>(i), -root}, {static_cast<std::uint32_t>(j), root}}});
  }

  /// √pull h_i.
  void add_pull(std::size_t i, double pull) {
    rows_.push_back({i, {{static_cast<std::uint32_t>(i), std::sqrt(pull)}}});
  }

  [[nodiscard]] std::vector<BendingRow> take() && { return std::move(rows_); }

 private:
  void add_bend(std::size_t i, double sum, SparseRows::Row row) {
    if (sum == 0) return;
    row.push_back({static_cast<std::uint32_t>(i), -sum});
    for (auto& entry : row) entry.value /= std::sqrt(sum);
    rows_.push_back({i, std::move(row)});
  }

  const Net* net_;
  std::vector<BendingRow> rows_;
};

std::vector<BendingRow> extra_rows(const Net& net, std::span<const double> pull) {
  Extra extra(net);
  for (std::size_t i = 0; i < net.computed; ++i) {
    const auto links = net.rings.links(i);
    const bool moves = i < net.moving;
    const bool open = bends_at_boundary(net, i);
    if (net.spheres.on() && !(moves && open)) {
      if ((moves || !open || net.normal_given(i)) && !(moves && has_spokes_only(links))) extra.add_sphere(i);
      continue;
    }
    if (moves && net.normal_given(i)) {
      for (const Link link : links) {
        if (link.spoke()) extra.add_edge(i, i, link.node());
      }
    } else if (moves && open) {
      extra.add_bend_along_boundary(i);
    } else if (!moves && !open && !net.normal_given(i)) {
      extra.add_bend(i);
    }
    if (!moves || net.normal_given(i)) continue;
    for (const Link link : links) {
      const std::size_t j = link.node();
      if (link.spoke() && j >= net.moving && net.normal_given(j)) extra.add_edge(j, i, j);
    }
  }
  for (std::size_t i = 0; i < pull.size(); ++i) {
    if (pull[i] > 0) extra.add_pull(i, pull[i]);
  }
  return std::move(extra).take();
}

bool bends_evenly(const Net& net, std::size_t i) {
  const auto links = net.rings.links(i);
  if (net.spheres.on()) return !bends_at_boundary(net, i) && has_spokes_only(links);
  return !net.normal_given(i) && !on_boundary(links);
}

/// The row of G of a moving node: calls with_node(its own entry), and with_spoke(k, entry) for its links to neighbours.
/// room: a buffer for the row.
template <typename WithNode, typename WithSpoke>
void for_bending_row(const Net& net, std::size_t i, SparseRows::Row& room, const WithNode& with_node,
                     const WithSpoke& with_spoke) {
  if (!bends_evenly(net, i)) return;
  if (net.spheres.on()) {
    sphere_row(net, i, room);
    if (room.empty()) return;
    with_node(room.back().value);
    std::size_t next = 0;
    for_some_links(net.rings.links(i), [&](std::size_t k) { with_spoke(k, room[next++].value); });
    return;
  }
  const double sum = curvature_row(net, i, room);
  if (!(sum > 0)) return;
  const double scale = 1 / std::sqrt(sum);
  with_node(-sum * scale);
  const auto links = net.rings.links(i);
  std::size_t next = 0;
  for_some_links(links, [&](std::size_t k) {
    if (links[k].spoke()) with_spoke(k, room[next++].value * scale);
  });
}

}  // namespace

SparseRows bending_operator(const Net& net, ThreadTeam& team, std::span<const double> pull) {
  const std::vector<BendingRow> extra = extra_rows(net, pull);
  const auto rows = SparseRows::build(team, net.moving + extra.size(), net.moving, [&] {
    return [&, room = SparseRows::Row()](std::size_t i, SparseRows::Row& row) mutable {
      const auto add = [&](std::size_t column, double value) {
        if (column < net.moving) row.push_back({static_cast<std::uint32_t>(column), value});
      };
      if (i >= net.moving) {
        for (const SparseRows::Entry& entry : extra[i - net.moving].entries) add(entry.column, entry.value);
        return;
      }
      const auto links = net.rings.links(i);
      for_bending_row(
          net, i, room, [&](double value) { add(i, value); },
          [&](std::size_t k, double value) { add(links[k].node(), value); });
    };
  });
  return product(rows.transposed(), rows, team);
}

FactoredMatrix factored_bending_operator(const Net& net, ThreadTeam& team, std::span<const double> pull) {
  const std::vector<BendingRow> extra = extra_rows(net, pull);
  EdgeAlignedRows rows;
  rows.diagonal.assign(net.moving, 0);
  rows.beside.assign(net.moving == 0 ? 0 : net.rings.begin(net.moving), 0);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    SparseRows::Row room;
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      for_bending_row(
          net, i, room, [&](double value) { rows.diagonal[i] = static_cast<float>(value); },
          [&](std::size_t k, double value) {
            if (links[k].node() < net.moving) rows.beside[net.rings.begin(i) + k] = static_cast<float>(value);
          });
    }
  });
  rows.further = FloatRows::build(team, extra.size(), net.moving, [&] {
    return [&](std::size_t k, FloatRows::Row& row) {
      for (const SparseRows::Entry& entry : extra[k].entries) {
        if (entry.column < net.moving) row.push_back({entry.column, static_cast<float>(entry.value)});
      }
    };
  });
  return {net, std::move(rows), team};
}

std::vector<double> bending_residual(const Net& net, std::span<const Vector3> ways) {
  std::vector<double> pull(net.moving, 0);
  const auto add = [&](std::size_t centre, std::span<const SparseRows::Entry> row) {
    double bend = 0;
    for (const SparseRows::Entry& entry : row) bend += entry.value * ways[entry.column].dot(net.normals[centre]);
    for (const SparseRows::Entry& entry : row) {
      if (entry.column >= net.moving) continue;
      // Held nodes may have the opposite normal.
      const double sense = net.normals[entry.column].dot(net.normals[centre]) < 0 ? -1 : 1;
      pull[entry.column] -= sense * entry.value * bend;
    }
  };
  SparseRows::Row room;
  SparseRows::Row row;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    row.clear();
    for_bending_row(
        net, i, room,
        [&](double value) {
          row.push_back({static_cast<std::uint32_t>(i), value});
        },
        [&](std::size_t k, double value) {
          row.push_back({static_cast<std::uint32_t>(links[k].node()), value});
        });
    add(i, row);
  }
  for (const BendingRow& extra : extra_rows(net, {})) add(extra.centre, extra.entries);
  return pull;
}

SparseRows tangential_laplacian(const Net& net, ThreadTeam& team, double shift, SlidingNodes sliding) {
  const auto stays = [&](std::size_t i) { return sliding == SlidingNodes::stay && net.slides(i); };
  // One for every spoke; empty: 1.
  std::vector<double> weights;
  if (!net.laplacian_weights.empty()) {
    std::vector<double> one_way(net.rings.begin(net.moving));
    parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto links = net.rings.links(i);
        const auto shares = net.weights_of(i);
        const auto spokes =
            static_cast<double>(std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }));
        for (std::size_t k = 0; k < links.size(); ++k)
          one_way[net.rings.begin(i) + k] = std::max(spokes * shares[k], least_weight);
      }
    });
    // Symmetric: the mean of the two shares of an edge.
    weights = one_way;
    parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      net.rings.for_spoke_pairs(begin, end, net.moving, [&](std::size_t, std::size_t k, std::size_t, std::size_t back) {
        weights[k] = weights[back] = 0.5 * (one_way[k] + one_way[back]);
      });
    });
  }
  return SparseRows::build(team, net.moving, net.moving, [&] {
    return [&](std::size_t i, SparseRows::Row& row) {
      double sum = 0;
      const auto links = net.rings.links(i);
      for (std::size_t k = 0; k < links.size(); ++k) {
        if (!links[k].spoke()) continue;
        if (!net.target_positions.empty()) sum += 1;
        const std::size_t j = links[k].node();
        const double weight = weights.empty() ? 1 : weights[net.rings.begin(i) + k];
        sum += weight;
        if (j < net.moving) row.push_back({static_cast<std::uint32_t>(j), stays(i) || stays(j) ? 0 : -weight});
      }
      row.push_back({static_cast<std::uint32_t>(i), sum * (1 + shift)});
    };
  });
}

}  // namespace vspring
