#pragma once

#include <utility>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::bench {

constexpr double half_angle = 60;

/// The cap of the unit sphere that the flat start is to become.
inline PolygonMesh exact_cap(Index nodes) {
  return generate::cap({.nodes = nodes, .half_angle = half_angle, .jitter = 0.3});
}

inline PolygonMesh flat_cap(PolygonMesh cap, double noise) {
  return support::flattened(std::move(cap), half_angle, noise);
}

}  // namespace vspring::bench
