#pragma once

#include <vector>

#include "fairing_arguments.hpp"
#include "vspring/rules.hpp"
#include "vspring/symmetry.hpp"

namespace vspring::cli {

/// Reads the file of --constraints, if there is one: once, as it may be a pipe.
void read_rules(FairingArguments& arguments);

/// The sharp edges that rules name. input: as for apply_rules(). Throws what make_constraints() throws for rules.
[[nodiscard]] MeshEdges sharp_edges_of_rules(const FairingArguments& arguments, const PolygonMesh& mesh,
                                             const RuleInput& input);

/// The nodes of --region; empty if it is not given. Throws Error(unusable_constraint) if no node lies in it.
/// input.groups must not be null.
[[nodiscard]] std::vector<Index> region_of(const FairingArguments& arguments, const std::vector<Vector3>& positions,
                                           const RuleInput& input);

/// Applies --fix, --fix-normals, --slide, --constraints and --region, in this order. input.groups must not be null.
/// After read_rules().
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh,
                                           const RuleInput& input);
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve,
                                           const RuleInput& input);

/// Those of the whole of a symmetric shape. Rules, regions and groups name nodes of the given shape; in the region are
/// their mirror images, too.
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const Symmetric<PolygonMesh>& mesh,
                                           const RuleInput& input);
[[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const Symmetric<PolygonCurve>& curve,
                                           const RuleInput& input);

}  // namespace vspring::cli
