#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "curve_fit/planar_polygon.hpp"

namespace vspring {

/// How curvature rises and falls in turn along runs of stations, each time by what can be seen.
class CurvatureSwings {
 public:
  explicit CurvatureSwings(std::span<const CurvatureRun> runs);

  /// Places inside where curvature turns back.
  [[nodiscard]] std::size_t extremes() const;

  /// For every link between stations, run by run: 1 where curvature rises, −1 where it falls, were the swing of that
  /// rank left out, from the least on; what lies to both sides of it then hangs together. None of so few.
  [[nodiscard]] std::optional<std::vector<int>> without(std::size_t rank) const;

 private:
  struct Turn {
    std::size_t at;  ///< of a closed run beyond its stations, once around
    double value;
  };
  struct Swings {
    std::vector<Turn> turns;
    std::size_t links;
    bool closed;
  };
  static Swings swings_of(const CurvatureRun& run, double visible);
  static void leave_out(Swings& swings, std::size_t swing);

  std::vector<Swings> runs_;
};

}  // namespace vspring
