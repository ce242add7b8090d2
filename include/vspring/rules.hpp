#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/export.hpp"
#include "vspring/region.hpp"

namespace VSPRING_API vspring {

struct Welded;

/// The region that a specification names, and is named by: `sphere:x,y,z,r` or `box:x0,y0,z0,x1,y1,z1`, `group:NAME`,
/// or the path of a JSON file with a list of node numbers, which is read here. Throws Error(unusable_constraint) for a
/// malformed one, and Error(unusable_file) for a file that cannot be read. Cost: linear in the file.
[[nodiscard]] Region parse_region(std::string_view specification);

/// What rules may refer to besides the mesh.
struct RuleInput {
  const Groups* groups = nullptr;                 ///< for {"group": NAME}
  const std::vector<Vector3>* normals = nullptr;  ///< the file's own, for "normal": "file"
  const Welded* welded = nullptr;                 ///< of a surface whose mesh is that of weld()
};

/// Applies rules from a JSON text, in order, the later one winning:
///   {"rules": [{"nodes": SELECTION, "position": P, "normal": N}, …]}
/// SELECTION: "all", "boundary", "interior", "non-manifold", {"group": NAME}, {"region": SPECIFICATION}, or a list of
/// node numbers. P: "fixed" (as in the mesh), "free", [x, y, z], or a list of those, one per node in the order of the
/// selection. N: "fixed" (estimate_normals()), "file" (the file's own), "free", [x, y, z] or a list, node by node.
///
/// On a welded surface, rules use the numbers before welding and apply to all nodes joined with those. Joined nodes
/// that are told different things by one rule, or by several that name them (or their groups or regions), are refused.
///
/// Throws Error(unusable_constraint) naming the rule, and line or nodes where it can; constraints are then unchanged.
/// Cost: linear in the mesh, once, and in the nodes named.
void apply_rules(Constraints& constraints, const PolygonMesh& mesh, std::string_view json, const RuleInput& input = {});

/// The same for a curve. "boundary" are the ends of its chains. Rules may also have "tangent": "fixed"
/// (estimate_tangents()), "free", [x, y, z] or a list. Or else "corner": true or false, and "tangent_in" and
/// "tangent_out", as "tangent" of the sides before and after a node, which is a corner with either. Vectors may have
/// two numbers instead of three.
void apply_rules(Constraints& constraints, const PolygonCurve& curve, std::string_view json,
                 const RuleInput& input = {});

}  // namespace vspring
