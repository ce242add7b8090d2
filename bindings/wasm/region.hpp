// Constraints with which only some nodes move.

#pragma once

#include <vector>

#include "values.hpp"

namespace vspring {

/// The direction of a shape at its rim: its name, whether it is given, and its value.
struct RimDirection {
  const char* name;
  bool (Constraints::*fixed)(Index) const;
  const Vector3& (Constraints::*value)(Index) const;
};

/// `fixed`, nodes that stay, and `rim` with its directions, three numbers each, of a shape with these positions;
/// without nodes that `constraints` holds already.
template <typename Shape>
val region_of(const Constraints& constraints, Shape shape, const val& nodes, const val& positions,
              const RimDirection& direction) {
  return forwarding_errors([&] {
    shape.set_positions(vectors_of(positions));
    Constraints restricted = constraints;
    restrict_to_region(restricted, shape, emscripten::convertJSArrayToNumberVector<Index>(nodes));
    std::vector<Index> fixed;
    std::vector<Index> rim;
    std::vector<Vector3> directions;
    for (Index node = 0; node < shape.node_count(); ++node) {
      if (restricted.position_fixed(node) && !constraints.position_fixed(node)) fixed.push_back(node);
      if (!(restricted.*direction.fixed)(node) || (constraints.*direction.fixed)(node)) continue;
      rim.push_back(node);
      directions.push_back((restricted.*direction.value)(node));
    }
    val result = val::object();
    result.set("fixed", array_of("Int32Array", fixed.size(), fixed.data()));
    result.set("rim", array_of("Int32Array", rim.size(), rim.data()));
    result.set(direction.name, positions_array(directions));
    return result;
  });
}

}  // namespace vspring
