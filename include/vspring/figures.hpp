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

// Symbols. A, D: the area of a surface and the diagonal of the box around it; κ1 ≥ κ2, H, K: principal, mean and
// Gaussian curvature by curvatures(), positive where the surface bends away from its normal; e1, e2: principal
// directions; κ, L: curvature and length of a curve. Integrals and curvatures are multiplied by lengths of the shape,
// so scaled copies have the same figures. Every figure is finite: what cannot be measured is left out and counted.
// Definitions and sources: docs/fairness.md.

/// How fair a surface is, and how good its faces are.
struct SurfaceFigures : Fairness {
  double area = 0;      ///< of the faces, in squared units of the input
  double diagonal = 0;  ///< of the box around the faces, in units of the input
  /// ∫ κ1² + κ2² dA.
  double bending_energy = 0;
  /// A ∫ |∇H|² dA.
  double mean_curvature_variation = 0;
  /// A ∫ (∂κ1/∂e1)² + (∂κ2/∂e2)² dA (MVS, Moreton and Séquin 1992; times area: Joshi and Séquin 2007).
  double curvature_variation = 0;
  /// curvature_variation with (∂κ1/∂e2)² + (∂κ2/∂e1)² added under the integral (Joshi and Séquin 2007).
  double curvature_variation_cross = 0;
  double greatest_curvature = 0;           ///< largest κ1 D
  double least_curvature = 0;              ///< smallest κ2 D
  double greatest_mean_curvature = 0;      ///< largest H D
  double least_mean_curvature = 0;         ///< smallest H D
  double greatest_gaussian_curvature = 0;  ///< largest K D²
  double least_gaussian_curvature = 0;     ///< smallest K D²
  /// Local extrema of H inside the surface that exceed their surroundings by more than 5 % of the root mean square of
  /// √(κ1² + κ2²), and by more than 1/(1000 D).
  Index mean_curvature_extrema = 0;
  /// Faces whose normal is opposite to that of the faces around at every one of their nodes.
  Index flipped_faces = 0;
  /// Pairs of faces that cross each other, see self_intersections(). Counting stops at 1,000,000.
  Index self_intersections = 0;
  double edge_spread = 1;               ///< longest edge over shortest
  double neighbouring_edge_spread = 1;  ///< the largest such ratio at one node
  double smallest_angle = 0;            ///< of the corners of faces, degrees
  double greatest_angle = 0;            ///< likewise
  Index zero_length_edges = 0;          ///< edges between nodes at one position
  Index zero_area_faces = 0;            ///< faces without area
  /// Nodes with too few nodes around for κ1 and κ2; they are taken as flat.
  Index nodes_without_curvature = 0;
  /// Nodes with too few nodes around for derivatives of curvature; the derivatives are taken as zero.
  Index nodes_without_variation = 0;
  /// Largest angle between a given normal and that of the surface, by estimate_normals() over faces with a moving node,
  /// degrees. Empty without given normals.
  std::optional<double> normal_error;
};

/// How fair a curve is, and how even its nodes are.
struct CurveFigures : Fairness {
  double length = 0;    ///< in units of the input
  double diagonal = 0;  ///< of the box around the curve, in units of the input
  /// L ∫ κ² ds.
  double bending_energy = 0;
  /// L³ ∫ (dκ/ds)² ds, κ being the curvature vector in a rotation-minimising frame.
  double curvature_variation = 0;
  double greatest_curvature = 0;  ///< largest |κ| L
  /// Local extrema of curvature between the ends that exceed their surroundings by more than 5 % of its root mean
  /// square, and by more than 1/(1000 L). Curvature is signed, so an inflection is no extremum.
  Index curvature_extrema = 0;
  /// Changes of the sign of curvature, from beyond that threshold on one side to beyond it on the other.
  Index inflections = 0;
  double edge_spread = 1;               ///< longest edge over shortest
  double neighbouring_edge_spread = 1;  ///< the largest such ratio of successive edges
  Index zero_length_edges = 0;          ///< edges between nodes at one position
  /// Largest angle, degrees, between the curve's tangent, on sides that move, and a given tangent or the plane across a
  /// given normal. Empty without given directions.
  std::optional<double> normal_error;
};

/// Measures a surface. With constraints, only faces and edges with a moving node count, and
/// SurfaceFigures::normal_error is set. Progress is reported in the stage "measuring". The same bits for every number
/// of threads. Cost: n log n, some microseconds per node. When cancelled, the figures are incomplete and mean nothing.
[[nodiscard]] SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints,
                                             const Context& context);
[[nodiscard]] SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints = nullptr);

/// Measures a surface whose curvatures are known already: this saves most of the time. curvatures: one entry per node,
/// as curvatures(mesh, context) returns them. The same bits as without. Throws Error(invalid_argument) unless there is
/// one per node.
[[nodiscard]] SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints,
                                             std::span<const NodeCurvature> curvatures, const Context& context);

/// Measures a surface before and after its nodes moved. The figures have the bits of measure_surface(); neighbourhoods
/// are found once for both, which saves time. Throws Error(invalid_argument) if node counts or faces differ. Cost: n
/// log n.
[[nodiscard]] std::array<SurfaceFigures, 2> measure_surfaces(const PolygonMesh& before, const PolygonMesh& after,
                                                             const Constraints* constraints, const Context& context);

/// Measures a curve. With constraints, only what moving nodes take part in counts, and CurveFigures::normal_error is
/// set. Cost: linear.
[[nodiscard]] CurveFigures measure_curve(const PolygonCurve& curve, const Constraints* constraints = nullptr);

/// Throws Error(unusable_shape) naming a node that is not finite, of a face or an edge that would be measured with
/// these constraints if it were. Figures leave such faces and edges out. Cost: linear.
void check_measurable(const PolygonMesh& mesh, const Constraints* constraints = nullptr);
void check_measurable(const PolygonCurve& curve, const Constraints* constraints = nullptr);

/// A figure with its name, unit and definition.
struct Figure {
  std::string_view key;         ///< for scripts, like "bending_energy"
  std::string_view name;        ///< for people, like "bending energy"
  std::string_view unit;        ///< empty, "°", "units" or "units²" of the input
  std::string_view definition;  ///< in a few words
  double value;                 ///< in `unit`
  bool whole;                   ///< whether it is a count
};

/// Lists the figures in the order in which they are shown. Texts are static.
[[nodiscard]] std::vector<Figure> list_figures(const SurfaceFigures& figures);
[[nodiscard]] std::vector<Figure> list_figures(const CurveFigures& figures);

}  // namespace vspring
