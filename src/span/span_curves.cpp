#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <map>
#include <string>
#include <utility>

#include "base/cancellation.hpp"
#include "base/message_text.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "shape/box_tree.hpp"
#include "shape/direction.hpp"
#include "shape/face_geometry.hpp"
#include "solve/outcomes.hpp"
#include "span/arcs.hpp"
#include "span/curve_nodes.hpp"
#include "span/held_surface.hpp"
#include "span/lids.hpp"
#include "span/loops.hpp"
#include "span/network.hpp"
#include "span/patches.hpp"
#include "vspring/error.hpp"
#include "vspring/resample.hpp"
#include "vspring/self_intersections.hpp"
#include "vspring/span.hpp"

namespace vspring {

namespace {

// Shares of the diagonal of the box around the curves.
constexpr double default_edge_length = 1.0 / 80;
constexpr double default_join = 1e-3;
constexpr double most_nodes = 1e7;

Box box_around(const PolygonCurve& curves) {
  Box box;
  for (const auto& chain : curves.chains()) {
    for (const Index node : chain.nodes) {
      const Vector3& place = curves.position(node);
      if (!place.allFinite())
        throw Error(ErrorCode::unusable_shape, fmt::format("node {}: its position is not finite", node));
      box.extend(place);
    }
  }
  return box;
}

double diagonal_of(const PolygonCurve& curves) {
  const Box box = box_around(curves);
  return box.isEmpty() ? 0 : box.diagonal().norm();
}

const std::vector<Index>& checked_sharp(const PolygonCurve& curves, const SpanOptions& options) {
  for (const Index chain : options.sharp) {
    if (chain < 0 || static_cast<std::size_t>(chain) >= curves.chains().size())
      throw Error(ErrorCode::invalid_argument, fmt::format("{} in sharp is no chain; chains go from 0 to {}", chain,
                                                           static_cast<std::ptrdiff_t>(curves.chains().size()) - 1));
  }
  return options.sharp;
}

/// Per loop, whether an option names it.
std::vector<std::uint8_t> named_loops(const std::vector<Index>& numbers, std::size_t count, const char* option) {
  std::vector<std::uint8_t> is_named(count, 0);
  for (const Index loop : numbers) {
    if (loop < 0 || static_cast<std::size_t>(loop) >= count)
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{} in {} is no loop; loops go from 0 to {}", loop, option, count - 1));
    is_named[static_cast<std::size_t>(loop)] = 1;
  }
  return is_named;
}

/// Makes the surface, one step after the other.
class Spanner {
 public:
  Spanner(const PolygonCurve& curves, const SpanOptions& options, Context& context)
      : options_(options),
        context_(context),
        progress_(context),
        diagonal_(diagonal_of(curves)),
        join_(options.join.value_or(default_join * diagonal_)),
        network_(join_curves(curves, join_, checked_sharp(curves, options))),
        arcs_(network_),
        loops_(find_loops(network_, arcs_)) {
    describe_curves();
    describe_loops();
  }

  SpannedCurves run() {
    divide();
    make_faces();
    const HeldSurface held = hold();
    if (!options_.flat && result_.mesh.face_count() > 0) fair_surface(held);
    if (!context_.cancelled()) look_for_crossings();
    return std::move(result_);
  }

 private:
  [[nodiscard]] bool is_spanned(std::size_t loop) const { return result_.loops[loop].state == LoopState::spanned; }
  [[nodiscard]] Index from(Index network_node) const { return network_.from[static_cast<std::size_t>(network_node)]; }
  /// By its normal; its faces tell.
  [[nodiscard]] bool seems_outer(std::size_t loop) const {
    return is_wanted_[loop] == 0 && result_.loops[loop].is_outer();
  }
  NetworkCurve& curve_of(Index half) { return result_.curves[static_cast<std::size_t>(half / 2)]; }

  [[nodiscard]] Advice join_further() const {
    return {Remedy::join, fmt::format("join curves that are further apart than {:g}", join_)};
  }

