#include "curve_fit/outliers.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "base/median.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

constexpr std::size_t longest_run = 3;
// How far aside spikes are, in median lengths between rows around: if the way goes straight to them and from them, as
// at a tip, and if not.
constexpr double aside_of_tip = 6;
constexpr double aside_of_spike = 2.5;
// Cosine of 60°.
constexpr double least_cosine_of_tip = 0.5;
constexpr std::size_t rows_of_direction = 2;
constexpr std::size_t rows_beside = 8;

struct Spike {
  std::size_t first;  ///< among the rows left
  std::size_t count;
  double severity;  ///< edges by which the way is shorter without them, per row
};

}  // namespace

std::vector<std::uint8_t> find_spikes(std::span<const Vector3> rows, bool closed, std::size_t most,
                                      double least_aside) {
  std::vector<std::uint8_t> spikes(rows.size(), 0);
  std::vector<std::size_t> left(rows.size());
  for (std::size_t k = 0; k < left.size(); ++k) left[k] = k;
  std::size_t found = 0;
  // Removed rows may reveal others next to them.
  while (found < most && left.size() > 2 * longest_run) {
    const std::size_t count = left.size();
    std::vector<double> lengths(count);
    const auto row = [&](std::size_t k) -> const Vector3& { return rows[left[k % count]]; };
    for (std::size_t k = 0; k < count; ++k) lengths[k] = (row(k + 1) - row(k)).norm();
    std::vector<Spike> all;
    std::vector<double> about;
    for (std::size_t k = 1; k < count + (closed ? 1 : 0); ++k) {
      end_if_cancelled_at(k);
      for (std::size_t n = 1; n <= longest_run && (closed || k + n < count); ++n) {
        const Vector3& before = row(k - 1);
        const Vector3& after = row(k + n);
        // The distance aside of the nearest of them.
        double aside = std::numeric_limits<double>::infinity();
        for (std::size_t j = k; j < k + n; ++j) {
          const double share = nearest_share(row(j), before, after);
          aside = std::min(aside, (before + share * (after - before) - row(j)).norm());
        }
        if (!(aside > std::min(lengths[k - 1], lengths[(k + n - 1) % count]) / 2)) continue;
        about.clear();
        const std::size_t reach = std::min(rows_beside, (count - 1) / 2);
        for (std::size_t j = 0; j < 2 * reach + n; ++j) {
          const std::size_t at = k + count + j - reach - 1;
          const bool inside = closed || (at >= count && at + 1 < 2 * count);
          if (inside) about.push_back(lengths[at % count]);
        }
        const double middle = median(about);
        const auto goes_on = [&](std::size_t from, std::size_t by, std::size_t to) {
          const Vector3 way = row(by) - row(from);
          const Vector3 jump = row(to) - row(by);
          return way.dot(jump) >= least_cosine_of_tip * way.norm() * jump.norm();
        };
        const bool has_before = closed || k > rows_of_direction;
        const bool has_after = closed || k + n + rows_of_direction < count;
        const bool is_tip = (!has_before || goes_on(k + count - 1 - rows_of_direction, k + count - 1, k)) &&
                            (!has_after || goes_on(k + n + rows_of_direction, k + n, k + n - 1));
        const double least = std::max(least_aside, (is_tip ? aside_of_tip : aside_of_spike) * middle);
        if (!(aside > least)) continue;
        double gain = -(after - before).norm();
        for (std::size_t j = k - 1; j < k + n; ++j) gain += lengths[j % count];
        all.push_back({k, n, gain / (static_cast<double>(n) * std::max(middle, 1e-300))});
      }
    }
    if (all.empty()) break;
    std::stable_sort(all.begin(), all.end(), [](const Spike& a, const Spike& b) { return a.severity > b.severity; });
    // The worst at each place: between two spikes these, not the good rows.
    std::vector<std::uint8_t> taken(count, 0);
    std::vector<std::uint8_t> out(count, 0);
    for (const Spike& spike : all) {
      if (found + spike.count > most) continue;
      bool free = true;
      for (std::size_t j = 0; j < spike.count + 2 * longest_run; ++j)
        free = free && taken[(spike.first + count + j - longest_run) % count] == 0;
      if (!free) continue;
      for (std::size_t j = 0; j < spike.count; ++j) {
        taken[(spike.first + j) % count] = out[(spike.first + j) % count] = 1;
        ++found;
      }
    }
    std::vector<std::size_t> rest;
    for (std::size_t k = 0; k < count; ++k) {
      if (out[k] != 0)
        spikes[left[k]] = 1;
      else
        rest.push_back(left[k]);
    }
    if (rest.size() == count) break;
    left = std::move(rest);
  }
  return spikes;
}

}  // namespace vspring
