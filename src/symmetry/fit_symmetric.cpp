#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "fit/fit_points.hpp"
#include "symmetry/given_numbers.hpp"
#include "symmetry/given_report.hpp"
#include "symmetry/points_of_whole.hpp"
#include "vspring/distance.hpp"
#include "vspring/error.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

namespace {

// As a share of a tolerance: by rounding.
constexpr double unseen = 1e-9;

/// Turns the report of a fit of the whole into one of what was given.
template <typename Shape>
class GivenFit {
 public:
  GivenFit(const Symmetric<Shape>& shape, const ScatteredPoints& points, const FitOptions& options, bool own_nodes,
           const GivenNumbers& numbers)
      : shape_(shape), points_(points), options_(options), own_nodes_(own_nodes), numbers_(numbers) {}

  void report(FitResult& result, const std::vector<Vector3>& whole, const Context& context) {
    FitReport& report = result.report;
    const auto count = static_cast<Index>(points_.positions.size());
    const auto images = static_cast<Index>(numbers_.points_with_image.size());
    report.pulling_points = images > 0 ? of_half(report.pulling_points, count - images) : report.pulling_points;
    if (shape_.is_half) {
      report.pulled_nodes = of_half(report.pulled_nodes, shape_.on_plane);
      if (report.boundary)
        for (Index* number : {&report.boundary->ends, &report.boundary->inside, &report.boundary->kept})
          *number = of_half(*number, 0);
    }
    if (report.boundary && images > 0) report.boundary->points = of_half(report.boundary->points, 0);
    std::erase_if(report.outlying_points, [&](Index point) { return point >= count; });
    report.outliers = static_cast<Index>(report.outlying_points.size());
    if (report.sharpest_node >= 0) report.sharpest_node = numbers_.node(report.sharpest_node);
    measure(result, whole, context);
  }

 private:
  [[nodiscard]] std::vector<std::uint8_t> counted() const {
    std::vector<std::uint8_t> counted(points_.positions.size(), 1);
    for (std::size_t j = 0; j < counted.size() && own_nodes_; ++j) counted[j] = shape_.partner[j] < 0 ? 0 : 1;
    return counted;
  }

  [[nodiscard]] std::vector<double> distances_from(const Shape& shape) const {
    return point_distances(points_.positions, shape, measuring_);
  }

  void measure(FitResult& result, const std::vector<Vector3>& whole, const Context& context) {
    FitReport& report = result.report;
    measuring_.threads = context.threads;
    std::vector<std::uint8_t> kept = counted();
    report.points = static_cast<Index>(std::count(kept.begin(), kept.end(), 1));
    if (result.distances.empty()) return;
    report.before = summary(distances_from(before()), kept);
    Shape after = shape_.whole;
    after.set_positions(whole);
    result.distances = distances_from(after);
    for (const Index point : report.outlying_points) kept[static_cast<std::size_t>(point)] = 0;
    report.after = summary(result.distances, kept);
    if (options_.within()) report.active_points = active_points(result.distances, kept, *options_.within());
    if (options_.tolerance()) count_outside(report, result.distances, kept);
    measure_shape(result);
  }

  /// The whole as it was given.
  [[nodiscard]] Shape before() const { return shape_.is_half ? shape_.whole : shape_.given; }

  void count_outside(FitReport& report, const std::vector<double>& distances,
                     const std::vector<std::uint8_t>& kept) const {
    report.outside_points = 0;
    for (std::size_t j = 0; j < kept.size(); ++j)
      report.outside_points += kept[j] != 0 && distances[j] > *options_.tolerance() ? 1 : 0;
  }

  void measure_shape(FitResult& result) const {
    Distance& from_points = result.report.shape;
    if (from_points.count == 0) return;
    if constexpr (std::is_same_v<Shape, PolygonMesh>) {
      PolygonMesh moved = shape_.given;
      moved.set_positions(result.positions);
      from_points = distance(moved, before(), measuring_);
    } else if (shape_.is_half) {
      from_points.node = numbers_.node(from_points.node);
      from_points.count = of_half(from_points.count, 0);
    }
  }

