#include "solve/curve_curvature_join.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <utility>

#include "base/cancellation.hpp"
#include "base/stopwatch.hpp"
#include "join/curvature_arc.hpp"
#include "join/curvature_spline.hpp"
#include "join/curve_pieces.hpp"
#include "join/curve_side.hpp"
#include "shape/planarity.hpp"
#include "start/winding.hpp"

namespace vspring {

namespace {

// Of tangents that were estimated alike and told on.
constexpr double same_tangent = 1e-9;

class CurveJoin {
 public:
  CurveJoin(const PolygonCurve& curve, const Constraints& constraints, const Net& net)
      : curve_(curve),
        constraints_(constraints),
        net_(net),
        places_(positions_as_held(curve.positions(), constraints)) {
    for (Vector3& place : places_) place = net.frame.to_local(place);
    for (std::size_t i = 0; i < net.moving; ++i) places_[numbered(net.node[i])] = net.positions[i];
    find_edges();
    pieces_ = moving_pieces(curve, constraints, places_);
    find_joints();
  }

  /// Makes what it can of the stretches. False where that is none.
  bool run(const std::function<void(double)>& on_piece) {
    std::vector<Vector3> of_pieces;
    for (const CurvePiece& piece : pieces_) {
      for (const Index node : piece.nodes) of_pieces.push_back(places_[numbered(node)]);
    }
    Eigen::AlignedBox3d box;
    for (const Vector3& place : of_pieces) box.extend(place);
    size_ = box.isEmpty() ? 0 : box.diagonal().norm();
    plane_ = plane_normal(of_pieces);
    found_ = places_;
    for (std::size_t k = 0; k < pieces_.size(); ++k) {
      on_piece(static_cast<double>(k) / static_cast<double>(pieces_.size()));
      const CurvePiece& piece = pieces_[k];
      const bool has_curvature = piece.joints.front().curvature || piece.joints.back().curvature;
      if (!has_curvature && !piece.closed && piece.joints.size() == 2) continue;
      ++asked_;
      met_ += join(piece) ? 1 : 0;
    }
    return met_ > 0;
  }

  /// The root mean square of the jumps of curvature at ends of stretches and where directions are given, in 1/length of
  /// the curve. found: whether of the places found, or of those at the start. None where nothing tells any.
  [[nodiscard]] std::optional<double> jump(bool found) const {
    const std::vector<Vector3>& places = found ? found_ : places_;
    double squares = 0;
    double count = 0;
    const auto compare = [&](const std::optional<Vector3>& before, const std::optional<Vector3>& after) {
      if (!before || !after) return;
      squares += (*after - *before).squaredNorm();
      count += 1;
    };
    for (const CurvePiece& piece : pieces_) {
      for (std::size_t k = 0; k + 1 < piece.held.size(); ++k) {
        const CurveJoint& joint = piece.joints[k];
        if (k == 0 && !piece.closed)
          compare(joint.curvature, curvature_within(piece, 0, true, places));
        else if (joint.tangent || joint.normal)
          compare(curvature_within(piece, k > 0 ? k - 1 : piece.held.size() - 2, false, places),
                  curvature_within(piece, k, true, places));
      }
      if (!piece.closed)
        compare(piece.joints.back().curvature, curvature_within(piece, piece.held.size() - 2, false, places));
    }
    if (!(count > 0)) return std::nullopt;
    return std::sqrt(squares / count) * net_.frame.scale();
  }

  /// Of a node of the net.
  [[nodiscard]] const Vector3& place(std::size_t i) const { return found_[numbered(net_.node[i])]; }

  [[nodiscard]] int steps() const { return steps_; }
  [[nodiscard]] double expected_error() const { return size_ > 0 ? last_step_ / size_ : 0; }
  /// Stretches that something asks more of than springs give, and those of them that were found.
  [[nodiscard]] Index asked() const { return asked_; }
  [[nodiscard]] Index met() const { return met_; }
  /// Ends beside which nodes are held that tell no curvature.
  [[nodiscard]] Index untold() const { return untold_; }

 private:
  static std::size_t numbered(Index node) { return static_cast<std::size_t>(node); }

  /// The lengths at which the edges before and after each moving node aim.
  void find_edges() {
    edges_.resize(places_.size(), {0, 0});
    for (const MovingRun& run : net_.moving_runs) {
      for (std::size_t k = 0; k < run.nodes.size(); ++k) {
        if (run.nodes[k] >= net_.moving) continue;
        edges_[numbered(net_.node[run.nodes[k]])] = {run.along[k] - run.along[k - 1], run.along[k + 1] - run.along[k]};
      }
    }
  }

