#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// How far from the nodes points may lie, in sizes of the box around the nodes: squares must not overflow.
inline constexpr double furthest_point = 1e50;

/// Which nodes points had rather be tied to.
struct Preference {
  /// Whether a point, by its number, is content with a node. Empty: with every one.
  std::function<bool(std::size_t point, std::size_t node)> content = nullptr;
  /// How much further than twice as far as the nearest of all nodes one may be for that.
  double reach = 0;
};

/// The node nearest to each of the points, of those that it is content with where one is in reach; of several the one
/// with the smallest number; −1 where there is none that is finite. usable: one entry per node, 0 for nodes that do not
/// count. Throws Error(invalid_argument) naming a point beyond furthest_point. Cost: n log n.
std::vector<Index> nearest_nodes(std::span<const Vector3> points, std::span<const Vector3> nodes,
                                 std::span<const std::uint8_t> usable, ThreadTeam& team,
                                 const Preference& preference = {});

/// The same without a limit to how far points lie; squares of distances must not overflow.
std::vector<Index> nearest_places(std::span<const Vector3> points, std::span<const Vector3> nodes,
                                  std::span<const std::uint8_t> usable, ThreadTeam& team,
                                  const Preference& preference = {});

}  // namespace vspring
