// Scattered points that shapes are fitted to.

#pragma once

#include <string>
#include <utility>
#include <vector>

#include "values.hpp"

namespace vspring {

/// Scattered points, from a file or given.
class Points {
 public:
  /// bytes: a Uint8Array. name: of the file, for its format and for messages.
  Points(const val& bytes, const std::string& name);
  /// Points at positions, three numbers each.
  static Points at(const val& positions);

  [[nodiscard]] const ScatteredPoints& points() const { return points_; }
  [[nodiscard]] val positions() const { return positions_array(points_.positions); }
  [[nodiscard]] bool weighted() const { return !points_.weights.empty(); }

 private:
  explicit Points(ScatteredPoints points) : points_(std::move(points)) {}

  ScatteredPoints points_;
};

/// Options from an object with one of `smoothingLength`, `within`, `rms` and `weight`, and some of `outliers`, `sharp`
/// and `leastRadius`, as in FitOptions, and `keep`: whether nodes keep their distribution. Throws
/// Error(invalid_argument) for others.
FitOptions options_of(const val& settings);

/// The report of fairing, plus `fit`, figures of the points, and `distances` if measured.
val to_val(const FitResult& result);

/// Fits the file's shape to points. Sets the new positions; the report also has `fit`, figures of the points, and
/// `distances` of the points from the shape, in units of the file. sharp_edges: of a surface.
template <typename Shape>
val fit_to(const Points& points, const val& settings, const val& progress, const Shape& shape,
           const Constraints& constraints, std::vector<Vector3>& positions, const MeshEdges& sharp_edges = {}) {
  return forwarding_errors([&] {
    Context context;
    context.threads = threads();
    ask(context, progress);
    FitOptions options = options_of(settings);
    options.fair.sharp_edges = sharp_edges;
    FitResult result = fit(shape, constraints, points.points(), options, context);
    positions = std::move(result.positions);
    return to_val(result);
  });
}

}  // namespace vspring
