#pragma once

#include <array>
#include <optional>
#include <span>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// An estimate of the noise of a shape.
struct NoiseEstimate {
  /// The standard deviation of the nodes in each coordinate, in units of the input; 0 if unknown.
  double deviation = 0;
  double edges = 0;    ///< `deviation` over the median edge length
  Index nodes = 0;     ///< number of nodes that it was estimated from
  int directions = 1;  ///< in which noise moves nodes across the shape: 2 for space curves, where squared distances are
                       ///< twice as large
  /// Curves: the standard deviation in x, y and z; 0 for the coordinate along the curve, and with too few nodes (about
  /// 70).
  std::array<double, 3> by_coordinate = {};
  /// Whether the values of by_coordinate differ by more than a factor of two, as those of heights and places do. Then
  /// `deviation` is the root mean square across the curve.
  bool coordinates_differ = false;
  /// Set for surfaces of voxels, whose steps are their noise: see voxel_size().
  std::optional<Vector3> voxel = std::nullopt;
};

/// Finds the size of voxels along x, y and z, in units of the input. The faces of the surface must be sides of voxels,
/// or what marching cubes or tetrahedra make of a mask (nodes half way between points of the grid). Empty for any other
/// surface, a flat one, and fewer than 50 nodes. Coordinates may be rounded to single precision. Cost: n log n.
[[nodiscard]] std::optional<Vector3> voxel_size(const PolygonMesh& mesh);

/// Returns how far noise moves the furthest node from the true shape, in units of the input: the median over shapes of
/// as many nodes, and at least the distance that 3 nodes of 1,000 exceed (3 standard deviations, or 3.44 in two
/// directions). If the noise of coordinates differs, the largest counts for all. Cost: constant.
[[nodiscard]] double greatest_of_noise(const NoiseEstimate& noise);

/// Estimates the noise of a surface. At each node a quadratic is fitted to the node, its neighbours and theirs; the
/// heights that remain are noise. Their 10th, 20th and 30th percentiles over all nodes are compared with those of pure
/// noise, and the smallest estimate counts (docs/fit.md). Bends of the shape within that distance count as noise, as at
/// sharp edges and on coarse meshes. Nodes with too few around, or amid edges shorter than the noise, are left out. For
/// voxels, steps are taken to be spread evenly over one voxel. The same bits for every number of threads. Cost: linear,
/// some 6 µs a node.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonMesh& mesh, const Context& context = {});

/// The same of a part of it: of the faces whose nodes are all in the region, whatever noise there is elsewhere. The
/// whole counts where these have fewer than 30 nodes. region: numbers of nodes, in any order. Throws
/// Error(invalid_argument) for a number that no node has.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonMesh& mesh, std::span<const Index> region,
                                           const Context& context = {});

/// Estimates the noise of a curve across it, from runs of seven nodes, or of as many more as make a run four times as
/// long as wide. With fewer than 16 such runs, as of 21 nodes in a row, it is unknown: bends would count. If a fifth of
/// all nodes are nearer to the next one than a quarter of the noise, such nodes count as one. Cost: linear.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonCurve& curve);

/// Estimates the noise of a curve in the coordinates that may change, such as heights, over the length of the way in
/// the others. moving_axes: as in FitOptions. Cost: linear.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonCurve& curve, const std::array<bool, 3>& moving_axes);

/// The same of a part of it: of the edges between nodes of the region. The whole counts where these are too few.
/// region: numbers of nodes, in any order. Throws Error(invalid_argument) for a number that no node has.
[[nodiscard]] NoiseEstimate estimate_noise(const PolygonCurve& curve, std::span<const Index> region,
                                           const std::array<bool, 3>& moving_axes);

}  // namespace vspring
