#include "sharp.hpp"

#include <fmt/format.h>

#include <cstddef>
#include <numeric>
#include <vector>

#include "vspring/noise.hpp"

namespace vspring::cli {

namespace {

// In median edges: less turns no edge by more than a degree or so.
constexpr double least_noise = 0.01;

/// What is to be taken for noise of a surface whose own nodes pull; 0 if nothing is.
double noise_at(const PolygonMesh& mesh, const PullArguments& pull, const Context& context) {
  if (pull.noise) return *pull.noise;
  const NoiseEstimate estimate = pull.estimate ? *pull.estimate : estimate_noise(mesh, context);
  return estimate.edges < least_noise || estimate.voxel ? 0 : estimate.deviation;
}

}  // namespace

FoundSharpEdges::FoundSharpEdges(const PolygonMesh& mesh, const FairingArguments& arguments, const PullArguments& pull,
                                 bool own_nodes_pull, Context& context)
    : angle_(pull.sharp), fixes_normals_(arguments.fix_directions == Hold::boundary) {
  if (angle_ > 0) sharp_ = find_sharp_edges(mesh, angle_, own_nodes_pull ? noise_at(mesh, pull, context) : 0, context);
}

FoundSharpEdges::FoundSharpEdges(const PolygonCurve& /*curve*/, const FairingArguments& /*arguments*/,
                                 const PullArguments& /*pull*/, bool /*own_nodes_pull*/, Context& /*context*/) {}

FairOptions FoundSharpEdges::with_edges(FairOptions options) const {
  options.sharp_edges = sharp_.edges;
  options.fix_sharp_normals = fixes_normals_;
  return options;
}

nlohmann::ordered_json FoundSharpEdges::figures() const {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  if (!(angle_ > 0)) return json;
  const std::vector<double> lengths = chain_lengths(sharp_.chains);
  nlohmann::ordered_json chains = nlohmann::ordered_json::array();
  for (std::size_t k = 0; k < lengths.size(); ++k) {
    const auto& chain = sharp_.chains.chains()[k];
    chains.push_back({{"nodes", chain.nodes}, {"closed", chain.closed}, {"length", lengths[k]}});
  }
  json["sharp"] = {
      {"angle", angle_}, {"edges", sharp_.edges.size()}, {"corners", sharp_.corners}, {"chains", std::move(chains)}};
  return json;
}

std::string FoundSharpEdges::lines() const {
  if (sharp_.edges.empty()) return {};
  const std::vector<double> lengths = chain_lengths(sharp_.chains);
  return fmt::format("sharp edges      {} in {} chain{} of {:.4g} units in all, {} corner{}\n", sharp_.edges.size(),
                     lengths.size(), lengths.size() == 1 ? "" : "s",
                     std::accumulate(lengths.begin(), lengths.end(), 0.0), sharp_.corners.size(),
                     sharp_.corners.size() == 1 ? "" : "s");
}

}  // namespace vspring::cli
