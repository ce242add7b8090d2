#include "linear/interpolation.hpp"

#include <Eigen/Core>
#include <algorithm>

#include "base/linear_precision.hpp"
#include "spring/near_nodes.hpp"

namespace vspring {

namespace {

constexpr std::size_t most_sources = 4;
// The least share of the unscaled shares that is left when they are corrected to reproduce linear functions.
constexpr double least_share_left = 0.2;
constexpr double ridge_share = 0.01;
constexpr auto none = static_cast<std::uint32_t>(-1);

struct Source {
  double distance2;
  std::uint32_t node;
};

/// Shares of sum 1, near 1/distance², with which the sources' mean is the centre, in the best plane through them.
void find_shares(const Vector3& centre, std::span<const Vector3> positions, std::span<const Source> sources,
                 std::vector<double>& shares) {
  shares.clear();
  LinearPrecision linear;
  for (const Source& source : sources) {
    const double weight = 1 / std::max(source.distance2, 1e-300);
    shares.push_back(weight);
    linear.add(weight, positions[source.node] - centre);
  }
  const Vector3 slope = linear.leaving(least_share_left, linear.slope(ridge_share));
  double total = 0;
  for (std::size_t k = 0; k < sources.size(); ++k) {
    shares[k] *= 1 - slope.dot(positions[sources[k].node] - centre);
    total += shares[k];
  }
  for (double& share : shares) share /= total;
}

}  // namespace

Interpolation interpolation(const Net& fine, const Net& coarse, std::span<const std::uint32_t> finer,
                            ThreadTeam& team) {
  const std::vector<Vector3>& positions = fine.positions;
  std::vector<std::uint32_t> number(fine.moving, none);
  for (std::size_t k = 0; k < coarse.moving; ++k) number[finer[k]] = static_cast<std::uint32_t>(k);
  const auto is_source = [&](std::size_t i) { return i >= fine.moving || number[i] != none; };

  Interpolation result;
  result.up = FloatRows::build(team, fine.moving, coarse.moving, [&] {
    return [&, sources = std::vector<Source>(), shares = std::vector<double>()](std::size_t i,
                                                                                FloatRows::Row& row) mutable {
      if (number[i] != none) {
        row.push_back({number[i], 1});
        return;
      }
      sources.clear();
      const auto look = [&](std::size_t j) {
        if (j == i || !is_source(j)) return;
        sources.push_back({(positions[j] - positions[i]).squaredNorm(), static_cast<std::uint32_t>(j)});
      };
      for (const Link near : fine.rings.links(i)) {
        look(near.node());
        if (near.node() >= fine.moving || fine.rings.links(near.node()).size() > most_links_beside) continue;
        for (const Link far : fine.rings.links(near.node())) look(far.node());
      }
      std::sort(sources.begin(), sources.end(), [](const Source& a, const Source& b) {
        return a.distance2 < b.distance2 || (a.distance2 == b.distance2 && a.node < b.node);
      });
      sources.erase(std::unique(sources.begin(), sources.end(),
                                [](const Source& a, const Source& b) { return a.node == b.node; }),
                    sources.end());
      if (sources.size() > most_sources) sources.resize(most_sources);
      find_shares(positions[i], positions, sources, shares);
      for (std::size_t k = 0; k < sources.size(); ++k) {
        if (sources[k].node < fine.moving) row.push_back({number[sources[k].node], static_cast<float>(shares[k])});
      }
    };
  });
  result.down = result.up.transposed();
  return result;
}

}  // namespace vspring
