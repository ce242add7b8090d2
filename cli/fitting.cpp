#include "fitting.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

using Json = nlohmann::ordered_json;

// Most numbers of active points or outliers in a report.
constexpr std::ptrdiff_t most_named = 1000;

std::vector<Index> first_of(const std::vector<Index>& points) {
  return {points.begin(), points.begin() + std::min<std::ptrdiff_t>(std::ssize(points), most_named)};
}

/// Empty if they were not measured.
Json to_json(const PointDistances& distances) {
  if (distances.all.count == 0) return Json::object();
  return {{"greatest", distances.all.greatest},
          {"point", distances.all.node},
          {"rms", distances.all.rms},
          {"median", distances.median},
          {"percentile90", distances.percentile90},
          {"percentile99", distances.percentile99}};
}

Json optional(const std::optional<double>& value) { return value ? Json(*value) : Json(); }

/// The method, with its own options.
FairingMethod method_of(const FairingArguments& arguments) {
  const double step_tolerance = arguments.step_tolerance.value_or(SweepMethod().step_tolerance);
  const int max_iterations = arguments.max_iterations.value_or(SweepMethod().max_iterations);
  const SweepOrder order = arguments.paper ? SweepOrder::file : SweepOrder::parallel;
  switch (arguments.method.value_or(arguments.paper ? Method::sweep : Method::equilibrium)) {
    case Method::multigrid:
      return MultigridMethod{.step_tolerance = step_tolerance,
                             .max_iterations = max_iterations,
                             .levels = arguments.levels,
                             .pre_smoothing = arguments.pre_smoothing,
                             .order = order,
                             .keep_last = arguments.paper};
    case Method::sweep:
      return SweepMethod{.step_tolerance = step_tolerance,
                         .max_iterations = max_iterations,
                         .order = order,
                         .keep_last = arguments.paper};
    case Method::equilibrium:
      break;
  }
  // With the paper's equations, which are for comparison, there are no fallbacks.
  EquilibriumMethod equilibrium;
  equilibrium.tolerance = arguments.tolerance;
  equilibrium.max_iterations = arguments.max_iterations;
  equilibrium.fallbacks = !arguments.paper;
  return equilibrium;
}

/// The distribution if none is given.
Distribution default_distribution(const FairingArguments& arguments, bool is_curve, bool own_nodes_pull) {
  if (arguments.paper) return Distribution::even;
  if (own_nodes_pull) return Distribution::keep;
  const bool papers_own = arguments.method.value_or(Method::equilibrium) != Method::equilibrium;
  return is_curve || papers_own ? Distribution::even : Distribution::smooth;
}

}  // namespace

bool asks_to_fit(const PullArguments& arguments) {
  const int given = (arguments.weight ? 1 : 0) + (arguments.smoothing_length ? 1 : 0) + (arguments.within ? 1 : 0) +
                    (arguments.rms ? 1 : 0) + (arguments.noise ? 1 : 0) + (arguments.voxels ? 1 : 0);
  const std::string all = "--weight, --smoothing-length, --within, --rms and --noise";
  if (given > 1) throw Error(ErrorCode::invalid_argument, "only one of " + all + " can be given");
  if (given == 0 && arguments.outliers > 0) throw Error(ErrorCode::invalid_argument, "--outliers needs one of " + all);
  if (given == 0 && arguments.least_radius > 0)
    throw Error(ErrorCode::invalid_argument, "--min-radius needs one of " + all + ": what the curve is drawn to");
  return given == 1;
}

void settle_options(FairingArguments& arguments, bool is_curve, bool own_nodes_pull) {
  FairOptions& options = arguments.options;
  options.method = method_of(arguments);
  if (arguments.fair_boundary && arguments.paper)
    options.fair_boundary = options.method;
  else if (arguments.fair_boundary)
    options.fair_boundary =
        EquilibriumMethod{.tolerance = arguments.tolerance, .max_iterations = arguments.max_iterations};
  const Distribution usual = default_distribution(arguments, is_curve, own_nodes_pull);
  const bool is_other = arguments.distribution.value_or(usual) != usual;
  options.accept_worse = arguments.paper || is_other || options.method_kind() != Method::equilibrium;
  if (is_other || arguments.paper || own_nodes_pull) options.distribution = arguments.distribution.value_or(usual);
  if (!arguments.paper) return;
  options.pseudo_normals = PseudoNormals::average;
  options.springs = Springs::edge;
  options.forces = Forces::printed;
  options.curve = CurveRules::paper();
}

std::array<bool, 3> moving_axes(const CurveFile& file, const std::vector<std::string>& names) {
  if (names.empty()) return {true, true, true};
  std::array<bool, 3> axes = choose_axes(file, names);
  // In a plane no coordinate is left to keep then.
  if (file.planar && axes[0] && axes[1]) axes[2] = true;
  return axes;
}

