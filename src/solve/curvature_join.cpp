#include "solve/curvature_join.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/cancellation.hpp"
#include "base/progress.hpp"
#include "base/stopwatch.hpp"
#include "base/threads.hpp"
#include "join/least_variation.hpp"
#include "join/rim_shape.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "solve/lines_of_surface.hpp"
#include "solve/more_folds.hpp"

namespace vspring {

namespace {

// A factor of more takes gigabytes.
constexpr Index most_moving = 60'000;
// Of the size: what asks for more in a step becomes a balloon.
constexpr double most_step = 0.2;
// Of curvature, times the size.
constexpr double next_to_no_jump = 1e-3;

class CurvatureJoin {
 public:
  CurvatureJoin(const PolygonMesh& mesh, const Constraints& constraints, const std::vector<Vector3>& positions)
      : constraints_(constraints), local_(mesh), moves_(mesh.positions().size(), 0) {
    std::vector<std::uint8_t> in_face(moves_.size(), 0);
    for (const Index i : mesh.corners()) in_face[static_cast<std::size_t>(i)] = 1;
    Box box;
    for (Index i = 0; i < mesh.node_count(); ++i) {
      const auto k = static_cast<std::size_t>(i);
      moves_[k] = in_face[k] != 0 && !constraints.position_fixed(i) && constraints.support(i) == nullptr ? 1 : 0;
      moving_ += moves_[k];
    }
    std::vector<std::uint8_t> is_rim(moves_.size(), 0);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      if (std::none_of(face.begin(), face.end(), [&](Index j) { return moves_[static_cast<std::size_t>(j)] != 0; }))
        continue;
      for (const Index j : face) {
        box.extend(positions[static_cast<std::size_t>(j)]);
        is_rim[static_cast<std::size_t>(j)] = moves_[static_cast<std::size_t>(j)] == 0 ? 1 : 0;
      }
    }
    frame_ = Frame(box);
    size_ = box.isEmpty() ? 0 : box.diagonal().norm() * frame_.scale();
    std::vector<Vector3> places;
    places.reserve(positions.size());
    for (const Vector3& position : positions) places.push_back(frame_.to_local(position));
    local_.set_positions(std::move(places));
    for (Index i = 0; i < mesh.node_count(); ++i) {
      if (is_rim[static_cast<std::size_t>(i)] != 0) rim_nodes_.push_back(i);
    }
  }

  [[nodiscard]] Index moving() const { return moving_; }
  [[nodiscard]] const std::vector<Vector3>& start() const { return local_.positions(); }

  /// The curvature at the rim. False where none is to be met.
  bool look_around() {
    const std::vector<std::optional<RimShape>> shapes = rim_shapes(local_, moves_, rim_nodes_);
    for (std::size_t k = 0; k < shapes.size(); ++k) {
      const Index node = rim_nodes_[k];
      // Where nothing else is around, the tangent plane that is given, if one is.
      RimNode one;
      one.node = node;
      if (shapes[k]) {
        one.normal = shapes[k]->normal;
        one.form = shapes[k]->form;
        ++met_;
      } else if (constraints_.normal_fixed(node)) {
        one.normal = constraints_.normal(node).normalized();
      }
      rim_.push_back(one);
    }
    return met_ > 0;
  }

  LeastVariation run(double tolerance, const std::function<void(int)>& on_step, ThreadTeam& team) const {
    return least_variation({.mesh = &local_,
                            .moves = moves_,
                            .rim = rim_,
                            .tolerance = tolerance * size_,
                            .most_step = most_step * size_,
                            .on_step = on_step},
                           team);
  }

  /// In the coordinates of the mesh: what stays has its bits.
  [[nodiscard]] std::vector<Vector3> positions(const LeastVariation& found, std::vector<Vector3> before) const {
    for (std::size_t i = 0; i < before.size(); ++i) {
      if (moves_[i] != 0) before[i] = found.positions[i] / frame_.scale() + frame_.centre();
    }
    return before;
  }

  /// Between the second fundamental forms on both sides of the rim, root mean square, in 1/length of the mesh. None
  /// where what moves tells none.
  [[nodiscard]] std::optional<double> jump(const std::vector<Vector3>& local) const {
    PolygonMesh moved = local_;
    moved.set_positions(local);
    std::vector<std::uint8_t> is_outside(moves_.size(), 1);
    for (std::size_t i = 0; i < moves_.size(); ++i) is_outside[i] = moves_[i] != 0 ? 0 : 1;
    for (const Index node : rim_nodes_) is_outside[static_cast<std::size_t>(node)] = 0;
    const std::vector<std::optional<RimShape>> within = rim_shapes(moved, is_outside, rim_nodes_);
    double squares = 0;
    double count = 0;
    for (std::size_t k = 0; k < rim_.size(); ++k) {
      if (!rim_[k].form || !within[k]) continue;
      squares += (within[k]->form - *rim_[k].form).squaredNorm();
      count += 1;
    }
    if (!(count > 0)) return std::nullopt;
    return std::sqrt(squares / count) * frame_.scale();
  }

