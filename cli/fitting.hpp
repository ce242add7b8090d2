#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fairing_arguments.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/fit.hpp"
#include "vspring/noise.hpp"

namespace vspring::cli {

/// How points pull: one of these, or none where a shape is only faired.
struct PullArguments {
  std::optional<double> weight;
  std::optional<double> smoothing_length;
  std::optional<double> within;
  std::optional<double> rms;
  std::optional<double> noise;
  std::optional<Vector3> voxels;  ///< whose steps are taken off, where an option is "auto"
  double outliers = 0;
  std::vector<std::string> moving = {};                  ///< names of coordinates that move; empty: all
  std::array<bool, 3> moving_axes = {true, true, true};  ///< that these are
  double least_radius = 0;                               ///< of curves, as the next one
  double sharp = 0;                                      ///< what turns by more stays sharp; 0: nothing
  std::string automatic = {};                            ///< the option whose value is "auto"; empty: none
  std::optional<NoiseEstimate> estimate = std::nullopt;  ///< that it was set by
};

/// Gives the option that is "auto" its value, by the noise of the nodes as they came: --within greatest_of_noise(),
/// --rms and --noise its standard deviation. Of surfaces of voxels their steps are taken off instead. Of a curve --rms
/// auto is --noise auto: a root mean square that is a little too small for the noise has it followed. Throws
/// Error(unusable_shape) where that cannot be told.
void settle_by_noise(PullArguments& arguments, const NoiseEstimate& noise, bool is_curve);

/// In the coordinates that move.
inline NoiseEstimate noise_of(const PolygonMesh& mesh, const PullArguments& /*pull*/, const Context& context) {
  return estimate_noise(mesh, context);
}
inline NoiseEstimate noise_of(const PolygonCurve& curve, const PullArguments& pull, const Context& /*context*/) {
  return estimate_noise(curve, pull.moving_axes);
}

/// At least rounding_of() the nodes, which is noise that neighbours share, so that it may not be seen.
NoiseEstimate at_least_rounding(NoiseEstimate noise, double rounding);

template <typename Shape>
void settle_by_noise(PullArguments& arguments, const Shape& shape, const Context& context, double rounding = 0) {
  if (!arguments.automatic.empty())
    settle_by_noise(arguments, at_least_rounding(noise_of(shape, arguments, context), rounding),
                    std::is_same_v<Shape, PolygonCurve>);
}

/// The coordinates of a curve that --move names, all of them where it names none. Throws what choose_axes() does.
[[nodiscard]] std::array<bool, 3> moving_axes(const CurveFile& file, const std::vector<std::string>& names);

/// Finds the coordinates that are to move in a file that was read. Throws what moving_axes() does, and
/// Error(invalid_argument) where no points pull.
void settle_moving(PullArguments& arguments, const CurveFile& file);

/// Throws Error(invalid_argument) where more than one of the five is given, or --outliers or --min-radius without any.
[[nodiscard]] bool asks_to_fit(const PullArguments& arguments);

/// The method with its own options, what --paper stands for, and how nodes are distributed: those that are the points
/// stay about where they are, unless the command says otherwise. What it asks for besides the defaults is written as
/// found.
void settle_options(FairingArguments& arguments, bool is_curve, bool own_nodes_pull);

[[nodiscard]] FitOptions fit_options(const PullArguments& arguments, const FairOptions& fairing);

/// What a report and people are told of points.
class FitAccount {
 public:
  /// file: the one that the points are from. points: their weights and normals.
  FitAccount(const FitReport& report, const PullArguments& arguments, std::string file, const ScatteredPoints& points);

  [[nodiscard]] nlohmann::ordered_json figures() const;
  [[nodiscard]] std::string lines() const;
  /// How far points are from the shape, and which one is furthest.
  [[nodiscard]] const Distance& furthest() const { return report_.after.all; }

 private:
  [[nodiscard]] bool is_measured() const;
  [[nodiscard]] bool tells_who_is_outside() const;
  [[nodiscard]] double outside_share() const;

  FitReport report_;
  PullArguments arguments_;
  std::string file_;
  std::optional<std::pair<double, double>> weights_;  ///< the least and the greatest
  std::int64_t normals_;                              ///< points that have one
};

/// Says where a tolerance that was not reached is smaller than the noise seems to be.
void warn_of_noise(const PullArguments& arguments, const NoiseEstimate& noise, std::vector<Warning>& warnings);

struct FairedOrFitted {
  FairResult faired;
  std::optional<FitAccount> account;  ///< where points pulled

  [[nodiscard]] nlohmann::ordered_json figures() const {
    return account ? account->figures() : nlohmann::ordered_json::object();
  }
  [[nodiscard]] std::string lines() const { return account ? account->lines() : ""; }
};

/// shape: the one that came, whose nodes are the points.
template <typename Shape>
FairedOrFitted account_for(FitResult fitted, const Shape& shape, const FairingArguments& arguments,
                           const PullArguments& pull, const Context& context) {
  const Outcome outcome = fitted.report.fair.outcome;
  if (outcome != Outcome::converged && outcome != Outcome::cancelled && pull.automatic.empty())
    warn_of_noise(pull, noise_of(shape, pull, context), fitted.report.fair.warnings);
  FitAccount account(fitted.report, pull, arguments.input, {});
  return {{std::move(fitted.positions), std::move(fitted.report.fair)}, std::move(account)};
}

/// Fairs a shape, and draws it towards points where that is asked for: its own nodes, as the input has them. weights:
/// of these, empty for 1 each.
template <typename Shape>
FairedOrFitted fair_or_fit(const Shape& shape, const Constraints& constraints, std::vector<double> weights,
                           const FairingArguments& arguments, const PullArguments& pull, Context& context) {
  if (!asks_to_fit(pull)) return {fair(shape, constraints, arguments.options, context), std::nullopt};
  ScatteredPoints nodes;
  nodes.positions = shape.positions();
  nodes.weights = std::move(weights);
  return account_for(fit(shape, constraints, nodes, fit_options(pull, arguments.options), context), shape, arguments,
                     pull, context);
}

}  // namespace vspring::cli