void settle_moving(PullArguments& arguments, const CurveFile& file) {
  if (arguments.moving.empty()) return;
  if (!asks_to_fit(arguments))
    throw Error(
        ErrorCode::invalid_argument,
        "--move: how near to the rows is the curve to stay? give --within, --rms, --noise or --smoothing-length");
  arguments.moving_axes = moving_axes(file, arguments.moving);
}

NoiseEstimate at_least_rounding(NoiseEstimate noise, double rounding) {
  if (noise.voxel || !(noise.deviation > 0) || noise.deviation >= rounding) return noise;
  noise.edges *= rounding / noise.deviation;
  noise.deviation = rounding;
  noise.coordinates_differ = false;
  return noise;
}

void settle_by_noise(PullArguments& arguments, const NoiseEstimate& noise, bool is_curve) {
  if (!(noise.deviation > 0))
    throw Error(ErrorCode::unusable_shape,
                arguments.automatic +
                    " auto: the numbers of this shape show no noise, or it has too few nodes; give "
                    "a number, or smooth by a length (--smoothing-length)");
  arguments.estimate = noise;
  if (noise.voxel) {
    arguments.voxels = noise.voxel;
    arguments.within = arguments.rms = arguments.noise = std::nullopt;
    return;
  }
  if (arguments.automatic == "--within") arguments.within = greatest_of_noise(noise);
  const bool takes_it_off = arguments.automatic == "--noise" || (arguments.automatic == "--rms" && is_curve);
  arguments.rms = arguments.automatic == "--rms" && !is_curve ? std::optional(noise.deviation) : std::nullopt;
  if (takes_it_off) arguments.noise = noise.deviation;
}

void warn_of_noise(const PullArguments& arguments, const NoiseEstimate& noise, std::vector<Warning>& warnings) {
  const bool is_larger = (arguments.within && noise.deviation > *arguments.within / 2) ||
                         (arguments.rms && noise.deviation > *arguments.rms);
  if (!is_larger) return;
  warnings.push_back(
      {WarningCode::noise_is_larger,
       fmt::format("the noise of the nodes seems to be larger than the tolerance allows for: a standard deviation of "
                   "{:.3g} in each coordinate; --noise auto takes it off, --within auto allows for it",
                   noise.deviation)});
}

FitOptions fit_options(const PullArguments& arguments, const FairOptions& fairing) {
  FitOptions options;
  options.fair = fairing;
  if (arguments.weight) options.criterion = Weight{*arguments.weight};
  if (arguments.smoothing_length) options.criterion = SmoothingLength{*arguments.smoothing_length};
  if (arguments.within) options.criterion = Within{*arguments.within};
  if (arguments.rms) options.criterion = RootMeanSquare{*arguments.rms};
  if (arguments.noise) options.criterion = Noise{*arguments.noise};
  if (arguments.voxels) options.criterion = Voxels{*arguments.voxels};
  options.outliers = arguments.outliers;
  options.moving_axes = arguments.moving_axes;
  options.least_radius = arguments.least_radius;
  options.sharp = arguments.sharp;
  return options;
}

FitAccount::FitAccount(const FitReport& report, const PullArguments& arguments, std::string file,
                       const ScatteredPoints& points)
    : report_(report),
      arguments_(arguments),
      file_(std::move(file)),
      normals_(std::count_if(points.normals.begin(), points.normals.end(),
                             [](const Vector3& normal) { return !normal.isZero(0); })) {
  if (points.weights.empty()) return;
  const auto [least, greatest] = std::minmax_element(points.weights.begin(), points.weights.end());
  weights_ = std::pair(*least, *greatest);
}

