#include "holding.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/input_file.hpp"
#include "vspring/sharp_edges.hpp"
#include "vspring/topology.hpp"
#include "vspring/weld.hpp"

namespace vspring::cli {

namespace {

void fix_boundary_directions(Constraints& constraints, const PolygonMesh& mesh, const MeshEdges& sharp) {
  fix_boundary_normals(constraints, mesh, sharp);
}

void fix_boundary_directions(Constraints& constraints, const PolygonCurve& curve, const MeshEdges& /*sharp*/) {
  fix_boundary_tangents(constraints, curve);
}

/// Makes a faired boundary meet the boundary outside the region smoothly.
void restrict_boundary(Constraints& constraints, const PolygonMesh& mesh, const std::vector<Index>& region,
                       const FairingArguments& arguments) {
  const bool follows_points = arguments.fix == Hold::none && arguments.options.fair_boundary;
  if (arguments.fair_boundary || follows_points) restrict_to_region(constraints, boundary_curve(mesh), region);
}

/// The region with all nodes joined with its nodes; those without a face stay anyway.
std::vector<Index> whole_region(const std::vector<Index>& region, const Welded& welded) {
  const auto first = [&](std::size_t node) { return static_cast<std::size_t>(welded.representative[node]); };
  std::vector<std::uint8_t> inside(welded.representative.size(), 0);
  for (const Index node : region) inside[first(static_cast<std::size_t>(node))] = 1;
  std::vector<Index> whole;
  for (std::size_t node = 0; node < inside.size(); ++node) {
    if (inside[first(node)] != 0 || first(node) != node) whole.push_back(static_cast<Index>(node));
  }
  return whole;
}

void restrict_boundary(Constraints& /*constraints*/, const PolygonCurve& /*curve*/,
                       const std::vector<Index>& /*region*/, const FairingArguments& /*arguments*/) {}

/// Applies --constraints; returns what apply_rules() does.
template <typename Shape>
auto apply_file_of_rules(Constraints& constraints, const FairingArguments& arguments, const Shape& shape,
                         const RuleInput& input) {
  try {
    return apply_rules(constraints, shape, arguments.rule_text, input);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::unusable_constraint) throw;
    throw Error(error.code(), arguments.rules + ": " + error.fault(), {error.advice().begin(), error.advice().end()});
  }
}

/// Lets nodes slide as one --slide says.
template <typename Shape>
void slide_nodes(Constraints& constraints, const std::string& slide, const Shape& shape, const RuleInput& input) {
  const std::size_t equals = slide.rfind('=');
  if (equals == std::string::npos)
    throw Error(ErrorCode::invalid_argument,
                "--slide " + slide + ": write NODES=SUPPORT, such as boundary=plane:0,0,1,0,0,1");
  const std::string named = slide.substr(0, equals);
  const Support support = parse_support(slide.substr(equals + 1));
  std::vector<Index> nodes;
  if (named == "boundary") {
    const std::vector<std::uint8_t> boundary = boundary_nodes(shape);
    for (Index i = 0; i < shape.node_count(); ++i) {
      if (boundary[static_cast<std::size_t>(i)] != 0) nodes.push_back(i);
    }
  } else {
    for (const Index node : select_region(shape.positions(), parse_region(named), *input.groups))
      nodes.push_back(input.welded != nullptr ? input.welded->representative[static_cast<std::size_t>(node)] : node);
  }
  constraints.slide_on(nodes, support);
}

/// find_region: called if --region is given.
template <typename Shape>
Constraints constraints_of(const FairingArguments& arguments, const Shape& shape, const RuleInput& input,
                           const std::function<std::vector<Index>()>& find_region) {
  Constraints constraints(shape.node_count());
  if (arguments.fix == Hold::boundary && !arguments.fair_boundary) fix_boundary_positions(constraints, shape);
  if (arguments.fix_directions == Hold::boundary)
    fix_boundary_directions(constraints, shape, arguments.options.sharp_edges);
  for (const std::string& slide : arguments.slides) slide_nodes(constraints, slide, shape, input);
  if (!arguments.rules.empty()) apply_file_of_rules(constraints, arguments, shape, input);
  if (!arguments.region.empty()) {
    const std::vector<Index> region = find_region();
    restrict_boundary(constraints, shape, region, arguments);
    restrict_to_region(constraints, shape, region);
  }
  return constraints;
}

template <typename Shape>
Constraints constraints_of_symmetric(const FairingArguments& arguments, const Symmetric<Shape>& shape,
                                     RuleInput input) {
  input.named_nodes = shape.given.node_count();
  return constraints_of(arguments, shape.whole, input, [&] {
    std::vector<Index> region = region_of(arguments, shape.given.positions(), input);
    const std::size_t named = region.size();
    for (std::size_t k = 0; k < named; ++k) {
      const Index image = shape.partner[static_cast<std::size_t>(region[k])];
      if (image >= 0) region.push_back(image);
    }
    return region;
  });
}

}  // namespace

std::vector<Index> region_of(const FairingArguments& arguments, const std::vector<Vector3>& positions,
                             const RuleInput& input) {
  if (arguments.region.empty()) return {};
  const std::vector<Index> region = select_region(positions, parse_region(arguments.region), *input.groups);
  return input.welded != nullptr ? whole_region(region, *input.welded) : region;
}

void read_rules(FairingArguments& arguments) {
  if (!arguments.rules.empty()) arguments.rule_text = read_file(arguments.rules);
}

MeshEdges sharp_edges_of_rules(const FairingArguments& arguments, const PolygonMesh& mesh, const RuleInput& input) {
  if (arguments.rules.empty()) return {};
  Constraints unused(mesh.node_count());
  return apply_file_of_rules(unused, arguments, mesh, input);
}

Constraints make_constraints(const FairingArguments& arguments, const PolygonMesh& mesh, const RuleInput& input) {
  return constraints_of(arguments, mesh, input, [&] { return region_of(arguments, mesh.positions(), input); });
}

Constraints make_constraints(const FairingArguments& arguments, const PolygonCurve& curve, const RuleInput& input) {
  return constraints_of(arguments, curve, input, [&] { return region_of(arguments, curve.positions(), input); });
}

Constraints make_constraints(const FairingArguments& arguments, const Symmetric<PolygonMesh>& mesh,
                             const RuleInput& input) {
  return constraints_of_symmetric(arguments, mesh, input);
}

Constraints make_constraints(const FairingArguments& arguments, const Symmetric<PolygonCurve>& curve,
                             const RuleInput& input) {
  return constraints_of_symmetric(arguments, curve, input);
}

}  // namespace vspring::cli
