#include "equilibrium/elastica.hpp"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>
#include <vector>

#include "base/cancellation.hpp"
#include "shape/planarity.hpp"

namespace vspring {

namespace {

// Radians, of an edge in one step.
constexpr double most_turn_of_edge = 0.5;
// Of the bending that straightens all edges at once, what is added to the second derivative: at first, where steps fail
// at least, by how much it grows then and shrinks after a step, and beyond which there is no way down.
constexpr double damping_at_first = 0.01;
constexpr double damping_at_least = 1e-4;
constexpr double damping_factor = 4;
constexpr double damping_at_most = 1e8;
// A piece ends where it should to this share of its length.
constexpr double closed = 1e-12;
constexpr int most_closings = 40;
constexpr int most_newton_steps = 20;
// Pieces that are longer than their chords by no greater share stay straight, as a single edge does.
constexpr double straight = 1e-8;
// In the diagonal: a closed curve may turn as a whole, and the chord of a straight piece cannot become longer.
constexpr double unseen = 1e-10;
constexpr double unseen_length = 1e-14;
// And the energies of a step, in iterations of the equilibrium solver.
constexpr double work_of_step = 5;

/// One run of a curve, as the directions of its edges.
class Wire {
 public:
  Wire(Net& net, const MovingRun& moving_run) : net_(net), run_(moving_run) {
    edges_ = run_.closed ? run_.nodes.size() : run_.nodes.size() - 1;
    find_pieces();
    find_bends();
    number_unknowns();
  }

  /// Moves the nodes. result: outcome, iterations, work and expected error are added to.
  void run(const EquilibriumTask& task, EquilibriumResult& result) {
    const Outcome outcome = relax(task, result);
    if (outcome != Outcome::converged) result.outcome = outcome;
    if (is_closed_) place();
  }

 private:
  /// Edges between two held nodes that follow each other, or all of a run, or those beyond the outermost held node.
  struct Piece {
    std::size_t begin;
    std::size_t end;
    Vector3 chord = Vector3::Zero();
    bool is_held = false;  ///< at both ends: the chord is kept
    double length = 0;
    Eigen::Index row = 0;  ///< of its multipliers
  };

  /// Between two edges that follow each other.
  struct Bend {
    std::size_t before;
    std::size_t after;
    double weight;
  };

  /// Between an edge and a given tangent.
  struct End {
    std::size_t edge;
    Vector3 tangent;
    double weight;
  };

  [[nodiscard]] std::size_t node(std::size_t place) const { return run_.nodes[place % run_.nodes.size()]; }
  [[nodiscard]] const Vector3& position(std::size_t place) const { return net_.positions[node(place)]; }
  [[nodiscard]] bool is_held(std::size_t place) const { return node(place) >= net_.moving; }

  void find_pieces() {
    lengths_.resize(edges_);
    directions_.resize(edges_);
    for (std::size_t begin = 0; begin < edges_;) {
      std::size_t end = begin + 1;
      while (end < edges_ && !is_held(end)) ++end;
      Piece piece{.begin = begin, .end = end};
      // A closed run begins with a held node, if it has any.
      piece.is_held = run_.closed || (is_held(begin) && is_held(end));
      piece.chord = position(end) - position(begin);
      double places = 0;
      for (std::size_t k = begin; k < end; ++k) {
        const Vector3 edge = position(k + 1) - position(k);
        const double length = edge.norm();
        directions_[k] = length > 0 ? Vector3(edge / length) : k > begin ? directions_[k - 1] : Vector3::UnitX();
        piece.length += length;
        places += run_.along[k + 1] - run_.along[k];
      }
      for (std::size_t k = begin; k < end; ++k)
        lengths_[k] = piece.length * (run_.along[k + 1] - run_.along[k]) / places;
      length_ += piece.length;
      pieces_.push_back(piece);
      begin = end;
    }
  }

