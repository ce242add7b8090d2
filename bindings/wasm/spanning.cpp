#include "spanning.hpp"

#include <string>
#include <vector>

namespace vspring {

namespace {

val to_val(const NetworkCurve& curve) {
  val result = val::object();
  result.set("from", int_array(curve.from));
  result.set("nodes", int_array(curve.nodes));
  result.set("length", curve.length);
  result.set("sharp", curve.is_sharp);
  result.set("loops", curve.loops);
  return result;
}

val to_val(const NetworkLoop& loop) {
  val result = val::object();
  result.set("curves", int_array(loop.curves));
  result.set("junctions", int_array(loop.junctions));
  result.set("length", loop.length);
  result.set("turn", loop.turn);
  result.set("state", std::string(name(loop.state)));
  result.set("grid", loop.is_grid);
  result.set("firstNode", loop.first_node);
  result.set("nodeCount", loop.node_count);
  result.set("firstFace", loop.first_face);
  result.set("faceCount", loop.face_count);
  return result;
}

}  // namespace

SpanOptions span_options_of(const val& settings) {
  check_names(settings, {"length", "join", "fairCurves", "sharp", "symmetry", "loops", "also", "without", "flat"});
  SpanOptions options;
  if (const val length = settings["length"]; is_given(length)) options.edge_length = length.as<double>();
  if (const val join = settings["join"]; is_given(join)) options.join = join.as<double>();
  if (const val plane = settings["symmetry"]; is_given(plane)) options.symmetry = parse_plane(plane.as<std::string>());
  options.fair_curves = settings["fairCurves"].isTrue();
  options.flat = settings["flat"].isTrue();
  options.sharp = numbers_of(settings["sharp"]);
  options.loops = numbers_of(settings["loops"]);
  options.also = numbers_of(settings["also"]);
  options.without = numbers_of(settings["without"]);
  return options;
}

val to_val(const SpannedCurves& spanned) {
  val result = to_val(spanned.report);
  result.set("usable", spanned.usable());
  val curves = val::array();
  for (const NetworkCurve& curve : spanned.curves) curves.call<void>("push", to_val(curve));
  result.set("curves", curves);
  val loops = val::array();
  for (const NetworkLoop& loop : spanned.loops) loops.call<void>("push", to_val(loop));
  result.set("loops", loops);
  std::vector<Index> held;
  for (Index node = 0; node < spanned.constraints.node_count(); ++node) {
    if (spanned.constraints.position_fixed(node)) held.push_back(node);
  }
  result.set("held", int_array(held));
  result.set("heldNormals", held_normals(spanned.constraints));
  result.set("sharpEdges", edges_array(spanned.sharp_edges));
  result.set("surface", bytes_array(surface_bytes("span.obj", file_of(spanned), spanned.positions)));
  return result;
}

}  // namespace vspring
