#pragma once

#include <array>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/curvature.hpp"
#include "vspring/export.hpp"
#include "vspring/fairness.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

// All that is measured of a shape. A, D: its area and the diagonal of the box around it; κ1 ≥ κ2, H, K: principal, mean
// and Gaussian curvature by curvatures(), positive where the surface bends away from its normal; e1, e2: principal
// directions; κ, L: curvature and length of a curve. Integrals and curvatures are multiplied by lengths of the shape so
// that scaled copies have the same figures. Every figure is finite: what cannot be measured is left out, and the counts
// at the end say how much that was. Definitions and sources: docs/fairness.md.

struct SurfaceFigures : Fairness {
  double area = 0;      ///< of the faces, in squared units of the input
  double diagonal = 0;  ///< of the box around the faces, in units of the input
  /// ∫ κ1² + κ2² dA.
  double bending_energy = 0;
  /// A ∫ |∇H|² dA.
  double mean_curvature_variation = 0;
  /// A ∫ (∂κ1/∂e1)² + (∂κ2/∂e2)² dA (MVS, Moreton and Séquin 1992; times area: Joshi and Séquin 2007).
  double curvature_variation = 0;
  /// The same with (∂κ1/∂e2)² + (∂κ2/∂e1)² in addition (Joshi and Séquin 2007).
  double curvature_variation_cross = 0;
  double greatest_curvature = 0;  ///< largest κ1 D
  double least_curvature = 0;     ///< smallest κ2 D
  double greatest_mean_curvature = 0;
  double least_mean_curvature = 0;
  double greatest_gaussian_curvature = 0;  ///< times D²
  double least_gaussian_curvature = 0;
  /// Local extrema of H inside the surface that stand out by more than 5 % of the root mean square of √(κ1² + κ2²),
  /// and by more than 1/(1000 D).
  Index mean_curvature_extrema = 0;
  /// Faces that point against the faces around them at every one of their nodes.
  Index flipped_faces = 0;
  /// Pairs of faces that cross each other, see self_intersections(). Counting stops at 1,000,000.
  Index self_intersections = 0;
  double edge_spread = 1;               ///< longest edge over shortest
  double neighbouring_edge_spread = 1;  ///< the largest such ratio at one node
  double smallest_angle = 0;            ///< of the corners of faces, degrees
  double greatest_angle = 0;
  Index zero_length_edges = 0;
  Index zero_area_faces = 0;
  /// Nodes with too few nodes around for κ1 and κ2; they count as flat.
  Index nodes_without_curvature = 0;
  /// Nodes with too few nodes around for derivatives of curvature; they count as uniform.
  Index nodes_without_variation = 0;
  /// Largest angle between a given normal and that of the surface, by estimate_normals() over faces with a moving node,
  /// degrees. Empty without given normals.
  std::optional<double> normal_error;
};

struct CurveFigures : Fairness {
  double length = 0;    ///< in units of the input
  double diagonal = 0;  ///< of the box around the curve, in units of the input
  /// L ∫ κ² ds.
  double bending_energy = 0;
  /// L³ ∫ (dκ/ds)² ds, κ being the curvature vector in a rotation-minimising frame.
  double curvature_variation = 0;
  double greatest_curvature = 0;  ///< largest |κ| L
  /// Local extrema of curvature between the ends that stand out by more than 5 % of its root mean square, and by more
  /// than 1/(1000 L). Curvature is signed, so an inflection is no extremum.
  Index curvature_extrema = 0;
  /// Changes from curvature above that threshold to curvature above it on the other side.
  Index inflections = 0;
  double edge_spread = 1;               ///< longest edge over shortest
  double neighbouring_edge_spread = 1;  ///< the largest such ratio of successive edges
  Index zero_length_edges = 0;
  /// Largest angle between a given tangent, or the plane across a given normal, and the curve's own tangent on the
  /// sides that move, degrees. Empty without given directions.
  std::optional<double> normal_error;
};

/// Measures a surface. With constraints, only faces and edges with a moving node, and how well given normals are met.
/// Progress is reported in the stage "measuring". The same bits for every number of threads. Cost: n log n, some
/// microseconds per node. When cancelled, the figures are of a part and mean nothing.
[[nodiscard]] SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints,
                                             const Context& context);
[[nodiscard]] SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints = nullptr);

/// The same with curvatures that are known already, which take most of the time: one entry per node, as
/// curvatures(mesh, context) returns. The same bits as without. Throws Error(invalid_argument) unless there is one for
/// each node.
[[nodiscard]] SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints,
                                             std::span<const NodeCurvature> curvatures, const Context& context);

/// A surface before and after its nodes moved: to the bit what measure_surface() measures of each, in less than twice
/// the time of one, as it is looked once which nodes and faces lie around each other. Throws Error(invalid_argument)
/// where the two have other nodes or faces. Cost: n log n.
[[nodiscard]] std::array<SurfaceFigures, 2> measure_surfaces(const PolygonMesh& before, const PolygonMesh& after,
                                                             const Constraints* constraints, const Context& context);

/// Measures a curve, likewise. Cost: linear.
[[nodiscard]] CurveFigures measure_curve(const PolygonCurve& curve, const Constraints* constraints = nullptr);

/// A figure with its name, unit and definition.
struct Figure {
  std::string_view key;         ///< for scripts, like "bending_energy"
  std::string_view name;        ///< for people, like "bending energy"
  std::string_view unit;        ///< empty, "°", "units" or "units²" of the input
  std::string_view definition;  ///< in short
  double value;
  bool whole;  ///< a count
};

/// The figures that were measured, in the order in which they are shown. Texts are static.
[[nodiscard]] std::vector<Figure> list_figures(const SurfaceFigures& figures);
[[nodiscard]] std::vector<Figure> list_figures(const CurveFigures& figures);

}  // namespace vspring