  void describe_curves() {
    for (const Arc& arc : arcs_.all()) {
      NetworkCurve& curve = result_.curves.emplace_back();
      curve.length = arc.length;
      curve.is_sharp = true;
      for (std::size_t k = 0; k < arc.nodes.size(); ++k) {
        curve.from.push_back(from(arc.nodes[k]));
        if (k == 0) continue;
        const std::pair<Index, Index> edge = std::minmax(arc.nodes[k - 1], arc.nodes[k]);
        curve.is_sharp = curve.is_sharp && std::binary_search(network_.sharp.begin(), network_.sharp.end(), edge);
      }
    }
    if (!network_.loose.empty())
      result_.report.warnings.emplace_back(
          WarningCode::loose_curve,
          fmt::format("curves end freely at {} and bound nothing, up to where they meet another",
                      nodes_in_words(network_.loose)),
          std::vector{join_further()});
  }

  void describe_loops() {
    if (loops_.empty())
      throw Error(
          ErrorCode::unusable_shape,
          fmt::format("no curves make a loop that a surface could span{}",
                      network_.loose.empty() ? "" : ", as they end freely at " + nodes_in_words(network_.loose)),
          {join_further(), {Remedy::input, "add curves between their ends"}});
    const auto asked = named_loops(options_.loops, loops_.size(), "loops");
    const auto also = named_loops(options_.also, loops_.size(), "also");
    const auto refused = named_loops(options_.without, loops_.size(), "without");
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      NetworkLoop& loop = result_.loops.emplace_back();
      loop.facing = loops_[l].facing;
      for (const Index half : loops_[l].halves) {
        loop.curves.push_back(half / 2);
        loop.junctions.push_back(from(arcs_.first_node(half)));
        loop.length += arcs_.of(half).length;
      }
      is_wanted_.push_back(asked[l] != 0 || also[l] != 0 ? 1 : 0);
      if (refused[l] != 0 || (!options_.loops.empty() && is_wanted_[l] == 0)) loop.state = LoopState::left_out;
    }
  }

