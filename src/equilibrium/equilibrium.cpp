#include "equilibrium/equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <variant>

#include "base/cancellation.hpp"
#include "equilibrium/account.hpp"
#include "equilibrium/best_iterate.hpp"
#include "equilibrium/edge_turns.hpp"
#include "precondition/anderson.hpp"
#include "spring/sliding.hpp"

namespace vspring {

namespace {

// No edge may turn or stretch by more than about this in one step: the equations are near to linear up to there.
constexpr double greatest_turn = 0.3;
// The iteration ends where the expected error falls by less than this share in so many iterations: only rounding is
// left, or shortened steps go round in circles.
constexpr int patience = 12;
constexpr double least_gain = 0.3;
// The length of the next accelerated step, at most, as a share of the last one, while they converge.
constexpr double greatest_rate = 0.5;
// Least share of the error by corrections alone that the expected error has, where accelerated steps are shorter.
constexpr double least_share = 0.54;
// Iterations in a row that expect to be off by more than the shape's size: no level that went on from so many ever
// arrived (12 was the most of 494 that did, in 300 tasks at random, and 29 once of 23 nodes, where they cost nothing).
constexpr int lost_patience = 20;
constexpr int lost_patience_of_few = 40;
constexpr std::size_t few_nodes = 100;
// For coordinates up to 2.
constexpr double rounding = std::numeric_limits<double>::epsilon();
// A share of the tolerance.
constexpr double negligible = 0.01;
constexpr int iterations_per_tie = 5;
// Changes of ties from which on a point changes over only if it is nearer by a margin, which doubles with every further
// change: in the end none does. While steps are limited shapes have far to go, and many changes are free.
constexpr int changes_without_margin = 8;
constexpr int free_changes = 30;
constexpr double first_margin = 1.0 / 64;

double margin_after(int changes) {
  return changes < changes_without_margin ? 0 : std::ldexp(first_margin, changes - changes_without_margin);
}

class Solver {
 public:
  Solver(Net& net, const Model& model, Preconditioner& preconditioner, ThreadTeam& team, Anderson<float>* memory)
      : net_(net),
        model_(model),
        preconditioner_(preconditioner),
        team_(team),
        turns_(net, greatest_turn, team),
        anderson_(history(net, team)),
        memory_(memory) {
    model.prepare(net);
  }

  EquilibriumResult run(const EquilibriumTask& task, Context& context) {
    EquilibriumResult result;
    BestIterate best(net_, 1);
    try {
      const CancellationScope cancellation(context);
      iterate(task, result, best);
    } catch (const Cancelled&) {
      forget();
      result.outcome = Outcome::cancelled;
    }
    if (result.outcome == Outcome::converged) return result;
    if (result.outcome == Outcome::iteration_limit && result.work + 1 > task.most_work)
      result.outcome = Outcome::work_limit;
    result.expected_error = std::min(best.restore(), expected_);
    return result;
  }

