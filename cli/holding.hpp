#pragma once

#include "fairing_arguments.hpp"
#include "vspring/rules.hpp"

namespace vspring::cli {

/// Applies --fix, --fix-normals, --constraints and --region, in this order. input.groups must not be null.
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh,
                                           const RuleInput& input);
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve,
                                           const RuleInput& input);

}  // namespace vspring::cli