Json FitAccount::figures() const {
  return {{"points",
           {{"file", file_},
            {"weight", optional(arguments_.weight)},
            {"smoothing_length", optional(report_.smoothing_length)},
            {"within", optional(arguments_.within)},
            {"rms", optional(arguments_.rms)},
            {"noise", optional(arguments_.noise)},
            {"noise_leaves", optional(report_.noise_leaves)},
            {"voxels",
             arguments_.voxels ? Json{arguments_.voxels->x(), arguments_.voxels->y(), arguments_.voxels->z()} : Json()},
            {"estimated_noise", arguments_.estimate ? Json(arguments_.estimate->deviation) : Json()},
            {"moving", arguments_.moving.empty() ? Json() : Json(arguments_.moving)},
            {"min_radius", arguments_.least_radius > 0 ? Json(arguments_.least_radius) : Json()},
            {"least_radius",
             report_.least_radius ? Json{{"radius", *report_.least_radius}, {"node", report_.sharpest_node}} : Json()},
            {"weights", weights_ ? Json{{"least", weights_->first}, {"greatest", weights_->second}} : Json()},
            {"normals", normals_},
            {"count", report_.points},
            {"outliers", report_.outliers},
            {"outlying_points", first_of(report_.outlying_points)},
            {"outside",
             tells_who_is_outside() ? Json{{"count", report_.outside_points}, {"share", outside_share()}} : Json()},
            {"at_held", report_.at_held.count > 0 ? Json{{"count", report_.at_held.count},
                                                         {"greatest", report_.at_held.greatest},
                                                         {"rms", report_.at_held.rms}}
                                                  : Json()},
            {"active", report_.active_points.size()},
            {"active_points", first_of(report_.active_points)},
            {"pulling", report_.pulling_points},
            {"nodes_with_points", report_.pulled_nodes},
            {"most_on_a_node", report_.most_points},
            {"boundary", report_.boundary ? Json{{"points", report_.boundary->points},
                                                 {"nodes_at_ends", report_.boundary->ends},
                                                 {"nodes_inside", report_.boundary->inside},
                                                 {"nodes_kept", report_.boundary->kept}}
                                          : Json()},
            {"distance", {{"before", to_json(report_.before)}, {"after", to_json(report_.after)}}},
            {"shape", report_.shape.count > 0 ? Json{{"greatest", report_.shape.greatest},
                                                     {"rms", report_.shape.rms},
                                                     {"greatest_slide", report_.greatest_slide}}
                                              : Json()}}}};
}

bool FitAccount::is_measured() const { return report_.after.all.count > 0; }

bool FitAccount::tells_who_is_outside() const { return is_measured() && (arguments_.within || arguments_.rms); }

double FitAccount::outside_share() const {
  return static_cast<double>(report_.outside_points) / static_cast<double>(report_.after.all.count);
}

std::string FitAccount::lines() const {
  std::string text =
      fmt::format("{} points{}{}, of which {} pull at {} nodes\n", report_.points,
                  weights_ ? fmt::format(" of weights {:.4g} to {:.4g}", weights_->first, weights_->second) : "",
                  normals_ > 0 ? ", with normals" : "", report_.pulling_points, report_.pulled_nodes);
  if (const auto& boundary = report_.boundary)
    text +=
        fmt::format("boundary         {} nodes go to {} points at which these end, {} to points that go on, {} stay\n",
                    boundary->ends, boundary->points, boundary->inside, boundary->kept);
  const auto line = [&](const char* name, double before, double after) {
    text += fmt::format("{}{:.4g} → {:.4g} units\n", name, before, after);
  };
  if (arguments_.voxels)
    text += fmt::format("voxels           {:.4g} × {:.4g} × {:.4g} units: steps removed, nodes within half a voxel\n",
                        arguments_.voxels->x(), arguments_.voxels->y(), arguments_.voxels->z());
  else if (arguments_.estimate)
    text += fmt::format("noise estimated  {:.4g} units ({:.2g} median edges) in each coordinate\n",
                        arguments_.estimate->deviation, arguments_.estimate->edges);
  if (report_.noise_leaves)
    text += fmt::format("noise leaves     {:.4g} units, root mean square across\n", *report_.noise_leaves);
  if (!arguments_.moving.empty())
    text +=
        fmt::format("moved            {} alone: distances are how far rows went\n", fmt::join(arguments_.moving, ", "));
  if (is_measured()) {
    line("rms distance     ", report_.before.all.rms, report_.after.all.rms);
    line("99 % within      ", report_.before.percentile99, report_.after.percentile99);
    line("greatest         ", report_.before.all.greatest, report_.after.all.greatest);
  }
  if (report_.shape.count > 0)
    text += fmt::format("shape from points {:.4g} units at most; nodes slid by up to {:.4g}\n", report_.shape.greatest,
                        report_.greatest_slide);
  if (tells_who_is_outside())
    text += fmt::format("further away     {} ({:.3g} %) than {:.4g} units\n", report_.outside_points,
                        100 * outside_share(), arguments_.within ? *arguments_.within : *arguments_.rms);
  // Of a shape's own nodes they are the held ones.
  if (report_.at_held.count > 0 && report_.shape.count == 0)
    text += fmt::format("at what is held  {} points, up to {:.4g} units away, which do not count\n",
                        report_.at_held.count, report_.at_held.greatest);
  if (report_.smoothing_length) text += fmt::format("smoothing length {:.4g} units\n", *report_.smoothing_length);
  if (report_.least_radius)
    text += fmt::format("least radius     {:.4g} units, at node {}\n", *report_.least_radius, report_.sharpest_node);
  if (report_.outliers > 0) text += fmt::format("outliers         {} left out after\n", report_.outliers);
  return text;
}

}  // namespace vspring::cli