  void find_joints() {
    // As constraints of the input have them.
    std::array<std::vector<Index>, 2> ends;
    for (const CurvePiece& piece : pieces_) {
      ends[0].push_back(piece.nodes.front());
      ends[1].push_back(piece.nodes.back());
    }
    /// Per end and side of it.
    std::array<std::array<std::vector<Vector3>, 2>, 2> estimated;
    for (const std::size_t end : {0, 1}) {
      for (const NodeSide side : node_sides)
        estimated[end][static_cast<std::size_t>(side)] = estimate_tangents(curve_, ends[end], side);
    }
    for (std::size_t p = 0; p < pieces_.size(); ++p) {
      CurvePiece& piece = pieces_[p];
      for (std::size_t k = 0; k + (piece.closed ? 1 : 0) < piece.held.size(); ++k) {
        const Index node = piece.nodes[piece.held[k]];
        CurveJoint& joint = piece.joints.emplace_back();
        joint.place = places_[numbered(node)];
        if (constraints_.normal_fixed(node)) joint.normal = constraints_.normal(node);
        if (constraints_.tangent_fixed(node)) joint.tangent = constraints_.tangent(node);
      }
      if (piece.closed) continue;
      for (const std::size_t end : {0, 1}) {
        const bool stands_alone = piece.beside[end].size() < 2;
        // The side from which the curvature is told.
        const NodeSide side = (end == 0) == stands_alone ? NodeSide::after : NodeSide::before;
        set_end(piece, end, estimated[end][static_cast<std::size_t>(side)][p]);
      }
    }
  }

  /// estimated: the tangent that the input has there, from where the curvature is told.
  void set_end(CurvePiece& piece, std::size_t end, const Vector3& estimated) {
    CurveJoint& joint = end == 0 ? piece.joints.front() : piece.joints.back();
    const Index node = end == 0 ? piece.nodes.front() : piece.nodes.back();
    const NodeSide side = end == 0 ? NodeSide::after : NodeSide::before;
    const std::vector<Vector3>& beside = piece.beside[end];
    if (constraints_.tangent_fixed(node, side)) joint.tangent = constraints_.tangent(node, side);
    const bool as_in_input = joint.tangent && (*joint.tangent - estimated).norm() < same_tangent;
    std::optional<CurveSide> told;
    if (beside.size() > 1)
      told = curve_side(beside);
    else if (as_in_input)
      told = curve_side(inwards(piece, end));
    if (beside.size() > 1 && !told) ++untold_;
    const std::optional<Vector3> within =
        curvature_within(piece, end == 0 ? 0 : piece.held.size() - 2, end == 0, places_);
    // A jump that noise explains is none.
    const bool jumps = told && !(within && (*within - told->curvature).squaredNorm() < told->variance);
    if (beside.size() > 1) {
      // With noise an estimate by two edges is less exact.
      if (jumps && (as_in_input || !joint.tangent)) joint.tangent = (end == 0 ? -1 : 1) * told->tangent;
      if (!joint.tangent) joint.tangent = tangent_found(piece, end);
    }
    if (!told) return;
    const Vector3& curvature = jumps ? told->curvature : *within;
    joint.curvature = curvature - curvature.dot(*joint.tangent) * *joint.tangent;
  }

  /// The tangent that springs have found, by a node beside the end on either side.
  [[nodiscard]] Vector3 tangent_found(const CurvePiece& piece, std::size_t end) const {
    const Index within = end == 0 ? piece.nodes[1] : piece.nodes[piece.nodes.size() - 2];
    const Vector3& here = piece.beside[end][0];
    const Vector3 tangent = tangent_at_first(here, places_[numbered(within)], piece.beside[end][1]);
    return end == 0 ? tangent : Vector3(-tangent);
  }

  /// The places of the input from an end on.
  [[nodiscard]] std::vector<Vector3> inwards(const CurvePiece& piece, std::size_t end) const {
    std::vector<Vector3> places;
    for (const Index node : piece.nodes) places.push_back(net_.frame.to_local(curve_.position(node)));
    if (end == 1) std::reverse(places.begin(), places.end());
    return places;
  }

  /// The nodes of a stretch, from held one to held one.
  [[nodiscard]] std::vector<Vector3> stretch(const CurvePiece& piece, std::size_t k,
                                             const std::vector<Vector3>& places) const {
    std::vector<Vector3> nodes;
    for (std::size_t at = piece.held[k]; at <= piece.held[k + 1]; ++at)
      nodes.push_back(places[numbered(piece.nodes[at])]);
    return nodes;
  }

  [[nodiscard]] std::optional<Vector3> curvature_within(const CurvePiece& piece, std::size_t k, bool at_start,
                                                        const std::vector<Vector3>& places) const {
    std::vector<Vector3> nodes = stretch(piece, k, places);
    if (!at_start) std::reverse(nodes.begin(), nodes.end());
    return curvature_at_first(nodes);
  }