  void find_bends() {
    std::vector<Vector3> spread;
    for (std::size_t k = 0; k < run_.nodes.size(); ++k) {
      const bool has_before = k > 0 || run_.closed;
      const bool has_after = k < edges_;
      const std::size_t before = k > 0 ? k - 1 : edges_ - 1;
      spread.push_back(position(k));
      if (net_.tangent_given(node(k)) || net_.normal_given(node(k))) {
        const Vector3 tangent = given_tangent(k, has_before ? before : k, has_after ? k : before);
        spread.emplace_back(position(k) + tangent);
        if (has_before) ends_.push_back({before, tangent, 2 * length_ / lengths_[before]});
        if (has_after) ends_.push_back({k, tangent, 2 * length_ / lengths_[k]});
      } else if (has_before && has_after) {
        bends_.push_back({before, k, 2 * length_ / (lengths_[before] + lengths_[k])});
      }
    }
    axes_.setIdentity(3, 3);
    if (const auto plane = plane_normal(spread)) {
      plane_ = *plane;
      axes_.resize(3, 2);
      axes_.col(0) = plane->unitOrthogonal();
      axes_.col(1) = plane->cross(Vector3(axes_.col(0)));
    }
  }

  /// Across a given normal the curve goes on as it does.
  [[nodiscard]] Vector3 given_tangent(std::size_t place, std::size_t before, std::size_t after) const {
    const std::size_t i = node(place);
    if (net_.tangent_given(i)) return net_.tangents[i];
    const Vector3 along = directions_[before] + directions_[after];
    return (along - along.dot(net_.normals[i]) * net_.normals[i]).normalized();
  }

  /// The multipliers of a piece after its edges, so that the matrix is a band but for these.
  void number_unknowns() {
    columns_.assign(edges_, 0);
    for (Piece& piece : pieces_) {
      const double chord = piece.chord.norm();
      const bool stays = piece.is_held && chord > 0 && piece.length <= (1 + straight) * chord;
      for (std::size_t k = piece.begin; k < piece.end; ++k) {
        if (stays) {
          directions_[k] = piece.chord / chord;
          lengths_[k] *= chord / piece.length;
        }
        columns_[k] = stays ? -1 : unknowns_;
        unknowns_ += stays ? 0 : turns();
      }
      piece.is_held = piece.is_held && !stays;
      piece.row = unknowns_;
      if (!piece.is_held) continue;
      unknowns_ += axes_.cols();
      multipliers_ += axes_.cols();
    }
  }

  /// Ways in which a direction may turn.
  [[nodiscard]] Eigen::Index turns() const { return plane_ ? 1 : 2; }

  void find_frames() {
    frames_.resize(edges_);
    for (std::size_t k = 0; k < edges_; ++k) {
      const Vector3& direction = directions_[k];
      const Vector3 first = plane_ ? Vector3(plane_->cross(direction)) : direction.unitOrthogonal();
      frames_[k] = {first, direction.cross(first)};
    }
  }

  [[nodiscard]] double energy() const {
    double sum = 0;
    for (const Bend& bend : bends_)
      sum += bend.weight * (directions_[bend.after] - directions_[bend.before]).squaredNorm();
    for (const End& end : ends_) sum += end.weight * (directions_[end.edge] - end.tangent).squaredNorm();
    return sum / 2;
  }

  /// What bends ask of each direction, before that is kept to unit length.
  [[nodiscard]] std::vector<Vector3> pulls() const {
    std::vector<Vector3> pulls(edges_, Vector3::Zero());
    for (const Bend& bend : bends_) {
      pulls[bend.before] += bend.weight * directions_[bend.after];
      pulls[bend.after] += bend.weight * directions_[bend.before];
    }
    for (const End& end : ends_) pulls[end.edge] += end.weight * end.tangent;
    return pulls;
  }

  /// By how much bending falls where a direction turns.
  [[nodiscard]] Eigen::VectorXd slopes() const {
    Eigen::VectorXd slopes = Eigen::VectorXd::Zero(unknowns_);
    const std::vector<Vector3> pulls = this->pulls();
    for (std::size_t k = 0; k < edges_; ++k) {
      for (Eigen::Index a = 0; columns_[k] >= 0 && a < turns(); ++a)
        slopes[columns_[k] + a] = frame(k, a).dot(pulls[k]);
    }
    return slopes;
  }

