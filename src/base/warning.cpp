#include "vspring/warning.hpp"

#include <utility>

namespace vspring {

Warning::Warning(WarningCode about, const std::string& fault, std::vector<Advice> remedies)
    : code(about), text(with_advice(fault, remedies)), advice(std::move(remedies)) {}

std::string Warning::fault() const { return text.substr(0, text.size() - with_advice("", advice).size()); }

const char* name(WarningCode code) noexcept {
  switch (code) {
    case WarningCode::immovable_nodes:
      return "immovable-nodes";
    case WarningCode::free_boundary:
      return "free-boundary";
    case WarningCode::untold_boundary:
      return "untold-boundary";
    case WarningCode::family_of_shapes:
      return "family-of-shapes";
    case WarningCode::only_ends_held:
      return "only-ends-held";
    case WarningCode::other_springs:
      return "other-springs";
    case WarningCode::other_fairness:
      return "other-fairness";
    case WarningCode::smoothed_less:
      return "smoothed-less";
    case WarningCode::other_distribution:
      return "other-distribution";
    case WarningCode::no_equilibrium:
      return "no-equilibrium";
    case WarningCode::worse_than_input:
      return "worse-than-input";
    case WarningCode::steps_grew:
      return "steps-grew";
    case WarningCode::level_cut_short:
      return "level-cut-short";
    case WarningCode::outside_tolerance:
      return "outside-tolerance";
    case WarningCode::points_at_held:
      return "points-at-held";
    case WarningCode::radius_not_kept:
      return "radius-not-kept";
    case WarningCode::against_tangent:
      return "against-tangent";
    case WarningCode::chain_at_one_place:
      return "chain-at-one-place";
    case WarningCode::maybe_not_fairest:
      return "maybe-not-fairest";
    case WarningCode::noise_is_larger:
      return "noise-is-larger";
    case WarningCode::far_from_nodes:
      return "far-from-nodes";
    case WarningCode::points_left_behind:
      return "points-left-behind";
    case WarningCode::outliers_changed:
      return "outliers-changed";
    case WarningCode::outliers_left:
      return "outliers-left";
    case WarningCode::normals_at_sharp_edges:
      return "normals-at-sharp-edges";
    case WarningCode::sharp_normals_kept:
      return "sharp-normals-kept";
    case WarningCode::sharp_edges_rounded:
      return "sharp-edges-rounded";
    case WarningCode::normals_reversed:
      return "normals-reversed";
    case WarningCode::normals_ignored:
      return "normals-ignored";
    case WarningCode::unfilled_hole:
      return "unfilled-hole";
    case WarningCode::unspanned_loop:
      return "unspanned-loop";
    case WarningCode::loose_curve:
      return "loose-curve";
    case WarningCode::tangent_only:
      return "tangent-only";
    case WarningCode::patch_crosses:
      return "patch-crosses";
    case WarningCode::time_limit:
      return "time-limit";
  }
  return "";
}

}  // namespace vspring
