#include "solve/fit_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "vspring/error.hpp"

namespace vspring {

namespace {

constexpr double largest_weight = 1e50;

bool is_weight(double weight) { return weight >= 0 && weight <= largest_weight; }

}  // namespace

void check_points(const ScatteredPoints& points) {
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  const std::size_t count = points.positions.size();
  if (count == 0) refuse("there are no points to fit to");
  if (count > static_cast<std::size_t>(std::numeric_limits<Index>::max()))
    refuse(fmt::format("{} points are more than there may be: {}", count, std::numeric_limits<Index>::max()));
  if (!points.weights.empty() && points.weights.size() != count)
    refuse(fmt::format("{} weights are given for {} points: one for each is needed, or none", points.weights.size(),
                       count));
  for (std::size_t j = 0; j < count; ++j) {
    if (!points.positions[j].allFinite()) refuse(fmt::format("point {} is not finite; leave it out", j));
  }
  for (std::size_t j = 0; j < points.weights.size(); ++j) {
    if (!is_weight(points.weights[j]))
      refuse(
          fmt::format("the weight of point {} must be from 0 to {:g}, not {}", j, largest_weight, points.weights[j]));
  }
}

PointDistances summary(std::vector<double> distances) {
  PointDistances result;
  const auto furthest = std::max_element(distances.begin(), distances.end());
  Distance& all = result.all;
  all.greatest = *furthest;
  all.node = static_cast<Index>(furthest - distances.begin());
  all.count = static_cast<Index>(distances.size());
  double squares = 0;
  for (const double distance : distances) {
    const double share = all.greatest > 0 ? distance / all.greatest : 0;
    squares += share * share;
  }
  all.rms = all.greatest * std::sqrt(squares / static_cast<double>(distances.size()));
  const auto percentile = [&](double share) {
    const auto rank = static_cast<std::ptrdiff_t>(std::ceil(share * static_cast<double>(distances.size())));
    const auto place = distances.begin() + rank - 1;
    std::nth_element(distances.begin(), place, distances.end());
    return *place;
  };
  result.median = percentile(0.5);
  result.percentile90 = percentile(0.9);
  result.percentile99 = percentile(0.99);
  return result;
}

void FitOptions::validate() const {
  fair.validate();
  const auto refuse = [](const std::string& message) { throw Error(ErrorCode::invalid_argument, message); };
  if (!is_weight(weight)) refuse(fmt::format("weight must be from 0 to {:g}, not {}", largest_weight, weight));
  const auto check_length = [&](const char* option, const std::optional<double>& length) {
    if (length && !(*length > 0 && std::isfinite(*length)))
      refuse(fmt::format("{} must be more than 0, not {}", option, *length));
  };
  check_length("smoothing length", smoothing_length);
  check_length("within", within);
  check_length("rms", rms);
  if ((smoothing_length ? 1 : 0) + (within ? 1 : 0) + (rms ? 1 : 0) > 1)
    refuse("only one of smoothing length, within and rms can be given");
  if (!(outliers >= 0 && outliers < 1)) refuse(fmt::format("outliers must be from 0 to less than 1, not {}", outliers));
  if ((within || rms) && fair.method == Method::sweep)
    refuse("points can be fitted to a tolerance by the method equilibrium only, not by sweep");
  if ((within || rms) && fair.strength < 1) refuse("points can be fitted to a tolerance at full strength only");
  if (fair.method == Method::multigrid)
    refuse("points can be fitted by the methods equilibrium and sweep, not by multigrid");
  if (fair.fair_boundary) refuse("points cannot be fitted while the boundary is faired: fair the boundary first");
}

}  // namespace vspring
