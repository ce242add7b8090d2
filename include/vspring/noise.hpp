#pragma once

#include <array>
#include <optional>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// How noisy a shape seems to be.
struct NoiseEstimate {
  /// The standard deviation of the nodes in each coordinate, in the units of the input; 0 where nothing is known.
  double deviation = 0;
  double edges = 0;    ///< the same in median edges
  Index nodes = 0;     ///< from how many nodes it was estimated
  int directions = 1;  ///< across the shape: 2 of curves in space, where distances are so many times as large squared
  /// Curves: the standard deviation in x, y and z each; 0 of what they run along, and where there are too few nodes to
  /// tell (some 70).
  std::array<double, 3> by_coordinate = {};
  /// By more than a factor of two, as those of heights and places do: `deviation` is the root mean square across.
  bool coordinates_differ = false;
  /// Surfaces of voxels, where noise is what their steps are: see voxel_size().
  std::optional<Vector3> voxel = std::nullopt;
};

/// The size of the voxels along x, y and z, where the faces of a surface are their sides, or what marching cubes or
/// tetrahedra make of a mask (nodes half way between points of the grid). None elsewhere, of what is flat, and of fewer
/// than 50 nodes. Coordinates may be rounded to single precision. Cost: n log n.
[[nodiscard]] std::optional<Vector3> voxel_size(const PolygonMesh& mesh);

/// How far from its shape noise brings the furthest node, in the units of the input: half of all shapes with as many
/// nodes stay within. At least what 3 nodes of 1,000 are beyond: three standard deviations, or 3.44 in two directions.
/// Where the noise of coordinates differs, it is taken to be the largest in all. Cost: constant.
[[nodiscard]] double greatest_of_noise(const NoiseEstimate& noise);

/// Estimates the noise of a surface. Over each node, its neighbours and theirs, the best quadratic leaves heights,
/// which are taken across the surface; the values that 10, 20 and 30 of 100 nodes stay below are compared with what
/// pure noise would give, and the least counts (docs/fit.md). What the shape itself bends within that distance counts
/// as noise, so of coarse shapes and sharp edges some of it does. Nodes with too few around are left out, and those
/// amid edges shorter than the noise. Of voxels it is what their steps are, evenly spread over one. The same bits for
/// every number of threads. Cost: linear, some 6 µs a node.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonMesh& mesh, const Context& context = {});

/// The same of a curve, across it, from seven nodes in a row, or as many more as it takes for them to be four times as
/// long as they are wide. Nodes in a row that are nearer together than a quarter of the noise count as one where a
/// fifth of all are.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonCurve& curve);

/// The same in the coordinates that move, of x, y and z, over the length of the way in the others: of heights,
/// vertically. See FitOptions::moving_axes.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonCurve& curve, const std::array<bool, 3>& moving_axes);

}  // namespace vspring
