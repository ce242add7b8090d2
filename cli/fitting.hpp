#pragma once

#include <algorithm>
#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fairing_arguments.hpp"
#include "symmetry.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/fit.hpp"
#include "vspring/noise.hpp"

namespace vspring::cli {

/// How points pull: one criterion, or none if a shape is only faired.
struct PullArguments {
  std::optional<double> weight;
  std::optional<double> smoothing_length;
  std::optional<double> within;
  std::optional<double> rms;
  std::optional<double> noise;
  std::optional<Vector3> voxels;  ///< set if an option is "auto" and steps of voxels are removed
  double outliers = 0;
  std::vector<std::string> moving = {};                  ///< names of coordinates that may change; empty: all
  std::array<bool, 3> moving_axes = {true, true, true};  ///< the axes of `moving`
  double least_radius = 0;                               ///< curves only
  double sharp = 0;                                      ///< sharper turns stay corners or edges, degrees; 0: none
  bool sharp_marks = false;                              ///< edges that the file marks stay sharp; surfaces only
  std::string automatic = {};                            ///< the option whose value is "auto"; empty: none
  std::optional<NoiseEstimate> estimate = std::nullopt;  ///< that "auto" used
};

/// Sets the option that is "auto" by the noise of the input: --within to greatest_of_noise(), --rms and --noise to its
/// standard deviation. For surfaces of voxels the steps are removed instead. For curves --rms auto means --noise auto,
/// as a root mean square slightly too small would make the curve follow noise. Throws Error(unusable_shape) if noise
/// cannot be estimated.
void settle_by_noise(PullArguments& arguments, const NoiseEstimate& noise, bool is_curve);

/// Estimates noise, of curves in the moving coordinates. region: empty: everywhere.
inline NoiseEstimate noise_of(const PolygonMesh& mesh, const PullArguments& /*pull*/, const Context& context,
                              const std::vector<Index>& region = {}) {
  return region.empty() ? estimate_noise(mesh, context) : estimate_noise(mesh, region, context);
}
inline NoiseEstimate noise_of(const PolygonCurve& curve, const PullArguments& pull, const Context& /*context*/,
                              const std::vector<Index>& region = {}) {
  return region.empty() ? estimate_noise(curve, pull.moving_axes) : estimate_noise(curve, region, pull.moving_axes);
}

/// Raises an estimate to rounding_of() the nodes: neighbours share such noise, so the estimate may miss it.
NoiseEstimate at_least_rounding(NoiseEstimate noise, double rounding);

template <typename Shape>
void settle_by_noise(PullArguments& arguments, const Shape& shape, const std::vector<Index>& region,
                     const Context& context, double rounding = 0) {
  if (!arguments.automatic.empty())
    settle_by_noise(arguments, at_least_rounding(noise_of(shape, arguments, context, region), rounding),
                    std::is_same_v<Shape, PolygonCurve>);
}

/// The coordinates of a curve that --move names; all if it names none. Throws what choose_axes() throws.
[[nodiscard]] std::array<bool, 3> moving_axes(const CurveFile& file, const std::vector<std::string>& names);

/// Sets the coordinates that move, by the columns of the file. Throws what moving_axes() throws, and
/// Error(invalid_argument) if no points pull.
void settle_moving(PullArguments& arguments, const CurveFile& file);

/// Whether a criterion is given. Throws Error(invalid_argument) for more than one of the five, and for --outliers or
/// --min-radius without any.
[[nodiscard]] bool asks_to_fit(const PullArguments& arguments);

/// Settles the method with its options, the choices of --paper, and the distribution: by default nodes that are the
/// points stay about in their places. --paper, another method, and another distribution set FairOptions::accept_worse.
void settle_options(FairingArguments& arguments, bool is_curve, bool own_nodes_pull);

[[nodiscard]] FitOptions fit_options(const PullArguments& arguments, const FairOptions& fairing);

/// The account of points, for the report and for people.
class FitAccount {
 public:
  /// file: the file of the points. points: for their weights and normals.
  FitAccount(const FitReport& report, const PullArguments& arguments, std::string file, const ScatteredPoints& points);

  [[nodiscard]] nlohmann::ordered_json figures() const;
  [[nodiscard]] std::string lines() const;
  /// The distances of points from the shape, and the furthest point.
  [[nodiscard]] const Distance& furthest() const { return report_.after.all; }

 private:
  [[nodiscard]] bool is_measured() const;
  [[nodiscard]] bool tells_who_is_outside() const;
  [[nodiscard]] double outside_share() const;

  FitReport report_;
  PullArguments arguments_;
  std::string file_;
  std::optional<std::pair<double, double>> weights_;  ///< the least and the greatest weight
  std::int64_t normals_;                              ///< number of points with a normal
};

/// Warns if a tolerance that was not reached is smaller than the estimated noise.
void warn_of_noise(const PullArguments& arguments, const NoiseEstimate& noise, std::vector<Warning>& warnings);

struct FairedOrFitted {
  FairResult faired;
  std::optional<FitAccount> account;  ///< set if points pulled

  [[nodiscard]] nlohmann::ordered_json figures() const {
    return account ? account->figures() : nlohmann::ordered_json::object();
  }
  [[nodiscard]] std::string lines() const { return account ? account->lines() : ""; }
};

/// shape: the input, whose nodes are the points.
template <typename Shape>
FairedOrFitted account_for(FitResult fitted, const Shape& shape, const FairingArguments& arguments,
                           const PullArguments& pull, const Context& context) {
  std::vector<Warning>& warnings = fitted.report.fair.warnings;
  const Outcome outcome = fitted.report.fair.outcome;
  const bool is_fairest =
      outcome == Outcome::converged && std::none_of(warnings.begin(), warnings.end(), [](const Warning& warning) {
        return warning.code == WarningCode::maybe_not_fairest;
      });
  if (!is_fairest && outcome != Outcome::cancelled && pull.automatic.empty())
    warn_of_noise(pull, noise_of(shape, pull, context), warnings);
  FitAccount account(fitted.report, pull, arguments.input, {});
  return {{std::move(fitted.positions), std::move(fitted.report.fair)}, std::move(account)};
}

/// Fairs a shape or, if asked for, fits it to its own nodes in the input. weights: of these; empty: 1 each.
template <typename Shape>
FairedOrFitted fair_or_fit(const MirroredShape<Shape>& mirrored, const Constraints& constraints,
                           std::vector<double> weights, const FairingArguments& arguments, const PullArguments& pull,
                           Context& context) {
  if (!asks_to_fit(pull)) return {mirrored.fair(constraints, arguments.options, context), std::nullopt};
  const Shape& shape = mirrored.shape();
  ScatteredPoints nodes;
  nodes.positions = shape.positions();
  nodes.weights = std::move(weights);
  return account_for(mirrored.fit(constraints, nodes, fit_options(pull, arguments.options), context), shape, arguments,
                     pull, context);
}

}  // namespace vspring::cli