 private:
  /// Leaves the shape in the net, its figures in the result, and the shape of the smallest residual in `best`.
  void iterate(const EquilibriumTask& task, EquilibriumResult& result, BestIterate& best) {
    double before = 0;
    double rate_before = 0;
    double last_step = 0;
    int without_gain = 0;
    double at_last_gain = std::numeric_limits<double>::infinity();
    int lost = 0;
    const double shape_size = diagonal(net_);
    const int most_lost = net_.moving < few_nodes ? lost_patience_of_few : lost_patience;
    // When points are tied to other nodes, what is known of earlier iterations is no longer valid.
    int changes = 0;
    int changes_from_far = 0;
    const auto renew_ties = [&](bool far) {
      if (!task.renew_ties) return false;
      if (!task.renew_ties(margin_after(changes))) return false;
      if (far) ++changes_from_far;
      if (!far || changes_from_far > free_changes) ++changes;
      forget();
      best = BestIterate(net_, 1);
      before = 0;
      rate_before = 0;
      last_step = 0;
      without_gain = 0;
      at_last_gain = std::numeric_limits<double>::infinity();
      return true;
    };
    bool limited = false;
    int last_changes = 0;
    const int most_while_far = task.most_while_far.value_or(task.max_iterations);
    while (result.iterations < task.max_iterations && result.work + 1 <= task.most_work &&
           (result.iterations < most_while_far || best.residual() < task.near)) {
      end_if_cancelled();
      if (last_changes == 0 && result.iterations > 0 && (limited || result.iterations % iterations_per_tie == 0))
        (void)renew_ties(limited);
      result.work += 1 + find_correction(negligible * task.tolerance);
      ++result.iterations;
      const double size = largest_correction();
      if (!std::isfinite(size)) {
        result.outcome = Outcome::stalled;
        break;
      }
      // Corrections shrink about geometrically. Never by less than half: then a shape that was once near enough still
      // is when it is looked at without its history.
      const double rate = std::clamp(before > 0 ? size / before : 0, 0.5, 0.75);
      expected_ = size / (1 - rate);
      const bool gains = expected_ < (1 - least_gain) * at_last_gain;
      without_gain = gains ? 0 : without_gain + 1;
      if (gains) at_last_gain = expected_;
      best.look(expected_);
      if (task.on_iteration) task.on_iteration(expected_);
      const double turn = turns_.turn(correction_, size);
      accelerate(turn);
      const double step = largest_correction();
      // The last step is not taken: its length is the expected error of the shape before it.
      if (expected_ < task.tolerance && turn <= greatest_turn) {
        const double left = last_step > 0 ? std::min(step / last_step, greatest_rate) : greatest_rate;
        // Where corrections shrink unevenly, the slower rate counts.
        const double slower = size / (1 - std::max(rate, rate_before));
        const double error = std::max({step * (1 + left), least_share * slower, rounding});
        if (error < task.tolerance) {
          if (task.take_last) (void)take_step(turn, step);
          if (last_changes < task.most_changes && renew_ties(false)) {
            ++last_changes;
            continue;
          }
          result.outcome = Outcome::converged;
          result.expected_error = error;
          return;
        }
      }
      limited = take_step(turn, step);
      last_step = limited ? 0 : step;
      lost = expected_ > shape_size ? lost + 1 : 0;
      before = limited ? 0 : size;
      rate_before = limited ? 0 : rate;
      if (without_gain >= patience || lost >= most_lost) {
        result.outcome = Outcome::stalled;
        break;
      }
    }
  }

  /// Curves are iterated nearly down to rounding; surfaces may be large.
  static std::variant<Anderson<float>, Anderson<double>> history(const Net& net, ThreadTeam& team) {
    if (!net.is_curve) return Anderson<float>(surface_acceleration_depth(net.moving), net.moving, team);
    return Anderson<double>(acceleration_depth, net.moving, team);
  }

  void forget() {
    if (memory_) return memory_->forget();
    std::visit([](auto& anderson) { anderson.forget(); }, anderson_);
  }

  /// What it took besides one iteration, in iterations.
  double find_correction(double enough) {
    update_directions(net_, model_, team_);
    const bool was_built = preconditioner_.refresh(model_);
    if (was_built) forget();
    preconditioner_.correct(model_, enough, correction_);
    return was_built ? preconditioner_.work_of_building() : 0;
  }

  double largest_correction() {
    return std::sqrt(greatest_over_nodes(net_, team_, [&](std::size_t i) { return correction_[i].squaredNorm(); }));
  }

  /// Turns the correction into the accelerated step, unless it is so long that earlier iterates are of no use. turn: of
  /// edges by it.
  void accelerate(double turn) {
    if (turn > greatest_turn)
      forget();
    else if (memory_)
      memory_->accelerate(correction_);
    else
      std::visit([&](auto& anderson) { anderson.accelerate(correction_); }, anderson_);
  }

  /// Moves the nodes. turn: as above. longest: the longest way of a node in the step. True if it had to be shortened.
  bool take_step(double turn, double longest) {
    double share = 1;
    if (turn > greatest_turn) {
      share = greatest_turn / turn;
    } else {
      const double accelerated = turns_.turn(correction_, longest);
      if (accelerated > greatest_turn) {
        forget();
        share = greatest_turn / accelerated;
      }
    }
    parallel_ranges(team_, net_.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) displace(net_, i, share * correction_[i]);
    });
    turns_.moved(share * longest);
    return share < 1;
  }

  Net& net_;
  const Model& model_;
  Preconditioner& preconditioner_;
  ThreadTeam& team_;
  TurnLimit turns_;
  std::variant<Anderson<float>, Anderson<double>> anderson_;
  Anderson<float>* memory_;
  std::vector<Vector3> correction_;
  double expected_ = std::numeric_limits<double>::infinity();  ///< error of the last shape looked at
};

}  // namespace

EquilibriumResult go_to_equilibrium(Net& net, const Model& model, Preconditioner& preconditioner,
                                    const EquilibriumTask& task, ThreadTeam& team, Context& context) {
  return Solver(net, model, preconditioner, team, task.memory).run(task, context);
}

}  // namespace vspring
