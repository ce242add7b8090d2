#include "filling.hpp"

#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace vspring {

namespace {

val to_val(const Hole& hole) {
  val result = val::object();
  result.set("rim", int_array(hole.rim));
  result.set("length", hole.length);
  result.set("state", std::string(name(hole.state)));
  result.set("fault", fault_message(hole));
  result.set("firstNode", hole.first_node);
  result.set("nodeCount", hole.node_count);
  result.set("firstFace", hole.first_face);
  result.set("faceCount", hole.face_count);
  result.set("outcome", hole.outcome ? val(std::string(name(*hole.outcome))) : val::null());
  return result;
}

/// Throws Error(invalid_argument) unless these are numbers of `most` elements of the file.
void check_like(const std::vector<Index>& like, Index most, const char* what) {
  for (const Index number : like) {
    if (number < 0 || number >= most)
      throw Error(ErrorCode::invalid_argument, std::string("a patch is like ") + what + " " + std::to_string(number) +
                                                   ", but the file has " + std::to_string(most) + " of them");
  }
}

}  // namespace

FillOptions fill_options_of(const val& settings) {
  check_names(settings, {"at", "outerRims", "maxSize", "maxEdges", "flat"});
  FillOptions options;
  if (const val at = settings["at"]; is_given(at)) {
    options.at = numbers_of(at);
    if (options.at.empty())
      throw Error(ErrorCode::invalid_argument, "at: no node is named; leave it out to fill all holes");
  }
  options.outer_rims = settings["outerRims"].isTrue();
  options.flat = settings["flat"].isTrue();
  if (const val size = settings["maxSize"]; is_given(size)) options.most_length = size.as<double>();
  if (const val edges = settings["maxEdges"]; is_given(edges)) options.most_edges = edges.as<Index>();
  return options;
}

val to_val(const FilledHoles& filled) {
  val result = to_val(filled.report);
  result.set("usable", filled.usable());
  val holes = val::array();
  for (const Hole& hole : filled.holes) holes.call<void>("push", to_val(hole));
  result.set("holes", holes);
  return result;
}

val patches_of(const SurfaceFile& file) {
  const auto& [node_like, face_like, groups] = file.added;
  const PolygonMesh& mesh = file.mesh;
  const auto first_face = mesh.face_count() - static_cast<Index>(face_like.size());
  const std::vector<Vector3> positions(mesh.positions().end() - static_cast<std::ptrdiff_t>(node_like.size()),
                                       mesh.positions().end());
  const std::vector<Index> corners(mesh.corners().begin() + mesh.face_begin(first_face), mesh.corners().end());
  std::vector<Index> begin;
  std::vector<std::string> names;
  for (const auto& [face, name] : groups) {
    begin.push_back(face);
    names.push_back(name);
  }
  val result = val::object();
  result.set("positions", positions_array(positions));
  result.set("corners", int_array(corners));
  result.set("nodeLike", int_array(node_like));
  result.set("faceLike", int_array(face_like));
  result.set("groupBegin", int_array(begin));
  result.set("groupNames", list_of(names));
  return result;
}

void set_patches(SurfaceFile& file, const val& patches) {
  const PolygonMesh& mesh = file.mesh;
  const auto nodes = mesh.node_count() - static_cast<Index>(file.added.node_like.size());
  const auto faces = mesh.face_count() - static_cast<Index>(file.added.face_like.size());
  std::vector<Vector3> positions(mesh.positions().begin(), mesh.positions().begin() + nodes);
  std::vector<Index> corners(mesh.corners().begin(), mesh.corners().begin() + mesh.face_begin(faces));
  std::vector<Index> face_begin = mesh.face_begin();
  face_begin.resize(static_cast<std::size_t>(faces) + 1);
  AddedElements added;
  if (is_given(patches)) {
    added.node_like = numbers_of(patches["nodeLike"]);
    added.face_like = numbers_of(patches["faceLike"]);
    check_like(added.node_like, nodes, "node");
    check_like(added.face_like, faces, "face");
    const std::vector<Vector3> places = vectors_of(patches["positions"]);
    const std::vector<Index> sides = numbers_of(patches["corners"]);
    if (places.size() != added.node_like.size() || sides.size() != 3 * added.face_like.size())
      throw Error(ErrorCode::invalid_argument, "patches have " + std::to_string(places.size()) + " positions and " +
                                                   std::to_string(sides.size()) + " corners, but " +
                                                   std::to_string(added.node_like.size()) + " nodes and " +
                                                   std::to_string(added.face_like.size()) + " triangles");
    positions.insert(positions.end(), places.begin(), places.end());
    corners.insert(corners.end(), sides.begin(), sides.end());
    for (std::size_t f = 0; f < added.face_like.size(); ++f) face_begin.push_back(face_begin.back() + 3);
    Index least = faces;
    for (const Index begin : numbers_of(patches["groupBegin"])) {
      if (begin < least || begin >= faces + static_cast<Index>(added.face_like.size()))
        throw Error(ErrorCode::invalid_argument, "a group of patches begins at face " + std::to_string(begin) +
                                                     ", but has to at " + std::to_string(least) +
                                                     " or a later new one");
      least = begin;
      added.groups.emplace_back(begin, patches["groupNames"][added.groups.size()].as<std::string>());
    }
  }
  file.mesh = PolygonMesh(std::move(positions), std::move(face_begin), std::move(corners));
  file.added = std::move(added);
}

}  // namespace vspring