  /// Puts nodes along the curves of loops that are to be spanned.
  void divide() {
    const double edge_length = options_.edge_length.value_or(default_edge_length * diagonal_);
    double nodes = 0;
    std::vector<Sides> inner;
    sides_.resize(loops_.size());
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      if (!is_spanned(l)) continue;
      sides_[l] = sides_of(loops_[l], arcs_);
      for (const Index half : loops_[l].halves) ++curve_of(half).loops;
      if (seems_outer(l)) continue;
      inner.push_back(sides_[l]);
      nodes += std::pow(result_.loops[l].length / edge_length / 4, 2);
    }
    if (!(nodes < most_nodes))
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("edges of length {:g} ask for some {:.2g} nodes, but at most {:.2g} are made",
                              edge_length, nodes, most_nodes));
    std::vector<Index> edges = edges_of_arcs(arcs_, inner, edge_length);
    for (std::size_t a = 0; a < edges.size(); ++a) {
      if (result_.curves[a].loops == 0) edges[a] = 0;
    }
    nodes_ = divide_curves(network_, arcs_, edges);
    if (options_.fair_curves) {
      FairReport report = fair_curves(nodes_, network_, arcs_, options_.fair.method, context_);
      std::move(report.warnings.begin(), report.warnings.end(), std::back_inserter(result_.report.warnings));
      result_.report.outcome = report.outcome;
    }
    for (std::size_t a = 0; a < edges.size(); ++a) result_.curves[a].nodes = nodes_.of_arc[a];
  }

  void make_faces() {
    FaceMaker maker(nodes_);
    faces_.resize(loops_.size());
    std::vector<std::uint8_t> is_made(loops_.size(), 0);
    try {
      const CancellationScope cancellation(context_);
      for (std::size_t l = 0; l < loops_.size(); ++l) {
        if (!is_spanned(l)) continue;
        progress_.report("meshing", 0);
        // What will be left open shows by its faces at the curves alone.
        const std::string fault = maker.span(sides_[l], !seems_outer(l), faces_[l]);
        is_made[l] = 1;
        if (fault.empty()) continue;
        if (seems_outer(l)) {
          leave_open(l, LoopState::outer);
          continue;
        }
        leave_open(l, LoopState::unspannable);
        result_.report.warnings.emplace_back(
            WarningCode::unspanned_loop,
            fmt::format("loop {} of {} curves stays open: {}", l, loops_[l].halves.size(), fault),
            std::vector{Advice{Remedy::input, "add a curve that divides it"}});
      }
      for (const std::size_t l : lids()) leave_open(l, result_.loops[l].is_outer() ? LoopState::outer : LoopState::lid);
      for (std::size_t l = 0; l < loops_.size(); ++l) {
        if (is_spanned(l) && seems_outer(l)) (void)maker.span(sides_[l], true, faces_[l]);
      }
    } catch (const Cancelled&) {
      for (std::size_t l = 0; l < loops_.size(); ++l) {
        if (!is_spanned(l) || (is_made[l] != 0 && !seems_outer(l))) continue;
        leave_open(l, is_made[l] != 0 ? LoopState::outer : LoopState::cancelled);
      }
    }
    take_faces();
  }

  void leave_open(std::size_t l, LoopState state) {
    result_.loops[l].state = state;
    for (const Index half : loops_[l].halves) --curve_of(half).loops;
  }

  /// Faces at edges of curves, and their loops.
  using FacesBeside = std::map<std::pair<Index, Index>, std::vector<std::pair<Index, std::size_t>>>;

  [[nodiscard]] FacesBeside faces_beside_curves() const {
    const auto on_curves = static_cast<Index>(nodes_.places.size());
    FacesBeside beside;
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      if (!is_spanned(l)) continue;
      const NetworkLoop& loop = result_.loops[l];
      for (Index f = loop.first_face; f < loop.first_face + loop.face_count; ++f) {
        const auto face = result_.mesh.face(f);
        for (std::size_t k = 0; k < face.size(); ++k) {
          const std::pair<Index, Index> edge = std::minmax(face[k], face[(k + 1) % face.size()]);
          if (edge.second < on_curves) beside[edge].emplace_back(f, l);
        }
      }
    }
    return beside;
  }

  void take_faces() {
    result_.mesh = mesh_of(nodes_, faces_, result_.loops);
    result_.positions = result_.mesh.positions();
    result_.sharp_edges = sharp_edges(faces_beside_curves());
  }

  [[nodiscard]] MeshEdges sharp_edges(const FacesBeside& beside) const {
    MeshEdges edges;
    for (const NetworkCurve& curve : result_.curves) {
      for (std::size_t k = 0; curve.is_sharp && k + 1 < curve.nodes.size(); ++k) {
        const std::pair<Index, Index> edge = std::minmax(curve.nodes[k], curve.nodes[k + 1]);
        if (const auto there = beside.find(edge); there != beside.end() && there->second.size() == 2)
          edges.push_back(edge);
      }
    }
    std::sort(edges.begin(), edges.end());
    return edges;
  }

  /// The outer rims and lids, found by how each loop turns from those beside it.
  std::vector<std::size_t> lids() {
    take_faces();
    LoopTurns turns(loops_.size());
    for (const auto& [edge, faces] : faces_beside_curves()) {
      if (faces.size() != 2 || faces[0].second == faces[1].second) continue;
      // A lid whose curves are sharp is wanted, but no outer rim is.
      const bool is_outer = seems_outer(faces[0].second) || seems_outer(faces[1].second);
      if (!is_outer && std::binary_search(result_.sharp_edges.begin(), result_.sharp_edges.end(), edge)) continue;
      turns.add(faces[0].second, faces[1].second,
                (result_.mesh.position(edge.second) - result_.mesh.position(edge.first)).norm(),
                degrees_between(unit_normal(result_.mesh.face(faces[0].first), result_.mesh.positions()),
                                unit_normal(result_.mesh.face(faces[1].first), result_.mesh.positions())));
    }
    std::vector<std::uint8_t> may_be;
    std::vector<std::uint8_t> is_round;
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      may_be.push_back(is_spanned(l) && is_wanted_[l] == 0 ? 1 : 0);
      is_round.push_back(sides_[l].sides.size() == 1 ? 1 : 0);
    }
    std::vector<std::size_t> found = turns.lids(may_be, is_round);
    std::vector<std::uint8_t> is_away(loops_.size(), 0);
    for (const std::size_t l : found) is_away[l] = 1;
    for (std::size_t l = 0; l < loops_.size(); ++l) result_.loops[l].turn = turns.mean_without(l, is_away);
    return found;
  }

  HeldSurface hold() {
    std::vector<std::size_t> numbers;
    std::vector<Loop> spanned;
    for (std::size_t l = 0; l < loops_.size(); ++l) {
      if (!is_spanned(l)) continue;
      numbers.push_back(l);
      spanned.push_back(loops_[l]);
    }
    HeldSurface held = hold_curves(result_, nodes_, arcs_, numbers, spanned, options_.symmetry);
    const Index count = result_.mesh.node_count();
    result_.symmetric_nodes = held.symmetric_nodes;
    result_.constraints = Constraints(count);
    for (Index node = 0; node < count; ++node) result_.constraints.hold_as(node, held.constraints, node);
    // On sharp curves each side has normals of its own.
    for (const Index node : held.origin) result_.constraints.free_normal(node);
    return held;
  }

  void fair_surface(const HeldSurface& held) {
    FairOptions options = options_.fair;
    if (!options.distribution) options.distribution = Distribution::keep;
    options.fair_boundary.reset();
    options.corners.clear();
    options.sharp_edges.clear();
    FairResult faired = fair(held.mesh, held.constraints, options, context_);
    faired.positions.resize(static_cast<std::size_t>(result_.mesh.node_count()));
    result_.positions = std::move(faired.positions);
    const FairReport before = std::exchange(result_.report, std::move(faired.report));
    result_.report.warnings.insert(result_.report.warnings.begin(), before.warnings.begin(), before.warnings.end());
    worsen(result_.report.outcome, before.outcome);
    const auto copies = static_cast<Index>(held.origin.size());
    result_.report.nodes -= copies;
    result_.report.fixed_positions -= copies;
    result_.report.sharp_edges = static_cast<Index>(result_.sharp_edges.size());
  }

  void look_for_crossings() {
    PolygonMesh mesh = result_.mesh;
    mesh.set_positions(result_.positions);
    const auto pairs = self_intersections(mesh, context_);
    if (pairs.empty()) return;
    result_.report.warnings.emplace_back(
        WarningCode::patch_crosses,
        fmt::format("the surface crosses itself in {} pairs of faces ({} and {}, for one)", pairs.size(),
                    pairs.front().first, pairs.front().second),
        std::vector{Advice{Remedy::input, "look at the curves there"}});
  }

  const SpanOptions& options_;
  Context& context_;
  ProgressReporter progress_;
  double diagonal_;
  double join_;
  Network network_;
  Arcs arcs_;
  std::vector<Loop> loops_;
  std::vector<std::uint8_t> is_wanted_;  ///< per loop, whether an option names it to be spanned
  std::vector<Sides> sides_;             ///< per loop; empty for one that is not to be spanned
  CurveNodes nodes_;
  std::vector<LoopFaces> faces_;  ///< per loop
  SpannedCurves result_;
};

}  // namespace