  /// Factors the second derivative, with that much of the bending which straightens all edges; at infinity that alone.
  /// False where that fails.
  bool factor(double damping) {
    std::vector<double> stiffness(edges_, 0);
    const bool is_metric = std::isinf(damping);
    const double share = is_metric ? 1 : 1 + damping;
    std::vector<Eigen::Triplet<double>> entries;
    const auto put = [&](Eigen::Index row, Eigen::Index column, double value) {
      entries.emplace_back(static_cast<int>(std::max(row, column)), static_cast<int>(std::min(row, column)), value);
    };
    for (const Bend& bend : bends_) {
      stiffness[bend.before] += bend.weight;
      stiffness[bend.after] += bend.weight;
      if (columns_[bend.before] < 0 || columns_[bend.after] < 0) continue;
      for (Eigen::Index a = 0; a < turns(); ++a) {
        for (Eigen::Index b = 0; b < turns(); ++b)
          put(columns_[bend.before] + a, columns_[bend.after] + b,
              -share * bend.weight * frame(bend.before, a).dot(frame(bend.after, b)));
      }
    }
    for (const End& end : ends_) stiffness[end.edge] += end.weight;
    const std::vector<Vector3> pulls = is_metric ? std::vector<Vector3>() : this->pulls();
    for (const Piece& piece : pieces_) {
      for (std::size_t k = piece.begin; k < piece.end; ++k) {
        if (columns_[k] < 0) continue;
        const double share_of_piece = lengths_[k] / piece.length;
        double curvature = stiffness[k];
        if (!is_metric) {
          curvature = directions_[k].dot(pulls[k]) + damping * stiffness[k];
          if (piece.is_held) curvature -= share_of_piece * directions_[k].dot(force(piece));
        }
        for (Eigen::Index a = 0; a < turns(); ++a) {
          put(columns_[k] + a, columns_[k] + a, curvature + unseen * stiffness[k]);
          for (Eigen::Index axis = 0; piece.is_held && axis < axes_.cols(); ++axis)
            put(piece.row + axis, columns_[k] + a, share_of_piece * axes_.col(axis).dot(frame(k, a)));
        }
      }
      for (Eigen::Index axis = 0; piece.is_held && axis < axes_.cols(); ++axis)
        put(piece.row + axis, piece.row + axis, -unseen_length);
    }
    Eigen::SparseMatrix<double> matrix(unknowns_, unknowns_);
    matrix.setFromTriplets(entries.begin(), entries.end());
    Factor& factor = is_metric ? metric_ : factor_;
    factor.compute(matrix);
    return factor.info() == Eigen::Success;
  }

  /// As many negative pivots as multipliers: a minimum among the directions that keep the chords.
  [[nodiscard]] bool has_minimum() const { return (factor_.vectorD().array() < 0).count() == multipliers_; }

  [[nodiscard]] const Vector3& frame(std::size_t edge, Eigen::Index way) const {
    return frames_[edge][static_cast<std::size_t>(way)];
  }

  [[nodiscard]] Vector3 force(const Piece& piece) const { return axes_ * forces_.segment(piece.row, axes_.cols()); }

  /// How far pieces are from their chords, in shares of their lengths, in the rows of the multipliers.
  [[nodiscard]] Eigen::VectorXd gaps() const {
    Eigen::VectorXd gaps = Eigen::VectorXd::Zero(unknowns_);
    for (const Piece& piece : pieces_) {
      if (!piece.is_held) continue;
      Vector3 gap = -piece.chord;
      for (std::size_t k = piece.begin; k < piece.end; ++k) gap += lengths_[k] * directions_[k];
      gaps.segment(piece.row, axes_.cols()) = axes_.transpose() * gap / piece.length;
    }
    return gaps;
  }

  /// Turns the directions from those at which frames were found.
  void turn(const std::vector<Vector3>& from, const Eigen::VectorXd& by) {
    for (std::size_t k = 0; k < edges_; ++k) {
      if (columns_[k] < 0) continue;
      Vector3 way = Vector3::Zero();
      for (Eigen::Index a = 0; a < turns(); ++a) way += by[columns_[k] + a] * frame(k, a);
      const double angle = way.norm();
      directions_[k] = from[k];
      if (angle > 0) directions_[k] = (std::cos(angle) * from[k] + std::sin(angle) / angle * way).normalized();
    }
  }

