#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "vspring/fair.hpp"

namespace vspring {

/// How much a shape is bent. Less is fewer folds, or as many and less bending: what is folded flat has none.
struct Bent {
  std::size_t turned = 0;  ///< edges that turn by more than a right angle
  double bending = 0;      ///< ∫ κ₁² + κ₂² dA (BendingEnergy)

  friend bool operator<(const Bent& a, const Bent& b) {
    return std::pair(a.turned, a.bending) < std::pair(b.turned, b.bending);
  }
};

/// As shares of the size: how near to the input a shape of less bending stays, tried in turn.
inline constexpr std::array<double, 5> smoothing_lengths = {1.0 / 8, 1.0 / 16, 1.0 / 32, 1.0 / 64, 1.0 / 128};

/// One way towards a fair shape, and where it led.
struct Attempt {
  Springs springs = Springs::sphere;
  FairBy fair_by = FairBy::curvature;
  bool is_even = false;  ///< nodes went to the mean of their neighbours, which nobody asked for
  Outcome outcome = Outcome::stalled;
  std::optional<double> expected_error = std::nullopt;  ///< as in FairReport
  Bent bent;                                            ///< where none is final
  std::vector<Vector3> places;  ///< of the moving nodes, in the net's coordinates; none where it is final
  std::string fault;            ///< what is worse about it than about the start, in words; empty where nothing is
  Index creased = 0;            ///< nodes that stay, as faces would turn over there, in edges sharper than the input's
  bool keeps_folds = false;     ///< it is an equilibrium, but in folds that the start has by its noise
  std::string remark;           ///< what else is said about it where it is not what was asked for; see words_of_kept()
  bool is_misplaced = false;    ///< some node is nowhere, or far out; looked at where it does not stand

  /// Whether it is an equilibrium, and no worse than the start.
  [[nodiscard]] bool stands() const { return outcome == Outcome::converged && fault.empty() && !keeps_folds; }
  /// Whether nothing else need be tried: it stands, or as nearly as rounding lets it, or somebody has cancelled.
  [[nodiscard]] bool is_final() const;
};

/// What the attempts began with.
struct StartShape {
  bool is_sound = true;  ///< it has no folds of its own
  Bent bent;             ///< as in Attempt
};

/// Of the attempts that are no worse than the start and bent less than that, the one that is bent least; of equal ones
/// the last. None: null.
const Attempt* bent_least(std::span<const Attempt> attempts, const Bent& most);

/// Which of the attempts is the result: the last where it is final, or the options say that it is wanted as found; or
/// else of those that are no worse than the start, and of the start, the one that is bent least. None: that is the
/// start. Says so in the report: outcome, expected error, springs, what it is fair by, and warnings. A start that is
/// not sound is no result: the last is, all the same.
const Attempt* pick(std::span<const Attempt> attempts, const StartShape& start, const FairOptions& options,
                    FairReport& report);

}  // namespace vspring
