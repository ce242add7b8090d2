#include "sharp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/noise.hpp"
#include "vspring/weld.hpp"

namespace vspring::cli {

namespace {

// In median edges: smaller noise turns edges by about a degree at most.
constexpr double least_noise = 0.01;
// Chains of sharp edges: if so many are shorter on average, most are no creases.
constexpr std::size_t many_chains = 10;
constexpr std::size_t fewest_edges_of_crease = 2;

/// The noise to assume of a surface whose own nodes pull; 0: none.
double noise_at(const PolygonMesh& mesh, const PullArguments& pull, const Context& context) {
  if (pull.noise) return *pull.noise;
  const NoiseEstimate estimate = pull.estimate ? *pull.estimate : estimate_noise(mesh, context);
  return estimate.edges < least_noise || estimate.voxel ? 0 : estimate.deviation;
}

}  // namespace

NamedSharpEdges::NamedSharpEdges(const FairingArguments& arguments, const PullArguments& pull, const SurfaceFile& file,
                                 const Welding& welding, const MirroredShape<PolygonMesh>& mirrored)
    : takes_marks_(pull.sharp_marks) {
  const RuleInput input = welding.rules(file);
  by_rules_ = mirrored.sharp_edges_of_rules(arguments, input);
  if (!takes_marks_) return;
  MeshEdges marks = marked_edges(file);
  if (input.welded != nullptr) {
    const auto first = [&](Index node) { return input.welded->representative[static_cast<std::size_t>(node)]; };
    for (auto& [a, b] : marks) std::tie(a, b) = std::pair(first(a), first(b));
  }
  marked_ = mirrored.with_images(as_sharp_edges(mirrored.whole(), marks, left_out_).edges);
}

NamedSharpEdges::NamedSharpEdges(const FairingArguments& /*arguments*/, const PullArguments& pull,
                                 const CurveFile& /*file*/, const Welding& /*welding*/,
                                 const MirroredShape<PolygonCurve>& /*mirrored*/)
    : takes_marks_(pull.sharp_marks) {
  if (takes_marks_)
    throw Error(ErrorCode::invalid_argument,
                "--sharp marked is for surfaces; of a curve an angle finds corners, and rules name them");
}

void NamedSharpEdges::refine(const RefinedMesh& refined, const std::vector<Index>& node_of) {
  for (MeshEdges* const edges : {&marked_, &by_rules_}) {
    *edges = refined.parts_of(*edges);
    if (node_of.empty()) continue;
    for (auto& [a, b] : *edges) {
      a = node_of[static_cast<std::size_t>(a)];
      b = node_of[static_cast<std::size_t>(b)];
    }
  }
}

void NamedSharpEdges::remesh(const Remeshed& remeshed, const std::vector<Index>& node_of) {
  const auto marked = static_cast<Index>(marked_.size());
  const auto named = marked + static_cast<Index>(by_rules_.size());
  marked_.clear();
  by_rules_.clear();
  for (std::size_t k = 0; k < remeshed.lines.size(); ++k) {
    const Index from = remeshed.line_from[k];
    if (from >= named) continue;
    auto [a, b] = remeshed.lines[k];
    if (!node_of.empty()) {
      a = node_of[static_cast<std::size_t>(a)];
      b = node_of[static_cast<std::size_t>(b)];
    }
    (from < marked ? marked_ : by_rules_).emplace_back(a, b);
  }
}

std::vector<std::string> NamedSharpEdges::warnings() const {
  if (left_out_.empty()) return {};
  const LeftOutEdge& edge = left_out_.front();
  const std::size_t count = left_out_.size();
  return {fmt::format("{} marked edge{} cannot be sharp and {} left out, that from node {} to node {} first: {}", count,
                      count == 1 ? "" : "s", count == 1 ? "is" : "are", edge.first, edge.second, edge.why)};
}

SharpEdgesOfRun::SharpEdgesOfRun(const PolygonMesh& mesh, const NamedSharpEdges& named,
                                 const FairingArguments& arguments, const PullArguments& pull, bool own_nodes_pull,
                                 Context& context)
    : angle_(pull.sharp), fixes_normals_(arguments.fix_directions == Hold::boundary) {
  MeshEdges edges;
  if (angle_ > 0)
    edges = find_sharp_edges(mesh, angle_, own_nodes_pull ? noise_at(mesh, pull, context) : 0, context).edges;
  by_option_ = edges.size() + named.marked().size();
  edges.insert(edges.end(), named.marked().begin(), named.marked().end());
  edges.insert(edges.end(), named.by_rules().begin(), named.by_rules().end());
  sharp_ = as_sharp_edges(mesh, edges);
  if (!named.takes_marks() && named.by_rules().empty()) return;
  nlohmann::ordered_json left_out = nlohmann::ordered_json::array();
  for (const LeftOutEdge& edge : named.left_out()) left_out.push_back({edge.first, edge.second});
  of_named_ = {{"marked", as_sharp_edges(mesh, named.marked()).edges.size()},
               {"by_rules", as_sharp_edges(mesh, named.by_rules()).edges.size()},
               {"left_out", std::move(left_out)}};
}

SharpEdgesOfRun::SharpEdgesOfRun(const PolygonCurve& /*curve*/, const NamedSharpEdges& /*named*/,
                                 const FairingArguments& /*arguments*/, const PullArguments& /*pull*/,
                                 bool /*own_nodes_pull*/, Context& /*context*/) {}

FairOptions SharpEdgesOfRun::with_edges(FairOptions options) const {
  options.sharp_edges = sharp_.edges;
  options.fix_sharp_normals = fixes_normals_;
  return options;
}

void SharpEdgesOfRun::leave_out(const PolygonMesh& mesh, const MeshEdges& rounded) {
  MeshEdges left;
  std::ranges::set_difference(sharp_.edges, rounded, std::back_inserter(left));
  sharp_ = as_sharp_edges(mesh, left);
  rounded_ = rounded;
}

nlohmann::ordered_json SharpEdgesOfRun::figures() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (!(angle_ > 0) && of_named_.is_null()) return json;
  const std::vector<double> lengths = chain_lengths(sharp_.chains);
  nlohmann::ordered_json chains = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const auto& chain = sharp_.chains.chains()[k];
    chains.push_back({{"nodes", chain.nodes}, {"closed", chain.closed}, {"length", lengths[k]}});
  }
  nlohmann::ordered_json rounded = nlohmann::ordered_json::array();
  for (const auto& [first, second] : rounded_) rounded.push_back({first, second});
  json["sharp"] = {{"angle", angle_ > 0 ? nlohmann::ordered_json(angle_) : nlohmann::ordered_json()},
                   {"edges", sharp_.edges.size()},
                   {"rounded", std::move(rounded)},
                   {"corners", sharp_.corners},
                   {"chains", std::move(chains)}};
  if (!of_named_.is_null()) json["sharp"].update(of_named_);
  return json;
}

std::vector<std::string> SharpEdgesOfRun::warnings() const {
  const std::size_t chains = sharp_.chains.chains().size();
  if (!(angle_ > 0) || chains < many_chains || by_option_ >= fewest_edges_of_crease * chains) return {};
  return {
      fmt::format("the {} chains of sharp edges are {:.2g} edges long on average: bends of a coarse mesh, or noise, "
                  "rather than creases; a greater angle finds fewer, and vspring fair with --noise auto and --sharp "
                  "takes noise off first",
                  chains, static_cast<double>(by_option_) / static_cast<double>(chains))};
}

std::string SharpEdgesOfRun::lines() const {
  if (sharp_.edges.empty()) return {};
  const std::vector<double> lengths = chain_lengths(sharp_.chains);
  return fmt::format("sharp edges      {} in {} chain{} of {:.4g} units in all, {} corner{}\n", sharp_.edges.size(),
                     lengths.size(), lengths.size() == 1 ? "" : "s",
                     std::accumulate(lengths.begin(), lengths.end(), 0.0), sharp_.corners.size(),
                     sharp_.corners.size() == 1 ? "" : "s");
}

}  // namespace vspring::cli