  const Symmetric<Shape>& shape_;
  const ScatteredPoints& points_;
  const FitOptions& options_;
  bool own_nodes_;
  const GivenNumbers& numbers_;
  Context measuring_;
};

/// A fit of the whole, and its result for the given shape.
template <typename Shape>
class SymmetricFit {
 public:
  SymmetricFit(const Symmetric<Shape>& shape, const Constraints& constraints, const ScatteredPoints& points,
               const FitOptions& options, Context& context)
      : shape_(shape),
        points_(points),
        options_(options),
        context_(context),
        held_(symmetric_constraints(shape, constraints)),
        numbers_(shape, static_cast<Index>(points.positions.size())),
        both_(points_of_whole(shape, points, options.criterion, context, numbers_)),
        of_whole_(options) {
    of_whole_.criterion = both_.criterion;
    of_whole_.fair = with_marks_of_both(shape, options.fair);
  }

  FitResult fit() {
    FitResult result;
    for (int turn = 0; turn < most_turns; ++turn) {
      const FitResult whole = naming_what_was_given(
          numbers_, [&] { return vspring::fit(shape_.whole, held_, both_.points, of_whole_, context_); });
      result = given(whole, Leading::mean);
      if (!is_outside(result)) return result;
      // Both halves are within the tolerance, if their mean is not.
      for (const Leading leading : {Leading::front, Leading::back}) {
        FitResult other = given(whole, leading);
        if (!is_outside(other)) return other;
      }
      tighten(reached(result));
    }
    FairReport& report = result.report.fair;
    report.outcome = Outcome::stalled;
    report.warnings.push_back(
        {WarningCode::outside_tolerance,
         fmt::format("the whole was within {:g}, but this is {:.4g} away, as its halves were not quite mirror images: "
                     "allow a little more",
                     *options_.tolerance(), reached(result))});
    return result;
  }

 private:
  [[nodiscard]] FitResult given(FitResult result, Leading leading) {
    std::vector<Vector3> whole = std::exchange(result.positions, {});
    result.positions = given_positions(shape_, held_, whole, leading);
    report_what_was_given(shape_, held_, numbers_, result.positions, options_.fair.accept_worse, result.report.fair);
    GivenFit<Shape>(shape_, points_, options_, both_.own_nodes, numbers_).report(result, whole, context_);
    return result;
  }

  [[nodiscard]] double reached(const FitResult& result) const {
    const Distance& distances = result.report.after.all;
    return options_.rms() ? distances.rms : distances.greatest;
  }

  /// Whether it is outside the tolerance though the whole is within its own.
  [[nodiscard]] bool is_outside(const FitResult& result) const {
    return options_.tolerance() && result.report.fair.outcome == Outcome::converged &&
           reached(result) > (1 + unseen) * *options_.tolerance();
  }

  void tighten(double reached) {
    const double share = tighter * *options_.tolerance() / reached;
    if (const auto within = of_whole_.within())
      of_whole_.criterion = Within{share * *within};
    else
      of_whole_.criterion = RootMeanSquare{share * *of_whole_.rms()};
  }

  // Fits of the whole, until the result for the given shape is within the tolerance, too.
  static constexpr int most_turns = 4;
  static constexpr double tighter = 0.999;

  const Symmetric<Shape>& shape_;
  const ScatteredPoints& points_;
  const FitOptions& options_;
  Context& context_;
  Constraints held_;
  GivenNumbers numbers_;
  PointsOfWhole both_;
  FitOptions of_whole_;
};

template <typename Shape>
FitResult fit_whole(const Symmetric<Shape>& shape, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context) {
  options.validate();
  check_points(points, shape.given.positions());
  if (!options.moves_freely())
    throw Error(ErrorCode::invalid_argument, "coordinates cannot be kept in a fit of a symmetric curve",
                {{Remedy::moving_axes, "let all move"}});
  return SymmetricFit<Shape>(shape, constraints, points, options, context).fit();
}

}  // namespace

FitResult fit(const Symmetric<PolygonMesh>& shape, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options, Context& context) {
  return fit_whole(shape, constraints, points, options, context);
}

FitResult fit(const Symmetric<PolygonCurve>& shape, const Constraints& constraints, const ScatteredPoints& points,
              const FitOptions& options, Context& context) {
  return fit_whole(shape, constraints, points, options, context);
}

}  // namespace vspring
