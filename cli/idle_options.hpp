#pragma once

#include <set>
#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/fair.hpp"

namespace vspring::cli {

struct FairingArguments;

/// What decides which options of a run have had an effect. What a command does not know stays as it is here.
struct RunFacts {
  std::set<std::string> given = {};     ///< options, by their long names
  bool is_curve = false;                ///< or else a surface
  bool boundary_moves = false;          ///< some node of the boundary, or some end
  bool moves_near_boundary = false;     ///< some node there, or beside it
  bool is_planar = false;               ///< a curve with all that holds it
  bool resamples = false;               ///< --resample or --spacing
  bool moves_freely = true;             ///< no coordinate is kept
  bool own_nodes_pull = false;          ///< --within and the like, where there is no --points
  bool points_face = false;             ///< points have normals
  bool equilibrium_tried = false;       ///< by the method that was asked for
  Springs springs = Springs::sphere;    ///< that were asked for
  Method method = Method::equilibrium;  ///< that the shape is from
  std::size_t levels = 0;
  bool fix_is_none = false;
  bool fair_boundary = false;
  bool boundary_to_equilibrium = false;  ///< what --fair-boundary makes of it
  bool has_picture = false;
  bool picture_is_svg = false;
  bool has_page = false;
  bool has_noise = false;      ///< --noise of vspring generate
  bool draws_numbers = false;  ///< a generated shape has something random
  bool is_flat = false;        ///< a generated annulus
};

/// Fills in what arguments say.
void look_at(RunFacts& facts, const FairingArguments& arguments);

/// Fills in what a shape and what holds it say, as far as that is asked for.
void look_at(RunFacts& facts, const PolygonMesh& mesh, const Constraints& constraints);
void look_at(RunFacts& facts, const PolygonCurve& curve, const Constraints& constraints);

/// A warning for every option that was given and had no effect, and with what it would have one.
[[nodiscard]] std::vector<std::string> idle_options(const RunFacts& facts);

}  // namespace vspring::cli
