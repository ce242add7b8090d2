#pragma once

#include <cstddef>
#include <memory>

#include "base/progress.hpp"
#include "base/threads.hpp"
#include "solve/preconditioner.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// The hierarchy of a shape as the solver of the equilibrium sees it: the coarsest level is number 0, the shape itself
/// the last.
class Hierarchy {
 public:
  Hierarchy() = default;
  virtual ~Hierarchy() = default;
  Hierarchy(const Hierarchy&) = delete;
  Hierarchy& operator=(const Hierarchy&) = delete;

  [[nodiscard]] virtual std::size_t count() const = 0;
  virtual Net& net(std::size_t level) = 0;
  /// For that level; used up before the next one is asked for.
  virtual std::unique_ptr<Preconditioner> preconditioner(std::size_t level) = 0;
  /// Hands the start down to all levels, and makes it fit to start from on the coarsest.
  virtual void start() = 0;
  /// The start of last resort on the coarsest level, which forgets the shape.
  virtual void forget_shape() = 0;
  /// Hands the shape of a level up to the next finer one. Needs directions there.
  virtual void prolong(std::size_t level) = 0;
};

/// Coarse levels first, each to its equilibrium, each the start of the next finer one; none of them where the shape is
/// at its equilibrium already. Fills outcome, iterations, levels, residual, expected error and history.
void run_equilibrium(Hierarchy& hierarchy, const Model& model, const FairOptions& options, ThreadTeam& team,
                     Context& context, ProgressReporter& progress, FairReport& report);

}  // namespace vspring
