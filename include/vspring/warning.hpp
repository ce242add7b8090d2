#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "vspring/advice.hpp"
#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// What a warning is about.
enum class WarningCode : std::uint8_t {
  immovable_nodes,     ///< nodes that cannot move are held: at edges of more than two faces (of four or more with all
                       ///< nodes of these), where several fans meet
  free_boundary,       ///< boundary nodes are free and are drawn in
  untold_boundary,     ///< boundary nodes are free, and no points are near enough to show where they belong
  family_of_shapes,    ///< more than one sphere, plane or circle fits the constraints
  only_ends_held,      ///< nothing but its ends holds an open curve, which becomes straight
  other_springs,       ///< edge springs took the place of sphere springs
  other_fairness,      ///< no shape fair by curvature was found; this one is fair by bending
  smoothed_less,       ///< what was asked for leads to no shape; the text says by how much less it is smoothed
  other_distribution,  ///< nodes went to the mean of their neighbours
  no_equilibrium,      ///< none was found; the text says what was returned
  worse_than_input,    ///< the shape found is; the text says how, and what was returned
  steps_grew,          ///< the steps of the paper's iteration grew again
  level_cut_short,     ///< a coarser level of a V-cycle ended at its limit of iterations
  outside_tolerance,   ///< no shape within the tolerance was found: this one is the nearest
  points_at_held,      ///< points nearest to what is held are beyond the tolerance; they do not count
  radius_not_kept,     ///< somewhere the radius of curvature is below the least radius
  against_tangent,     ///< a curve runs against a given tangent; the text says where
  chain_at_one_place,  ///< all nodes of a chain lie at one place: it stays, and its points do not count
  maybe_not_fairest,   ///< the shape is within the tolerance, but may not be the fairest
  noise_is_larger,     ///< the nodes seem to have more noise than the tolerance allows for
  far_from_nodes,      ///< removing noise moved nodes further than noise explains
  points_left_behind,  ///< points are much further from the shape than before
  outliers_changed,    ///< the set of outliers kept changing
  outliers_left,       ///< points that were kept seem to be outliers; the text says which
  normals_at_sharp_edges,  ///< given normals at nodes of sharp edges were left out, as each side has its own
  sharp_normals_kept,      ///< sides keep their tangent planes at sharp edges, as they would fold if they turned freely
  sharp_edges_rounded,     ///< sharp edges were not kept, as the surface without its noise would fold there
  normals_reversed,        ///< normals of points are opposite to the faces, and were reversed
  normals_ignored,         ///< normals of points fit the faces in neither sense, and were ignored
  unfilled_hole,           ///< no faces can fill a hole; the text says why
  unspanned_loop,          ///< no faces can span a loop of curves; the text says why
  loose_curve,             ///< a curve of a network ends freely and bounds nothing
  tangent_only,            ///< a shape does not meet the curvature of what is around it, or not everywhere
  patch_crosses,           ///< the patch of a hole, or the surface of a network, crosses other faces
  time_limit               ///< the time limit of the command line was reached; the shape is the best so far
};

/// "immovable-nodes", "free-boundary", "family-of-shapes" and so on.
[[nodiscard]] const char* name(WarningCode code) noexcept;

/// What a user should know of an input or a result, although it is no error.
struct Warning {
  // Not inline: g++ 12 would give false warnings about the memory of long texts.
  /// fault: what it is, and where. remedies: what to do; the text is with_advice(fault, remedies). Empty where the
  /// fault says it already.
  Warning(WarningCode about, const std::string& fault, std::vector<Advice> remedies = {});
  /// The text without its advice.
  [[nodiscard]] std::string fault() const;

  WarningCode code;            ///< for programs
  std::string text;            ///< for people, one line: what it is, where, and what to do
  std::vector<Advice> advice;  ///< what to do, for programs that have words of their own for it

  /// Whether all of it is the same.
  bool operator==(const Warning&) const = default;
};

}  // namespace vspring