const char* name(LoopState state) noexcept {
  switch (state) {
    case LoopState::spanned:
      return "spanned";
    case LoopState::outer:
      return "outer";
    case LoopState::lid:
      return "lid";
    case LoopState::left_out:
      return "left-out";
    case LoopState::unspannable:
      return "unspannable";
    case LoopState::cancelled:
      return "cancelled";
  }
  return "";
}

void SpanOptions::validate() const {
  fair.validate();
  if (edge_length && !(*edge_length > 0 && std::isfinite(*edge_length)))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("edge_length is {}, but has to be greater than 0", *edge_length));
  if (join && !(*join >= 0 && std::isfinite(*join)))
    throw Error(ErrorCode::invalid_argument, fmt::format("join is {}, but has to be 0 or more", *join));
}

bool SpannedCurves::usable() const noexcept {
  return report.usable() && std::none_of(loops.begin(), loops.end(),
                                         [](const NetworkLoop& loop) { return loop.state == LoopState::unspannable; });
}

SpannedCurves span_curves(const PolygonCurve& curves, const SpanOptions& options, Context& context) {
  const Stopwatch stopwatch;
  options.validate();
  SpannedCurves result = Spanner(curves, options, context).run();
  FairReport& report = result.report;
  report.method = options.fair.method_kind();
  report.threads = context.thread_count();
  report.nodes = result.mesh.node_count();
  report.faces = result.mesh.face_count();
  if (context.cancelled()) report.outcome = Outcome::cancelled;
  report.seconds = stopwatch.seconds();
  return result;
}

SpannedCurves span_curves(const PolygonCurve& curves, const SpanOptions& options) {
  Context context;
  return span_curves(curves, options, context);
}

}  // namespace vspring
