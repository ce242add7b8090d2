#include "fit/fit_warnings.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cstddef>
#include <vector>

#include "equilibrium/account.hpp"
#include "fit/fit_points.hpp"

namespace vspring {

namespace {

// In standard deviations of the noise that is to be taken off.
constexpr double far_off = 1.5;
// A warning comes where points without a tolerance end so far from the shape, root mean square, as a share of their
// box, and so many times as far as before: with weak pulls springs make a balloon of few nodes.
constexpr double left_behind = 0.02;
constexpr double left_times = 10;

}  // namespace

void warn_if_far_off(FitReport& report, double noise) {
  FairReport& fair = report.fair;
  const double distance = report.after.all.rms;
  if (fair.outcome != Outcome::converged || !(distance > far_off * noise)) return;
  fair.outcome = Outcome::stalled;
  fair.warnings.push_back(
      {WarningCode::far_from_nodes,
       fmt::format("nodes were {:.2g} times the noise away from the shape in the root mean square: it could not follow "
                   "them everywhere; they may be too few for their features, or faces folded without noise",
                   distance / noise)});
}

void tell_points_at_held(std::span<const std::uint8_t> kept, std::span<const std::uint8_t> counting,
                         std::optional<double> tolerance, FitResult& found, std::string_view held) {
  std::vector<std::uint8_t> those(kept.begin(), kept.end());
  for (std::size_t j = 0; j < those.size(); ++j) those[j] = those[j] != 0 && counting[j] == 0 ? 1 : 0;
  const Distance told = summary(found.distances, those).all;
  found.report.at_held = told;
  if (!tolerance || !(told.greatest > *tolerance)) return;
  found.report.fair.warnings.push_back(
      {WarningCode::points_at_held,
       fmt::format("of {} points nearest to {} some are further away than {:g}, up to {:.4g} (point {}): nothing that "
                   "moves comes nearer to them, so they do not count",
                   told.count, held, *tolerance, told.greatest, told.node)});
}

void warn_of_least_bending(FairReport& report) {
  report.warnings.push_back(
      {WarningCode::other_fairness,
       "springs and points found no balance: this is the nearest shape of least bending" + words_of_kept(report)});
}

void warn_if_left_behind(FitReport& report, std::span<const Vector3> points) {
  FairReport& fair = report.fair;
  if (fair.outcome != Outcome::converged) return;
  const double before = report.before.all.rms;
  const double after = report.after.all.rms;
  Eigen::AlignedBox3d box;
  for (const Vector3& point : points) box.extend(point);
  // The nodes themselves are no further away than smoothing takes them.
  if (!(before > 0) || after < left_behind * box.diagonal().norm() || after < left_times * before) return;
  fair.warnings.push_back(
      {WarningCode::points_left_behind,
       fmt::format("points are {:.2g} times as far from the shape as before, in the root mean square", after / before),
       {{Remedy::weight, "give them a greater weight"},
        {Remedy::smoothing_length, "a shorter smoothing length"},
        {Remedy::within, "a tolerance to stay within"}}});
}

}  // namespace vspring
