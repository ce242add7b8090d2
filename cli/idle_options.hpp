#pragma once

#include <set>
#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/fair.hpp"

namespace vspring::cli {

struct FairingArguments;

/// Facts that decide which options of a run had an effect. Commands leave facts that they do not know at these
/// defaults.
struct RunFacts {
  std::set<std::string> given = {};     ///< options, by their long names
  bool is_curve = false;                ///< or else a surface
  bool boundary_moves = false;          ///< some node of the boundary or some end moves
  bool moves_near_boundary = false;     ///< some node there or next to it moves
  bool is_planar = false;               ///< a curve that lies in a plane with its constraints
  bool resamples = false;               ///< --resample or --spacing
  bool refines_nothing = false;         ///< --refine found nothing to divide
  bool remeshes_nothing = false;        ///< --remesh found no face that moves
  bool moves_freely = true;             ///< no coordinate is kept
  bool own_nodes_pull = false;          ///< by --within and the like, without --points
  bool points_face = false;             ///< points have normals
  bool equilibrium_tried = false;       ///< by the given method
  Springs springs = Springs::sphere;    ///< the given ones
  Method method = Method::equilibrium;  ///< that made the shape
  std::size_t levels = 0;
  Index sharp_edges = 0;             ///< of a surface
  bool takes_marks = false;          ///< --sharp marked
  bool sharp_option_is_idle = true;  ///< --sharp found and took no edges of a surface
  bool spans_curves = false;         ///< the surface spans curves
  bool ends_in_plane = false;        ///< such a surface ends in the plane of --symmetry
  bool fix_is_none = false;
  bool fair_boundary = false;
  bool boundary_to_equilibrium = false;  ///< whether --fair-boundary takes it there
  bool has_picture = false;
  bool picture_is_svg = false;
  bool has_page = false;
  bool has_noise = false;      ///< --noise of vspring generate
  bool draws_numbers = false;  ///< a generated shape has something random
  bool is_flat = false;        ///< a generated annulus
};

/// Fills in the facts from arguments.
void look_at(RunFacts& facts, const FairingArguments& arguments);

/// Fills in the facts from a shape and its constraints, as far as the given options need them.
void look_at(RunFacts& facts, const PolygonMesh& mesh, const Constraints& constraints);
void look_at(RunFacts& facts, const PolygonCurve& curve, const Constraints& constraints);

/// A warning for every given option without effect; it says with what the option would have one.
[[nodiscard]] std::vector<std::string> idle_options(const RunFacts& facts);

}  // namespace vspring::cli