  bool join(const CurvePiece& piece) {
    std::vector<CurvatureArc> arcs;
    for (std::size_t k = 0; k + 1 < piece.held.size(); ++k)
      arcs.push_back(linear_arc_near(stretch(piece, k, places_), plane_));
    const std::optional<CurvatureSpline> spline = curvature_spline(piece.joints, piece.closed, std::move(arcs));
    if (!spline) return false;
    steps_ = std::max(steps_, spline->steps);
    for (std::size_t k = 0; k < spline->arcs.size(); ++k) {
      const CurvatureArc& arc = spline->arcs[k];
      last_step_ = std::max(last_step_, spline->last_step * arc.length);
      const std::vector<CurvatureArc::Place> walked = arc.walk(arc.steps());
      std::vector<double> along = {0};
      for (std::size_t at = piece.held[k] + 1; at < piece.held[k + 1]; ++at)
        along.push_back(along.back() + edges_[numbered(piece.nodes[at])][0]);
      const double whole = along.back() + edges_[numbered(piece.nodes[piece.held[k + 1] - 1])][1];
      for (std::size_t j = 1; j < along.size(); ++j)
        found_[numbered(piece.nodes[piece.held[k] + j])] = arc.at(along[j] / whole, walked).pose.place;
    }
    return true;
  }

  const PolygonCurve& curve_;
  const Constraints& constraints_;
  const Net& net_;
  std::vector<Vector3> places_;  ///< of all nodes, in the net's coordinates, at the start
  std::vector<Vector3> found_;
  std::vector<std::array<double, 2>> edges_;
  std::vector<CurvePiece> pieces_;
  std::optional<Vector3> plane_;
  double size_ = 0;
  double last_step_ = 0;
  int steps_ = 0;
  Index asked_ = 0;
  Index met_ = 0;
  Index untold_ = 0;
};

/// Goes on from the curve that meets tangents. Why it stays as it is; empty where it does not.
std::string go_on(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                  const ResultCheck& check, const std::vector<Vector3>& input, ProgressReporter& progress, Net& net,
                  FairReport& report) {
  if (std::any_of(net.given.begin(), net.given.begin() + static_cast<std::ptrdiff_t>(net.moving),
                  [](std::uint8_t given) { return given != 0; }))
    return "directions are given at nodes that move";
  const Stopwatch stopwatch;
  CurveJoin join(curve, constraints, net);
  const bool found = join.run([&](double share) { progress.report("curvature at the ends", share); });
  if (join.asked() == 0)
    return "nothing is held beside it that has a curvature to meet; hold three nodes or more, or the tangent that the "
           "input has at an end";
  report.iterations += join.steps();
  report.levels.push_back({.moving_nodes = static_cast<Index>(net.moving),
                           .iterations = join.steps(),
                           .outcome = found ? Outcome::converged : Outcome::stalled,
                           .strategy = "curvature at the ends",
                           .seconds = stopwatch.seconds()});
  if (!found) return "no curve was found whose curvature is of third degree between held nodes";
  const std::vector<Vector3> before = net.positions;
  for (std::size_t i = 0; i < net.moving; ++i) net.positions[i] = join.place(i);
  if (!options.accept_worse) {
    std::string fault = check.fault(net);
    if (fault.empty() && lost_winding(net, input)) fault = "it would wind otherwise than the input";
    if (!fault.empty()) {
      net.positions = before;
      return fault;
    }
  }
  const auto jump_before = join.jump(false);
  const auto jump_after = join.jump(true);
  if (jump_before && jump_after) report.curvature_jump = {*jump_before, *jump_after};
  report.continuity = Continuity::curvature;
  report.expected_error = report.residual = join.expected_error();
  if (join.met() < join.asked() || join.untold() > 0)
    report.warnings.emplace_back(
        WarningCode::tangent_only,
        fmt::format(
            "{} of {} stretches meet curvature; at {} of their ends the nodes that are held beside tell none, and "
            "only the tangent is met",
            join.met(), join.asked(), join.untold()));
  return {};
}

}  // namespace

void join_with_curvature(const PolygonCurve& curve, const Constraints& constraints, const FairOptions& options,
                         const ResultCheck& check, const std::vector<Vector3>& input, Context& context,
                         ProgressReporter& progress, Net& net, FairReport& report) {
  if (report.outcome == Outcome::cancelled || net.moving == 0) return;
  std::string why = "no equilibrium of springs was found to go on from";
  if (report.outcome == Outcome::converged && report.fair_by == FairBy::curvature) {
    try {
      const CancellationScope cancellation(context);
      why = go_on(curve, constraints, options, check, input, progress, net, report);
    } catch (const Cancelled&) {
      report.outcome = Outcome::cancelled;
      return;
    }
  }
  if (!why.empty())
    report.warnings.emplace_back(WarningCode::tangent_only,
                                 "the curve meets what is held with its tangents, and not with its curvature: " + why);
}

}  // namespace vspring
