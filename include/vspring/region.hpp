#pragma once

#include <map>
#include <string>
#include <variant>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// The nodes of each named group, ascending.
using Groups = std::map<std::string, std::vector<Index>>;

/// The nodes in and on a sphere, in units of the positions; none if the radius is negative.
struct SphereRegion {
  Vector3 centre;  ///< in units of the positions
  double radius;   ///< likewise
};

/// The nodes in and on a box along the axes, by two opposite corners in units of the positions.
struct BoxRegion {
  Vector3 from;  ///< one corner
  Vector3 to;    ///< the opposite one
};

/// The nodes of a group that the file names.
struct GroupRegion {
  std::string group;  ///< its name
};

/// Nodes by their numbers, in any order; repeated ones count once.
struct NodeRegion {
  std::vector<Index> nodes;  ///< from 0 on
};

/// Which nodes may move, see restrict_to_region().
struct Region {
  /// The nodes, or where they lie.
  std::variant<SphereRegion, BoxRegion, GroupRegion, NodeRegion> extent;
  /// What messages call the region, such as the specification given to parse_region(); may be empty.
  std::string name = {};
};

/// Returns the nodes of a region, ascending. Throws Error(unusable_constraint), naming the region, for one without a
/// node, an unknown group, and a node out of range. Cost: linear.
[[nodiscard]] std::vector<Index> select_region(const std::vector<Vector3>& positions, const Region& region,
                                               const Groups& groups = {});

}  // namespace vspring
