// Scattered points that shapes are drawn towards.

#pragma once

#include <string>

#include "values.hpp"

namespace vspring {

/// The points of a file.
class Points {
 public:
  /// bytes: a Uint8Array. name: of the file, for its format and for messages.
  Points(const val& bytes, const std::string& name);

  [[nodiscard]] const ScatteredPoints& points() const { return points_; }
  [[nodiscard]] val positions() const { return positions_array(points_.positions); }
  [[nodiscard]] bool weighted() const { return !points_.weights.empty(); }

 private:
  ScatteredPoints points_;
};

/// Of an object with some of `smoothingLength`, `within`, `rms`, `weight` and `outliers`, as FitOptions has them.
FitOptions options_of(const val& settings);

/// The report of fairing with `fit`, figures of the points, and `distances`.
val to_val(const FitResult& result);

}  // namespace vspring