  /// Whether that is more than the solver's error may leave.
  [[nodiscard]] bool is_jump(double jump) const { return jump * size_ / frame_.scale() > next_to_no_jump; }

  [[nodiscard]] double expected_error(const LeastVariation& found) const { return found.expected_error / size_; }

  /// Nodes of the rim that have a curvature to meet, and all.
  [[nodiscard]] Index met() const { return met_; }
  [[nodiscard]] Index rim() const { return static_cast<Index>(rim_nodes_.size()); }

 private:
  const Constraints& constraints_;
  PolygonMesh local_;
  std::vector<std::uint8_t> moves_;
  Index moving_ = 0;
  std::vector<Index> rim_nodes_;
  std::vector<RimNode> rim_;
  Frame frame_;
  double size_ = 0;
  Index met_ = 0;
};

/// Goes on from the shape that meets tangent planes, or says why not.
class Joining {
 public:
  Joining(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options, Context& context,
          FairResult& result)
      : join_(mesh, constraints, result.positions),
        start_(mesh),
        options_(options),
        context_(context),
        progress_(context),
        result_(result),
        team_(context.thread_count()) {
    start_.set_positions(result.positions);
  }

  void run() {
    FairReport& report = result_.report;
    if (join_.moving() == 0) return;
    if (join_.moving() > most_moving) {
      stays(fmt::format("{} nodes move, and it takes {} at most", join_.moving(), most_moving));
      return;
    }
    progress_.report("curvature at the rim", 0);
    if (!join_.look_around()) {
      stays("nothing is held around it that has a curvature to meet; hold some faces beside what moves");
      return;
    }
    if (!goes_on()) {
      stays(
          "no shape was found whose curvature changes least, or its faces would fold or cross, or its curvature would "
          "jump by more");
      return;
    }
    report.continuity = Continuity::curvature;
    if (join_.met() < join_.rim())
      warn(
          fmt::format("{} of {} nodes of the rim have a curvature to meet; at the others little is held around, or it "
                      "is sharp",
                      join_.met(), join_.rim()));
  }

 private:
  void warn(const std::string& text) { result_.report.warnings.emplace_back(WarningCode::tangent_only, text); }

  void stays(const std::string& why) {
    warn("the surface meets what is around it with its tangent planes, and not with its curvature: " + why);
  }

  /// Whether the shape that is found is the result.
  bool goes_on() {
    const Stopwatch stopwatch;
    FairReport& report = result_.report;
    const LeastVariation found = join_.run(
        std::get<EquilibriumMethod>(options_.method).tolerance,
        [&](int step) { progress_.report("curvature at the rim", 1 - std::pow(0.8, step)); }, team_);
    report.iterations += found.steps;
    report.levels.push_back({.moving_nodes = join_.moving(),
                             .iterations = found.steps,
                             .outcome = found.converged ? Outcome::converged : Outcome::stalled,
                             .strategy = "curvature at the rim",
                             .seconds = stopwatch.seconds()});
    if (!found.converged) return false;
    std::vector<Vector3> places = join_.positions(found, result_.positions);
    if (!options_.accept_worse && has_more_folds(start_, places, options_.sharp_edges, context_)) return false;
    const auto before = join_.jump(join_.start());
    const auto after = join_.jump(found.positions);
    if (before && after) {
      if (*after > *before && join_.is_jump(*after)) return false;
      report.curvature_jump = {*before, *after};
    }
    result_.positions = std::move(places);
    report.expected_error = report.residual = join_.expected_error(found);
    return true;
  }

  CurvatureJoin join_;
  PolygonMesh start_;
  const FairOptions& options_;
  Context& context_;
  ProgressReporter progress_;
  FairResult& result_;
  ThreadTeam team_;
};

}  // namespace

void join_with_curvature(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options,
                         double strength, Context& context, FairResult& result) {
  FairReport& report = result.report;
  if (report.outcome == Outcome::converged) {
    try {
      const CancellationScope cancellation(context);
      Joining(mesh, constraints, options, context, result).run();
    } catch (const Cancelled&) {
      report.outcome = Outcome::cancelled;
    }
  } else if (report.outcome != Outcome::cancelled) {
    report.warnings.emplace_back(WarningCode::tangent_only,
                                 "the surface meets what is around it with its tangent planes, and not with its "
                                 "curvature: no equilibrium was found to go on from");
  }
  account_for_moves(mesh, constraints, strength, result.positions, report);
}

}  // namespace vspring
