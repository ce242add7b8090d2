#pragma once

#include "vspring/context.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// How noisy a shape seems to be.
struct NoiseEstimate {
  /// The standard deviation of the nodes in each coordinate, in the units of the input; 0 where nothing is known.
  double deviation = 0;
  double edges = 0;  ///< the same in median edges
  Index nodes = 0;   ///< that it was told from
};

/// Estimates the noise of a surface from how far nodes lie off the best quadratic over a node, its neighbours and
/// theirs: what 30 of 100 places have less of, in terms of what the same share of places with nothing but noise would
/// have. What the shape itself bends within that counts as noise: of coarse shapes and sharp edges some of it. Nodes
/// with too little around are left out. Cost: linear, some 5 µs a node; the same bits for every number of threads.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonMesh& mesh, const Context& context = {});

/// The same of a curve, from seven nodes in a row; across it.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonCurve& curve);

}  // namespace vspring
