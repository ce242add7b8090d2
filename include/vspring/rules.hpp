#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/export.hpp"
#include "vspring/region.hpp"

namespace VSPRING_API vspring {

struct Welded;

/// Parses the specification of a region, which becomes its name: `sphere:x,y,z,r`, `box:x0,y0,z0,x1,y1,z1`,
/// `group:NAME`, or the path of a JSON file with a list of node numbers, which is read here. Throws
/// Error(unusable_constraint) for a malformed one, and Error(unusable_file) for a file that cannot be read. Cost:
/// linear in the file.
[[nodiscard]] Region parse_region(std::string_view specification);

/// Parses what nodes are to slide on: `plane:px,py,pz,nx,ny,nz` by a point and a normal, `line:px,py,pz,dx,dy,dz` by a
/// point and a direction, `cylinder:px,py,pz,dx,dy,dz,r` by a point and the direction of its axis and a radius, or
/// `circle:cx,cy,cz,nx,ny,nz,r` by a centre, the normal of its plane and a radius. Throws Error(unusable_constraint)
/// for anything else, and what Support throws. Cost: linear in the text.
[[nodiscard]] Support parse_support(std::string_view specification);

/// What rules may refer to besides the mesh.
struct RuleInput {
  const Groups* groups = nullptr;                 ///< for {"group": NAME}
  const std::vector<Vector3>* normals = nullptr;  ///< the file's normals, for "normal": "file"
  const Welded* welded = nullptr;                 ///< set if the mesh is that of weld()
  /// Rules name only the first so many nodes, such as those of a half whose mirror image follows, see find_symmetry();
  /// empty: all.
  std::optional<Index> named_nodes = std::nullopt;
};

/// Applies rules from a JSON text in order; a later rule overrides an earlier one:
///   {"rules": [{"nodes": SELECTION, "position": P, "slide": T, "normal": N, "sharp": S}, …]}
/// SELECTION: "all", "boundary", "interior", "non-manifold", {"group": NAME}, {"region": SPECIFICATION}, or a list of
/// node numbers. P: "fixed" (as in the mesh), "free", [x, y, z], or a list of those, one per node in the order of the
/// selection. T, in place of P: what the nodes slide on (see Support), or a list of those, one per node: {"plane":
/// {"point": [x, y, z], "normal": [x, y, z]}}, {"line": {"point": …, "direction": …}}, {"cylinder": {"point": …,
/// "direction": …, "radius": R}}, {"circle": {"centre": …, "normal": …, "radius": R}}, {"polyline": {"points": [[x, y,
/// z], …], "closed": false}}. N: "fixed" (estimate_normals()), "file" (the file's normals), "free", [x, y, z], or a
/// list, node by node.
/// S: true for the edges between any two of the nodes, except those of which both faces have such nodes only, so that a
/// row of nodes names its edges and a group its rim; or "path" for the edges from each node of a list to the next.
///
/// On a welded surface, rules use the numbers before welding and apply to all nodes joined with the named ones. If
/// rules that name joined nodes (or their groups or regions) contradict each other, they are refused.
///
/// Returns the sharp edges, for FairOptions::sharp_edges; an edge may be there twice.
///
/// Throws Error(unusable_constraint) naming the rule, and line or nodes where it can; constraints are then unchanged.
/// So it does for a sharp edge that the mesh has not, or of other than two faces, in a "path", and where there is none
/// for true. Cost: linear in the mesh, once, and in the nodes named; n log n for each rule of sharp edges.
MeshEdges apply_rules(Constraints& constraints, const PolygonMesh& mesh, std::string_view json,
                      const RuleInput& input = {});

/// Applies such rules to a curve. "boundary" means the ends of its chains. A rule may also have "tangent": "fixed"
/// (estimate_tangents()), "free", [x, y, z] or a list; or else "corner": true or false, and "tangent_in" and
/// "tangent_out", the tangents before and after a node, either of which makes it a corner. Vectors may have two numbers
/// instead of three. Throws and costs what apply_rules() of a mesh does.
void apply_rules(Constraints& constraints, const PolygonCurve& curve, std::string_view json,
                 const RuleInput& input = {});

}  // namespace vspring
