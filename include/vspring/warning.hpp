#pragma once

#include <cstdint>
#include <string>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// What a warning is about.
enum class WarningCode : std::uint8_t {
  immovable_nodes,     ///< nodes that cannot move are held: at edges of more than two faces (of four or more with all
                       ///< nodes of these), where several fans meet
  free_boundary,       ///< boundary nodes are free and are drawn in
  untold_boundary,     ///< boundary nodes are free, and no points are near enough to tell where they should be
  family_of_shapes,    ///< what holds the shape leaves more than one sphere, plane or circle
  other_springs,       ///< edge springs took the place of sphere springs
  other_fairness,      ///< no shape was found that is fair as asked for: by curvature, this is of least bending
  other_distribution,  ///< nodes went to the mean of their neighbours
  no_equilibrium,      ///< none was found; the text says what the shape is
  worse_than_input,    ///< what was found is; the text says how, and what is returned
  steps_grew,          ///< the paper's iteration did not come to rest
  level_cut_short,     ///< a coarser level of a V-cycle ended at its limit of iterations
  outside_tolerance,   ///< no shape within the tolerance was found: this one is the nearest
  radius_not_kept,     ///< the shape is bent more somewhere than by the least radius
  maybe_not_fairest,   ///< the shape is within the tolerance, but may not be the fairest
  noise_is_larger,     ///< the nodes' noise seems to be larger than the tolerance allows for
  far_from_nodes,      ///< taking noise off moved nodes further than noise explains
  points_left_behind,  ///< points are much further from the shape than before
  outliers_changed,    ///< which points are outliers went on changing
  outliers_left,       ///< points that count seem to be off; the text says which
  normals_reversed,    ///< normals of points are against the faces, and were taken the other way round
  unfilled_hole,       ///< no faces can fill a hole; the text says why
  patch_crosses,       ///< the patch of a hole crosses other faces, such as of another part within the hole
  time_limit           ///< the command line's; the shape is the best so far
};

/// "immovable-nodes", "free-boundary", "family-of-shapes" and so on.
[[nodiscard]] const char* name(WarningCode code) noexcept;

struct Warning {
  // Not inline: g++ 12 then warns of memory of long texts that nobody touches.
  Warning(WarningCode about, std::string words);

  WarningCode code;
  std::string text;  ///< for people, one line: what it is, where, and what to do

  bool operator==(const Warning&) const = default;
};

}  // namespace vspring
