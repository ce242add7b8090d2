#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "vspring/fair.hpp"

namespace vspring {

/// One way towards a fair shape, and where it led.
struct Attempt {
  Springs springs = Springs::sphere;
  FairBy fair_by = FairBy::curvature;
  Outcome outcome = Outcome::stalled;
  double expected_error = 1;    ///< as in FairReport
  std::vector<Vector3> places;  ///< of the moving nodes, in the net's coordinates
  std::string fault;            ///< what is worse about it than about the start, in words; empty where nothing is
  bool is_misplaced = false;    ///< some node is nowhere, or far out

  /// Whether it is an equilibrium, and no worse than the start.
  [[nodiscard]] bool stands() const { return outcome == Outcome::converged && fault.empty(); }
  /// Whether nothing else need be tried: it stands, or as nearly as rounding lets it, or somebody has cancelled.
  [[nodiscard]] bool is_final() const;
};

/// Which of the attempts is the result: the first that stands, or else the last, if it is no worse than the start or
/// the options say that it is wanted as found. None: the start is better. Says so in the report: outcome, expected
/// error, springs, what it is fair by, and warnings. start_is_sound: whether it has no folds of its own; else the last
/// is the result all the same.
const Attempt* pick(std::span<const Attempt> attempts, bool start_is_sound, const FairOptions& options,
                    FairReport& report);

}  // namespace vspring