  /// The largest turn of an edge.
  [[nodiscard]] double largest(const Eigen::VectorXd& step) const {
    double largest = 0;
    for (std::size_t k = 0; k < edges_; ++k) {
      if (columns_[k] >= 0) largest = std::max(largest, step.segment(columns_[k], turns()).norm());
    }
    return largest;
  }

  /// Of a node, at most.
  [[nodiscard]] double longest_way(const Eigen::VectorXd& step) const {
    double longest = 0;
    for (const Piece& piece : pieces_) {
      double turn = 0;
      for (std::size_t k = piece.begin; k < piece.end; ++k) {
        if (columns_[k] >= 0) turn = std::max(turn, step.segment(columns_[k], turns()).norm());
      }
      longest = std::max(longest, turn * piece.length);
    }
    return longest;
  }

  /// Turns by a step and on until pieces are at their chords, straightening edges as evenly as may be. False where they
  /// do not get there.
  bool go(const std::vector<Vector3>& from, Eigen::VectorXd step) {
    turn(from, step);
    for (int k = 0; k < most_closings; ++k) {
      const Eigen::VectorXd gaps = this->gaps();
      if (!gaps.allFinite()) return false;
      if (gaps.lpNorm<Eigen::Infinity>() < closed) return true;
      step += metric_.solve(-gaps);
      turn(from, step);
    }
    return false;
  }

  /// From where edges have other lengths than the start's.
  bool close() {
    for (int k = 0; k < most_closings; ++k) {
      const Eigen::VectorXd gaps = this->gaps();
      if (gaps.lpNorm<Eigen::Infinity>() < closed) return true;
      find_frames();
      if (!factor(std::numeric_limits<double>::infinity())) return false;
      Eigen::VectorXd step = metric_.solve(-gaps);
      if (!step.allFinite()) return false;
      step *= std::min(1.0, most_turn_of_edge / std::max(largest(step), most_turn_of_edge));
      turn(std::vector<Vector3>(directions_), step);
    }
    return false;
  }

  Outcome relax(const EquilibriumTask& task, EquilibriumResult& result) {
    is_closed_ = close();
    if (!is_closed_) return Outcome::stalled;
    const double at_first = energy();
    double bending = at_first;
    double damping = damping_at_first;
    for (int k = 0; k < task.max_iterations; ++k) {
      // Noise is gone after one step, or after some.
      if (std::has_single_bit(static_cast<unsigned>(k)) && go_to_nearest(task, at_first, result))
        return Outcome::converged;
      if (result.work + work_of_step > task.most_work) return Outcome::work_limit;
      end_if_cancelled();
      const Eigen::VectorXd slopes = look_around();
      while (!factor(damping) || !has_minimum()) {
        damping = std::max(damping_factor * damping, damping_at_least);
        if (damping > damping_at_most) return Outcome::stalled;
      }
      const Step step = step_along(slopes, task, result);
      if (!std::isfinite(step.size)) return Outcome::stalled;
      const bool is_there = step.longest_way < task.tolerance && damping <= damping_at_first;
      const std::vector<Vector3> from = directions_;
      const double now = go(from, step.turns) ? energy() : std::numeric_limits<double>::infinity();
      if (now <= bending * (1 + std::numeric_limits<double>::epsilon() * static_cast<double>(edges_))) {
        bending = now;
        if (step.share == 1) damping = damping / damping_factor < damping_at_least ? 0 : damping / damping_factor;
      } else {
        directions_ = from;
        damping = std::max(damping_factor * damping, damping_at_least);
        if (damping > damping_at_most) return Outcome::stalled;
      }
      if (is_there) return arrived(step, result);
    }
    return Outcome::iteration_limit;
  }

  /// By Newton's steps alone to the nearest elastica, which in space need not be the one that is bent least: a helix is
  /// one. False, and nothing changed, where they do not lead to one that is bent no more.
  bool go_to_nearest(const EquilibriumTask& task, double most_bending, EquilibriumResult& result) {
    const std::vector<Vector3> start = directions_;
    for (int k = 0; k < most_newton_steps && result.work + work_of_step <= task.most_work; ++k) {
      end_if_cancelled();
      const Eigen::VectorXd slopes = look_around();
      if (!factor(0)) break;
      const Step step = step_along(slopes, task, result);
      if (!std::isfinite(step.size) || !go(std::vector<Vector3>(directions_), step.turns)) break;
      if (step.longest_way >= task.tolerance) continue;
      if (energy() > most_bending) break;
      arrived(step, result);
      return true;
    }
    directions_ = start;
    return false;
  }

