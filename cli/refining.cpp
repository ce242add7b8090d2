#include "refining.hpp"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/weld.hpp"

namespace vspring::cli {

namespace {

/// Per node of the refined file the node of the refined welded mesh that it is: new nodes side by side are the same.
std::vector<Index> joined_nodes(const RefinedMesh& file, const RefinedMesh& welded) {
  std::vector<Index> number(static_cast<std::size_t>(welded.input_node_count()), -1);
  const std::vector<Index> of_welded = welded.numbers_in_means();
  for (Index node = 0; node < welded.kept_node_count(); ++node)
    number[static_cast<std::size_t>(of_welded[static_cast<std::size_t>(node)])] = node;
  std::vector<Index> joined(static_cast<std::size_t>(file.mesh.node_count()), -1);
  const std::vector<Index> of_file = file.numbers_in_means();
  for (Index node = 0; node < file.kept_node_count(); ++node)
    joined[static_cast<std::size_t>(node)] = number[static_cast<std::size_t>(of_file[static_cast<std::size_t>(node)])];
  for (Index f = 0; f < file.mesh.face_count(); ++f) {
    const auto own = file.mesh.face(f);
    const auto face = welded.mesh.face(f);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (own[k] >= file.kept_node_count()) joined[static_cast<std::size_t>(own[k])] = face[k];
    }
  }
  return joined;
}

/// The lines of a remeshed shape: sharp edges, those that are named first.
MeshEdges lines_of(const NamedSharpEdges& named, const MeshEdges& sharp) {
  MeshEdges lines = named.marked();
  lines.insert(lines.end(), named.by_rules().begin(), named.by_rules().end());
  lines.insert(lines.end(), sharp.begin(), sharp.end());
  return lines;
}

}  // namespace

Refining::Refining(const FairingArguments& arguments, SurfaceFile& file, Welding& welding, Constraints& constraints,
                   NamedSharpEdges& sharp)
    : how_(arguments.refine), remesh_(arguments.remesh) {
  if (!how_ && !remesh_) return;
  if (!arguments.symmetry.empty())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} cannot be given with --symmetry: {} the shape in one run, and give --symmetry in the "
                            "next",
                            how_ ? "--refine" : "--remesh", how_ ? "refine" : "remesh"));
  if (how_) {
    Refined refined = refine(welding.shape(file), constraints, *how_);
    is_idle_ = refined.new_node_count() == 0;
    take(file, welding, constraints, sharp, refined, nullptr);
    return;
  }
  remesh_->lines = lines_of(sharp, arguments.options.sharp_edges);
  const Remeshed remeshed = remesh(welding.shape(file), constraints, *remesh_);
  remesh_->length = remeshed.length;
  is_idle_ =
      remeshed.new_node_count() == 0 && remeshed.removed.empty() && remeshed.mesh.has_same_faces(welding.shape(file));
  take(file, welding, constraints, sharp, remeshed, &remeshed);
}

void Refining::take(SurfaceFile& file, Welding& welding, Constraints& constraints, NamedSharpEdges& sharp,
                    const Refined& refined, const Remeshed* remeshed) {
  new_nodes_ = refined.new_node_count();
  removed_nodes_ = static_cast<Index>(refined.removed.size());
  boundary_reach_ = refined.boundary_reach;
  new_faces_ = refined.mesh.face_count() - file.mesh.face_count();
  if (is_idle_) return;
  const auto take_sharp = [&](const std::vector<Index>& node_of) {
    if (remeshed != nullptr)
      sharp.remesh(*remeshed, node_of);
    else
      sharp.refine(refined, node_of);
  };
  const Welded* const welded = welding.rules(file).welded;
  if (welded == nullptr) {
    file = refined_file(file, refined);
    take_sharp({});
    constraints = refined.constraints;
    return;
  }
  const RefinedMesh of_file = welded->unwelded(file.mesh, refined);
  const std::vector<Index> joined = joined_nodes(of_file, refined);
  file = refined_file(file, of_file);
  take_sharp(welding.refine(file, of_file, refined, joined));
  constraints = Constraints(file.mesh.node_count());
  for (Index node = 0; node < file.mesh.node_count(); ++node)
    constraints.hold_as(node, refined.constraints, joined[static_cast<std::size_t>(node)]);
}

Refining::Refining(const FairingArguments& arguments, const CurveFile& /*file*/, Welding& /*welding*/,
                   Constraints& /*constraints*/, NamedSharpEdges& /*sharp*/) {
  if (arguments.refine || arguments.remesh)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} is for surfaces; vspring curve --spacing puts nodes along a curve",
                            arguments.refine ? "--refine" : "--remesh"));
}

nlohmann::ordered_json Refining::figures() const {
  nlohmann::ordered_json figures = nlohmann::ordered_json::object();
  if (how_) {
    figures["refine"] = {{"length", nullptr}, {"turn", nullptr}, {"new_nodes", new_nodes_}, {"new_faces", new_faces_}};
    if (how_->length) figures["refine"]["length"] = *how_->length;
    if (how_->turn) figures["refine"]["turn"] = *how_->turn;
  }
  if (remesh_)
    figures["remesh"] = {{"length", *remesh_->length},
                         {"new_nodes", new_nodes_},
                         {"removed_nodes", removed_nodes_},
                         {"new_faces", new_faces_}};
  return figures;
}

std::string Refining::lines() const {
  if (how_) return fmt::format("refined          with {} more nodes and {} more faces\n", new_nodes_, new_faces_);
  if (!remesh_) return {};
  return fmt::format("remeshed         to edges of about {:.4g} units: {} new nodes for {}, {} {} faces\n",
                     *remesh_->length, new_nodes_, removed_nodes_, std::abs(new_faces_),
                     new_faces_ < 0 ? "fewer" : "more");
}

}  // namespace vspring::cli
