#include "refining.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <utility>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/weld.hpp"

namespace vspring::cli {

namespace {

/// Per node of the refined file the node of the refined welded mesh that it is: new nodes side by side are the same.
std::vector<Index> joined_nodes(const RefinedMesh& file, const RefinedMesh& welded) {
  std::vector<Index> joined(static_cast<std::size_t>(file.mesh.node_count()), -1);
  for (Index node = 0; node < file.input_node_count(); ++node) joined[static_cast<std::size_t>(node)] = node;
  for (Index f = 0; f < file.mesh.face_count(); ++f) {
    const auto own = file.mesh.face(f);
    const auto of_welded = welded.mesh.face(f);
    for (std::size_t k = 0; k < own.size(); ++k) {
      if (own[k] >= file.input_node_count()) joined[static_cast<std::size_t>(own[k])] = of_welded[k];
    }
  }
  return joined;
}

}  // namespace

Refining::Refining(const FairingArguments& arguments, SurfaceFile& file, Welding& welding, Constraints& constraints,
                   NamedSharpEdges& sharp)
    : how_(arguments.refine) {
  if (!how_) return;
  if (!arguments.symmetry.empty())
    throw Error(
        ErrorCode::invalid_argument,
        "--refine cannot be given with --symmetry: refine the shape in one run, and give --symmetry in the next");
  Refined refined = refine(welding.shape(file), constraints, *how_);
  new_nodes_ = refined.new_node_count();
  boundary_reach_ = refined.boundary_reach;
  new_faces_ = refined.mesh.face_count() - file.mesh.face_count();
  if (new_nodes_ == 0) return;
  const Welded* const welded = welding.rules(file).welded;
  if (welded == nullptr) {
    file = refined_file(file, refined);
    sharp.refine(refined, {});
    constraints = std::move(refined.constraints);
    return;
  }
  const RefinedMesh of_file = welded->unwelded(file.mesh, refined);
  const std::vector<Index> joined = joined_nodes(of_file, refined);
  file = refined_file(file, of_file);
  sharp.refine(refined, welding.refine(file, refined, joined));
  constraints = Constraints(file.mesh.node_count());
  for (Index node = 0; node < file.mesh.node_count(); ++node)
    constraints.hold_as(node, refined.constraints, joined[static_cast<std::size_t>(node)]);
}

Refining::Refining(const FairingArguments& arguments, const CurveFile& /*file*/, Welding& /*welding*/,
                   Constraints& /*constraints*/, NamedSharpEdges& /*sharp*/) {
  if (arguments.refine)
    throw Error(ErrorCode::invalid_argument,
                "--refine is for surfaces; vspring curve --spacing puts nodes along a curve");
}

nlohmann::ordered_json Refining::figures() const {
  if (!how_) return nlohmann::ordered_json::object();
  nlohmann::ordered_json figures = {
      {"length", nullptr}, {"turn", nullptr}, {"new_nodes", new_nodes_}, {"new_faces", new_faces_}};
  if (how_->length) figures["length"] = *how_->length;
  if (how_->turn) figures["turn"] = *how_->turn;
  return {{"refine", std::move(figures)}};
}

std::string Refining::lines() const {
  if (!how_) return {};
  return fmt::format("refined          with {} more nodes and {} more faces\n", new_nodes_, new_faces_);
}

}  // namespace vspring::cli