  /// Where bending falls to from here, and the forces that leave least of that.
  Eigen::VectorXd look_around() {
    find_frames();
    Eigen::VectorXd slopes = this->slopes();
    (void)factor(std::numeric_limits<double>::infinity());
    forces_ = metric_.solve(slopes);
    return slopes;
  }

  struct Step {
    Eigen::VectorXd turns;
    double size;   ///< the largest turn
    double share;  ///< to which it is shortened
    double longest_way;
  };

  /// By the last factor.
  Step step_along(const Eigen::VectorXd& slopes, const EquilibriumTask& task, EquilibriumResult& result) {
    ++result.iterations;
    result.work += work_of_step;
    Step step{.turns = factor_.solve(slopes), .size = 0, .share = 1, .longest_way = 0};
    step.size = largest(step.turns);
    step.longest_way = longest_way(step.turns);
    step.share = std::min(1.0, most_turn_of_edge / std::max(step.size, most_turn_of_edge));
    step.turns *= step.share;
    if (task.on_iteration) task.on_iteration(step.longest_way);
    return step;
  }

  static Outcome arrived(const Step& step, EquilibriumResult& result) {
    result.expected_error = std::max(result.expected_error, step.longest_way);
    return Outcome::converged;
  }

  /// Nodes by the directions, from the first held one; without any, about the same centre.
  void place() {
    const std::size_t count = run_.nodes.size();
    std::size_t first = 0;
    while (first < count && !is_held(first)) ++first;
    const bool is_free = first == count;
    if (is_free) first = 0;
    Vector3 before = Vector3::Zero();
    for (std::size_t k = 0; k < count; ++k) before += position(k);
    for (std::size_t k = first; k > 0; --k)
      net_.positions[node(k - 1)] = position(k) - lengths_[k - 1] * directions_[k - 1];
    for (std::size_t k = first; k + 1 < count; ++k) {
      if (!is_held(k + 1)) net_.positions[node(k + 1)] = position(k) + lengths_[k] * directions_[k];
    }
    if (!is_free) return;
    Vector3 after = Vector3::Zero();
    for (std::size_t k = 0; k < count; ++k) after += position(k);
    for (std::size_t k = 0; k < count; ++k) net_.positions[node(k)] += (before - after) / static_cast<double>(count);
  }

  Net& net_;
  const MovingRun& run_;
  std::size_t edges_ = 0;
  std::vector<double> lengths_;  ///< of the edges
  double length_ = 0;            ///< of all
  std::vector<Vector3> directions_;
  std::vector<Piece> pieces_;
  std::vector<Bend> bends_;
  std::vector<End> ends_;
  std::optional<Vector3> plane_;                   ///< its normal
  Eigen::Matrix<double, 3, Eigen::Dynamic> axes_;  ///< of the space of the curve
  std::vector<Eigen::Index> columns_;              ///< per edge its first unknown; −1: it stays
  Eigen::Index unknowns_ = 0;
  Eigen::Index multipliers_ = 0;
  std::vector<std::array<Vector3, 2>> frames_;  ///< across the directions
  Eigen::VectorXd forces_;                      ///< in the rows of the multipliers
  bool is_closed_ = false;                      ///< whether pieces are at their chords
  using Factor = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>, Eigen::Lower, Eigen::NaturalOrdering<int>>;
  Factor factor_;
  Factor metric_;  ///< of the bending that straightens all edges
};

}  // namespace

EquilibriumResult relax_to_elastica(Net& net, const EquilibriumTask& task, Context& context) {
  EquilibriumResult result;
  result.outcome = Outcome::converged;
  try {
    const CancellationScope cancellation(context);
    for (const MovingRun& moving_run : net.moving_runs) Wire(net, moving_run).run(task, result);
  } catch (const Cancelled&) {
    result.outcome = Outcome::cancelled;
  }
  return result;
}

}  // namespace vspring
