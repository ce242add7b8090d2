#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "curve_fit/curve_program.hpp"
#include "curve_fit/dense_curve.hpp"
#include "linear/band_triangle.hpp"

namespace vspring {

// The range of smoothing: from a spline that hardly bends to one through all points.
inline constexpr double first_smoothing = 1e2;
inline constexpr double least_smoothing = 1e-24;

/// A sum of places with weights, and a vector.
struct Affine {
  std::array<std::uint32_t, 6> nodes{};
  std::array<double, 6> weights{};
  int count = 0;
  Vector3 rest = Vector3::Zero();

  void add(std::uint32_t node, double weight) {
    for (int k = 0; k < count; ++k) {
      if (nodes[static_cast<std::size_t>(k)] != node) continue;
      weights[static_cast<std::size_t>(k)] += weight;
      return;
    }
    nodes[static_cast<std::size_t>(count)] = node;
    weights[static_cast<std::size_t>(count++)] = weight;
  }
};

/// A least-squares problem, as a triangle.
struct LeastSquares {
  LeastSquares(std::size_t size, std::size_t width) : triangle(size, width), right(size, Vector3::Zero()) {}

  /// Adds the row entries · x = value, times `factor`.
  void add(std::size_t first, std::span<const double> entries, Vector3 value, double factor) {
    value *= factor;
    triangle.add(first, entries, factor, [&](std::size_t column, double cosine, double sine) {
      const Vector3 above = right[column];
      right[column] = cosine * above + sine * value;
      value = cosine * value - sine * above;
    });
  }

  BandTriangle triangle;
  std::vector<Vector3> right;
};

/// The smoothing spline of a curve: places of nodes that minimise third differences plus the squared distances of
/// points from their places on the curve, scaled to length 1.
class SmoothingSpline {
 public:
  /// curve, points: must outlive this object, and keep their places until take().
  SmoothingSpline(DenseCurve& curve, const std::vector<CurvePoint>& points);

  /// Factors of the points' weights. Call weigh() after a change.
  std::vector<double> counts;
  void weigh();

  /// Finds the places of nodes, with this weight of third differences. False if they are not finite.
  bool solve(double smoothing);
  /// The places of moving nodes.
  [[nodiscard]] const std::vector<Vector3>& places() const { return places_; }
  void set_places(std::vector<Vector3> places) { places_ = std::move(places); }
  /// Whether the curve has not become much longer.
  [[nodiscard]] bool is_sane() const;
  /// The total turn of all edges, in radians.
  [[nodiscard]] double turning() const;
  /// The vector between a point and its place.
  [[nodiscard]] Vector3 residual(std::size_t point) const;
  [[nodiscard]] double squared_residual(std::size_t point) const { return residual(point).squaredNorm(); }
  /// The squared distance of a point from the chords around its place.
  [[nodiscard]] double squared_distance(std::size_t point) const;
  /// The curve as given, its length and its points.
  [[nodiscard]] const DenseCurve& curve() const { return curve_; }
  [[nodiscard]] double length() const { return length_; }
  [[nodiscard]] const std::vector<CurvePoint>& points() const { return points_; }

  /// Moves the nodes of the curve to the places found.
  void take();

 private:
  struct Row {
    std::size_t first;
    BandTriangle::Row entries;
    Vector3 value;
    double factor;
  };

  void number();
  void find_point_rows();
  [[nodiscard]] std::optional<Affine> bend(std::uint32_t node, bool after) const;
  [[nodiscard]] Affine row_of(const CurvePoint& point) const;
  [[nodiscard]] std::int32_t first_column(const Affine& row) const;
  [[nodiscard]] std::optional<Row> row_from(const Affine& row, double weight) const;
  void add(const Affine& row, double weight);
  void take_rows();
  [[nodiscard]] const Vector3& found(std::uint32_t node) const {
    return column_[node] < 0 ? curve_.place(node) : places_[static_cast<std::size_t>(column_[node])];
  }

  DenseCurve& curve_;
  const std::vector<CurvePoint>& points_;
  std::vector<std::int32_t> column_;
  std::size_t columns_ = 0;
  std::size_t width_ = 0;
  std::vector<Row> rows_;  ///< until added to the triangle
  std::vector<Affine> point_rows_;
  std::vector<std::size_t> order_;  ///< the points by their first unknowns
  LeastSquares fixed_{0, 1};
  LeastSquares data_{0, 1};
  double length_ = 0;
  std::vector<Vector3> places_;
};

}  // namespace vspring
