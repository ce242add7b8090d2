#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// How far around the nearest node to search for one that faces alike, in mean edges.
inline constexpr double reach_in_edges = 10;

/// Whether a point may be tied to a node, by the normals of both: within 90° of each other, or one of them unknown
/// (zero). margin: by what their cosine must be more than 0.
inline bool face_alike(const Vector3& of_point, const Vector3& of_node, double margin = 0) {
  return of_point.isZero(0) || of_node.isZero(0) || of_point.dot(of_node) >= margin;
}

/// How far from the nodes points may lie, in sizes of the box around the nodes, so that squares do not overflow.
inline constexpr double furthest_point = 1e50;

/// Which nodes points are preferably tied to.
struct Preference {
  /// Whether a node suits a point. Empty: every node does.
  std::function<bool(std::size_t point, std::size_t node)> content = nullptr;
  /// A suitable node may be this much further away than twice the distance of the nearest node.
  double reach = 0;
};

/// Returns per point the nearest suitable node within reach, else the nearest node; of equally near ones the smallest
/// number; −1 if no node is finite. usable: one entry per node, 0 for nodes that do not count. Throws
/// Error(invalid_argument) naming a point beyond furthest_point. Cost: n log n.
std::vector<Index> nearest_nodes(std::span<const Vector3> points, std::span<const Vector3> nodes,
                                 std::span<const std::uint8_t> usable, ThreadTeam& team,
                                 const Preference& preference = {});

/// nearest_nodes() without a limit to the distance of points; squares of distances must not overflow.
std::vector<Index> nearest_places(std::span<const Vector3> points, std::span<const Vector3> nodes,
                                  std::span<const std::uint8_t> usable, ThreadTeam& team,
                                  const Preference& preference = {});

}  // namespace vspring
