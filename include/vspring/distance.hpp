#pragma once

#include <span>
#include <vector>

#include "vspring/context.hpp"
#include "vspring/export.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// How far points lie from a shape or from other points, in units of the input.
struct Distance {
  double greatest = 0;  ///< of all points
  double rms = 0;       ///< root mean square over the points
  Index node = -1;      ///< the point of the greatest distance; −1 where no point was measured
  /// Points measured: those with finite coordinates.
  Index count = 0;
};

/// Measures how far each node moved. before, after: one position per node. Throws Error(invalid_argument) if they
/// differ in number. Cost: linear.
[[nodiscard]] Distance node_distance(std::span<const Vector3> before, std::span<const Vector3> after);

/// Measures the distance of every point from the nearest place on the polygons of a mesh, or on the edges of a curve,
/// of any connectivity. Faces that are not flat are split into triangles (docs/fairness.md). The same bits for every
/// number of threads. Throws Error(unusable_shape) for a shape without a face (edge) of finite coordinates. Cost: n log
/// n. When cancelled, only the points measured so far count.
[[nodiscard]] Distance distance(std::span<const Vector3> of_points, const PolygonMesh& to_shape,
                                const Context& context);
[[nodiscard]] Distance distance(std::span<const Vector3> of_points, const PolygonMesh& to_shape);
[[nodiscard]] Distance distance(std::span<const Vector3> of_points, const PolygonCurve& to_shape,
                                const Context& context);
[[nodiscard]] Distance distance(std::span<const Vector3> of_points, const PolygonCurve& to_shape);

/// The same from the nodes of a shape to another. Nodes in no face (edge) are no part of a shape and do not count.
[[nodiscard]] Distance distance(const PolygonMesh& of_shape, const PolygonMesh& to_shape, const Context& context = {});
[[nodiscard]] Distance distance(const PolygonCurve& of_shape, const PolygonCurve& to_shape,
                                const Context& context = {});

/// Returns the distance of each point, as distance() measures it; zero for a point that is not finite. Throws and costs
/// what distance() does.
[[nodiscard]] std::vector<double> point_distances(std::span<const Vector3> of_points, const PolygonMesh& to_shape,
                                                  const Context& context);
[[nodiscard]] std::vector<double> point_distances(std::span<const Vector3> of_points, const PolygonCurve& to_shape,
                                                  const Context& context);

}  // namespace vspring
