#include <fmt/format.h>

#include <algorithm>

#include "base/cancellation.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "fill/filling.hpp"
#include "fill/patch_fairing.hpp"
#include "fill/rim.hpp"
#include "vspring/error.hpp"
#include "vspring/fill.hpp"

namespace vspring {

namespace {

// The share of the first fairing of patches in all, for progress.
constexpr double first_share = 0.6;

/// Per node, whether FillOptions::at names it.
std::vector<std::uint8_t> asked_for(const FillOptions& options, const std::vector<Hole>& holes, Index node_count) {
  std::vector<std::uint8_t> at_hole(static_cast<std::size_t>(node_count), 0);
  for (const Hole& hole : holes) {
    for (const Index node : hole.rim) at_hole[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<std::uint8_t> asked(at_hole.size(), 0);
  for (const Index node : options.at) {
    if (node < 0 || node >= node_count)
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("{} is not a node; nodes go from 0 to {}", node, node_count - 1));
    if (at_hole[static_cast<std::size_t>(node)] == 0)
      throw Error(
          ErrorCode::unusable_constraint,
          fmt::format("node {} is at no hole: all its edges belong to two faces; give a node of a boundary", node));
    asked[static_cast<std::size_t>(node)] = 1;
  }
  return asked;
}

/// The state of a hole that can be filled: whether it will be, or why it is left open.
HoleState state_to_be(const Hole& hole, const FillOptions& options, const std::vector<std::uint8_t>& asked) {
  const bool is_asked = std::any_of(hole.rim.begin(), hole.rim.end(),
                                    [&](Index node) { return asked[static_cast<std::size_t>(node)] != 0; });
  if (!options.at.empty() && !is_asked) return HoleState::elsewhere;
  if (!is_asked && !options.outer_rims && hole.is_outer_rim()) return HoleState::outer_rim;
  const bool is_large =
      hole.length > options.most_length || hole.rim.size() > static_cast<std::size_t>(options.most_edges);
  return is_large ? HoleState::too_large : hole.state;
}

void fill_all(Filling& filling, const FillOptions& options, ProgressReporter& progress) {
  std::vector<Hole>& holes = filling.holes();
  const auto asked = asked_for(options, holes, filling.input().node_count());
  for (Hole& hole : holes) hole.state = state_to_be(hole, options, asked);
  try {
    for (std::size_t h = 0; h < holes.size(); ++h) {
      if (holes[h].state != HoleState::open) continue;
      progress.report("triangulating", 0);
      filling.fill(h);
    }
  } catch (const Cancelled&) {
    for (Hole& hole : holes) {
      if (hole.state == HoleState::open) hole.state = HoleState::cancelled;
    }
  }
}

/// Fairs flat patches, refines those again that have grown, and fairs them anew.
void fair_patches(Filling& filling, FilledHoles& filled, const FairOptions& given, Context& context) {
  FairOptions options = given;
  // The shares of the flat patch flip no face.
  if (!options.distribution) options.distribution = Distribution::keep;
  PatchFairing fairing(filling.input(), filling.incidence(), options, context);
  fairing.run(filled, std::vector<std::uint8_t>(filled.holes.size(), 1), 0, first_share);
  if (!context.cancelled()) {
    const std::vector<std::uint8_t> changed = filling.refine_again(filled);
    const std::vector<Hole> before = std::move(filled.holes);
    filled = filling.filled();
    for (std::size_t h = 0; h < before.size(); ++h) filled.holes[h].outcome = before[h].outcome;
    fairing.run(filled, changed, first_share, 1 - first_share);
  }
  fairing.finish(filled);
}

void count(FilledHoles& filled) {
  std::vector<std::uint8_t> in_faces(filled.positions.size(), 0);
  for (const Index node : filled.mesh.corners()) in_faces[static_cast<std::size_t>(node)] = 1;
  FairReport& report = filled.report;
  report.nodes = filled.mesh.node_count();
  report.faces = filled.mesh.face_count();
  const auto used = static_cast<Index>(std::count(in_faces.begin(), in_faces.end(), 1));
  report.fixed_positions = used - static_cast<Index>(filled.node_like.size());
}

}  // namespace

void FillOptions::validate() const {
  fair.validate();
  if (!(most_length > 0))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("most_length is {}, but has to be greater than 0", most_length));
  if (most_edges < 3)
    throw Error(ErrorCode::invalid_argument, fmt::format("most_edges is {}, but has to be 3 or more", most_edges));
}

bool FilledHoles::usable() const noexcept {
  return report.usable() &&
         std::none_of(holes.begin(), holes.end(), [](const Hole& hole) { return hole.state == HoleState::unfillable; });
}

Constraints FilledHoles::constraints() const {
  Constraints result(mesh.node_count());
  std::vector<Index> moving;
  for (auto node = mesh.node_count() - static_cast<Index>(node_like.size()); node < mesh.node_count(); ++node)
    moving.push_back(node);
  restrict_to_region(result, mesh, moving);
  return result;
}

FilledHoles fill_holes(const PolygonMesh& mesh, const FillOptions& options, Context& context) {
  const Stopwatch stopwatch;
  options.validate();
  ProgressReporter progress(context);
  Filling filling(mesh);
  {
    const CancellationScope cancellation(context);
    fill_all(filling, options, progress);
  }
  FilledHoles filled = filling.filled();
  if (!options.flat) fair_patches(filling, filled, options.fair, context);
  filled.report.method = options.fair.method_kind();
  filled.report.threads = context.thread_count();
  if (context.cancelled()) filled.report.outcome = Outcome::cancelled;
  for (const Hole& hole : filled.holes) {
    if (hole.state == HoleState::unfillable)
      filled.report.warnings.emplace_back(WarningCode::unfilled_hole, fault_message(hole));
  }
  count(filled);
  filled.report.seconds = stopwatch.seconds();
  return filled;
}

FilledHoles fill_holes(const PolygonMesh& mesh, const FillOptions& options) {
  Context context;
  return fill_holes(mesh, options, context);
}

}  // namespace vspring
