#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <utility>

#include "spring/curve_net.hpp"

namespace vspring {

/// A row of bending of a run: a curvature as a sum over places of the run, times the root of half its length.
struct CurveBendingRow {
  std::span<const std::pair<std::size_t, double>> entries;  ///< places of the run, and coefficients
  bool across_seam;                                         ///< whether it joins the end of a closed run to its start
  /// The place with a given direction, if the edge between both entries should have that direction.
  std::optional<std::size_t> given;
};

/// Calls row(CurveBendingRow) in the order of places: √(h/4) κ with h = ℓ₋ + ℓ₊, κ = (2/h) (Δy₊/ℓ₊ − Δy₋/ℓ₋), at every
/// node with two edges; one row on each side of a node with a given direction; none at other ends. Cost: linear.
template <typename Row>
void for_each_bending_row(const Net& net, const MovingRun& moving_run, const Row& row) {
  const auto& nodes = moving_run.nodes;
  const std::size_t count = nodes.size();
  const auto edge = [&](std::size_t a, std::size_t b) {
    const Vector3 d = net.positions[nodes[b]] - net.positions[nodes[a]];
    return std::sqrt(d.dot(d) + net.tiny);
  };
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t i = nodes[k];
    const bool has_before = k > 0 || moving_run.closed;
    const bool has_after = k + 1 < count || moving_run.closed;
    const std::size_t before = (k + count - 1) % count;
    const std::size_t after = (k + 1) % count;
    const double length_before = has_before ? edge(before, k) : 0;
    const double length_after = has_after ? edge(k, after) : 0;
    // The first place of a closed run comes after its last.
    const bool before_seam = has_after && after == 0 && nodes[0] < net.moving;
    if (net.given[i] != 0) {
      if (has_before) {
        const double entry = 1 / (length_before * std::sqrt(length_before));
        row(CurveBendingRow{std::array{std::pair(before, -entry), std::pair(k, entry)}, k == 0, k});
      }
      if (has_after) {
        const double entry = 1 / (length_after * std::sqrt(length_after));
        row(CurveBendingRow{std::array{std::pair(k, -entry), std::pair(after, entry)}, before_seam, k});
      }
    } else if (has_before && has_after) {
      const double scale = 1 / std::sqrt(length_before + length_after);
      const double entry_before = scale / length_before;
      const double entry_after = scale / length_after;
      row(CurveBendingRow{std::array{std::pair(before, entry_before), std::pair(k, -entry_before - entry_after),
                                     std::pair(after, entry_after)},
                          k == 0 || before_seam, std::nullopt});
    }
  }
}

}  // namespace vspring
