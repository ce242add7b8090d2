#include "start/winding.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "base/dense_algebra.hpp"
#include "shape/planarity.hpp"

namespace vspring {

namespace {

// Total turn from which on a piece may unwind.
constexpr double least_turn = std::numbers::pi;
// That of space curves, where a bump that should go turns, too.
constexpr double least_turn_in_space = 1.25 * std::numbers::pi;
// Nodes of a piece with which its five unknowns are determined.
constexpr std::size_t enough_nodes = 120;
constexpr double sharpest_turn = 1.8;
// Nodes with which windings are counted: with more, noise may add windings.
constexpr std::size_t enough_to_count = 64;
constexpr int most_corrections = 40;
// Corrections after which the gap must be small, else the search fails.
constexpr int enough_corrections = 12;
// A small gap at the end, in sizes of the piece, and of the tangent there.
constexpr double small = 0.1;
constexpr double closed = 1e-10;
constexpr double nearly_closed = 1e-7;
// In the plane the sum of all turns shows how often a piece winds. If it winds as often but elsewhere, to and fro or in
// a knot at one end, it is bent more and far away, in units of its length.
constexpr double same_winding = 1;
constexpr double far_off = 0.05;
// Factor of bending, as it is measured by parts.
constexpr double seen_bending = 1.05;
// In space: least share of the former turn and bending.
constexpr double less_winding = 0.7;
constexpr double more_bending = 1.5;
// Number of parts of a piece, so that noise does not count as turns.
constexpr std::size_t parts = 24;

/// A turn of the tangent, as a vector across it in a frame carried along without spin.
using Turn = Eigen::Vector2d;

struct Frame3 {
  Vector3 tangent;
  Vector3 first;
  Vector3 second;

  /// across: a direction across the tangent; a curve in the plane perpendicular to it stays there to the bit.
  Frame3(const Vector3& along, const Vector3& across) : tangent(along), first(across.cross(along)), second(across) {}

  /// The axis of a turn; its length is the angle.
  [[nodiscard]] Vector3 axis_of(const Turn& by) const { return by[0] * second - by[1] * first; }

  void turn(const Turn& by) {
    const double angle = by.norm();
    if (!(angle > 0)) return;
    const Eigen::Matrix3d rotation = Eigen::AngleAxisd(angle, axis_of(by) / angle).toRotationMatrix();
    tangent = (rotation * tangent).normalized();
    first = rotation * first;
    first = (first - first.dot(tangent) * tangent).normalized();
    second = tangent.cross(first);
  }

  /// The turn from the tangent to another one.
  [[nodiscard]] Turn turn_to(const Vector3& other) const {
    const Vector3 across = other - other.dot(tangent) * tangent;
    const double sine = across.norm();
    if (!(sine > 0)) return Turn::Zero();
    const double angle = std::atan2(sine, other.dot(tangent));
    return angle / sine * Turn(across.dot(first), across.dot(second));
  }
};

double rms_distance(const std::vector<Vector3>& here, const std::vector<Vector3>& there) {
  double squares = 0;
  for (std::size_t k = 0; k < here.size(); ++k) squares += (there[k] - here[k]).squaredNorm();
  return std::sqrt(squares / static_cast<double>(here.size()));
}

/// A piece of a run as the turns at its nodes, those at its ends from and to the given tangents, and the lengths of
/// its edges.
class Piece {
 public:
  Piece(std::vector<Vector3> places, const Vector3& start_tangent, const Vector3& end_tangent,
        const std::vector<double>& along)
      : places_(std::move(places)), start_(start_tangent), end_(end_tangent), across_(start_.unitOrthogonal()) {
    std::vector<Vector3> spread = places_;
    spread.emplace_back(places_.front() + start_);
    spread.emplace_back(places_.back() + end_);
    if (const auto plane = plane_normal(spread)) {
      across_ = *plane;
      // Turns out of the plane stay zero.
      free_ = {0, 2, 4};
      is_flat_ = true;
    }
    Frame3 frame(start_, across_);
    std::vector<double> before;
    double length = 0;
    for (std::size_t k = 0; k + 1 < places_.size(); ++k) {
      before.push_back(length);
      const Vector3 edge = places_[k + 1] - places_[k];
      const double edge_length = edge.norm();
      length += edge_length;
      turns_.push_back(edge_length > 0 ? frame.turn_to(edge / edge_length) : Turn::Zero());
      winding_ += frame.axis_of(turns_.back());
      frame.turn(turns_.back());
    }
    before.push_back(length);
    turns_.push_back(frame.turn_to(end_));
    winding_ += frame.axis_of(turns_.back());
    const double whole = along.back() - along.front();
    for (std::size_t k = 0; k + 1 < along.size(); ++k) even_.push_back((along[k + 1] - along[k]) / whole * length);
    size_ = length;
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      const double sides = (k > 0 ? even_[k - 1] : 0) + (k < even_.size() ? even_[k] : 0);
      shares_.push_back(size_ > 0 ? sides / 2 / size_ : 0);
      at_.push_back((along[k] - along.front()) / whole - 0.5);
      mean_ += turns_[k];
      // Over the length that the input has there, not where its nodes are to be.
      slope_ += 12 * (before[k] / length - 0.5) * turns_[k];
    }
  }

  /// The total turn, without turns taken back a few nodes on.
  [[nodiscard]] double turned() const {
    double sum = 0;
    for_each_part([&](const Turn& turn, double /*length*/) { sum += turn.norm(); });
    return sum;
  }

  /// Whether the piece turns enough to unwind. A very sharp turn at a node means that it is tangled, not wound.
  [[nodiscard]] bool winds() const {
    const auto sharp = [](const Turn& turn) { return turn.norm() > sharpest_turn; };
    return (is_flat_ ? turned() >= least_turn : winding_.norm() >= least_turn_in_space) &&
           std::none_of(turns_.begin(), turns_.end(), sharp);
  }

  /// The bending, without turns taken back a few nodes on.
  [[nodiscard]] double bending() const {
    double sum = 0;
    for_each_part([&](const Turn& turn, double length) { sum += turn.squaredNorm() / length; });
    return sum;
  }

  /// Whether another piece with the same ends winds less often, or elsewhere.
  [[nodiscard]] bool unwinds_to(const Piece& other) const {
    if (!is_flat_)
      return other.winding_.norm() < less_winding * winding_.norm() || other.bending() > more_bending * bending();
    return (other.winding_ - winding_).norm() > same_winding ||
           (other.bending() > seen_bending * bending() &&
            rms_distance(spread_places(), other.spread_places()) > far_off * size_);
  }

  /// Constant and linear turn, over the whole piece, and the logarithm of its length over that of the input.
  using Unknowns = Eigen::Matrix<double, 5, 1>;

  /// The linear turns that end at the right place and tangent, from those nearest to the input on; none if none were
  /// found.
  [[nodiscard]] std::optional<Unknowns> nearest() const {
    Unknowns start;
    start << mean_, slope_, 0;
    return close(start, most_corrections);
  }

  /// Bends the piece accordingly. False if it does not end as it should.
  bool bend(const Unknowns& unknowns) {
    const std::optional<Unknowns> found = close(unknowns, most_corrections);
    if (found) places_ = bent(*found).places;
    return found.has_value();
  }

  [[nodiscard]] const std::vector<Vector3>& places() const { return places_; }

 private:
  /// Calls look(turn, length) for each part; lengths are shares of the whole.
  template <typename Look>
  void for_each_part(const Look& look) const {
    Turn turn = Turn::Zero();
    double length = 0;
    double begin = 0;
    std::size_t part = 1;
    for (std::size_t k = 0; k < turns_.size(); ++k) {
      turn += turns_[k];
      length += shares_[k];
      if (k + 1 < turns_.size() && (begin + length) * static_cast<double>(parts) < static_cast<double>(part)) continue;
      if (length > 0) look(turn, length);
      turn.setZero();
      begin += length;
      length = 0;
      part = static_cast<std::size_t>(begin * static_cast<double>(parts)) + 1;
    }
  }

  /// The polygon's points at the shares of its length at which nodes are to lie.
  [[nodiscard]] std::vector<Vector3> spread_places() const {
    std::vector<Vector3> result = {places_.front()};
    std::size_t edge = 0;
    double before = 0;
    double wanted = 0;
    for (const double length : even_) {
      wanted += length;
      double here = (places_[edge + 1] - places_[edge]).norm();
      while (before + here < wanted && edge + 2 < places_.size()) {
        before += here;
        ++edge;
        here = (places_[edge + 1] - places_[edge]).norm();
      }
      const double share = here > 0 ? std::min(1.0, (wanted - before) / here) : 1;
      result.emplace_back(places_[edge] + share * (places_[edge + 1] - places_[edge]));
    }
    return result;
  }

  struct Bent {
    std::vector<Vector3> places;
    Vector3 end_tangent;
  };

  [[nodiscard]] Bent bent(const Unknowns& unknowns) const {
    Bent result{.places = {places_.front()}, .end_tangent = {}};
    Frame3 frame(start_, across_);
    for (std::size_t k = 0; k < shares_.size(); ++k) {
      frame.turn(shares_[k] * (unknowns.head<2>() + at_[k] * unknowns.segment<2>(2)));
      if (k == even_.size()) break;
      result.places.emplace_back(result.places.back() + even_[k] * std::exp(unknowns[4]) * frame.tangent);
    }
    result.end_tangent = frame.tangent;
    return result;
  }

  [[nodiscard]] Eigen::VectorXd gap(const Unknowns& unknowns) const {
    const Bent now = bent(unknowns);
    Eigen::VectorXd result(6);
    result << (now.places.back() - places_.back()) / size_, now.end_tangent - end_;
    return result;
  }

  /// Unknowns, near given ones, for which the piece ends at the right place and tangent, by the method of Levenberg and
  /// Marquardt.
  [[nodiscard]] std::optional<Unknowns> close(Unknowns unknowns, int corrections) const {
    constexpr double difference = 1e-6;
    double damping = 1e-3;
    Eigen::VectorXd now = gap(unknowns);
    const auto count = static_cast<Eigen::Index>(free_.size());
    for (int k = 0; k < corrections && now.norm() > closed; ++k) {
      if (k == enough_corrections && now.norm() > small) break;
      Eigen::MatrixXd slopes(6, count);
      for (Eigen::Index j = 0; j < count; ++j) {
        Unknowns moved = unknowns;
        moved[free_[static_cast<std::size_t>(j)]] += difference;
        slopes.col(j) = (gap(moved) - now) / difference;
      }
      const Eigen::VectorXd step =
          damped_solution(slopes.transpose() * slopes, -slopes.transpose() * now, damping * std::min(1.0, now.norm()));
      Unknowns next = unknowns;
      for (Eigen::Index j = 0; j < count; ++j) next[free_[static_cast<std::size_t>(j)]] += step[j];
      const Eigen::VectorXd then = gap(next);
      if (then.allFinite() && then.norm() < now.norm()) {
        unknowns = next;
        now = then;
        damping *= 0.2;
      } else {
        damping = std::max(damping * 10, 1e-8);
        if (damping > 1e6) break;
      }
    }
    if (now.norm() < nearly_closed) return unknowns;
    return std::nullopt;
  }

  std::vector<Vector3> places_;
  Vector3 start_;
  Vector3 end_;
  Vector3 across_;  ///< the normal of its plane, or any direction across its first tangent
  std::vector<Turn> turns_;
  std::vector<double> even_;           ///< lengths of the edges in the end, of the same sum
  std::vector<double> shares_;         ///< of the length at each node
  std::vector<double> at_;             ///< of the length up to each node, from −1/2 to 1/2
  Vector3 winding_ = Vector3::Zero();  ///< sum of the turns about their axes, which noise and bumps hardly add to
  Turn mean_ = Turn::Zero();           ///< the linear turns nearest to those of the input, over the whole piece
  Turn slope_ = Turn::Zero();
  double size_ = 0;
  bool is_flat_ = false;
  std::vector<Eigen::Index> free_ = {0, 1, 2, 3, 4};  ///< the unknowns in use
};

/// Calls look(run, from, to) for each piece of a curve between two held nodes with given tangents that has nodes in
/// between; stops if it returns false.
template <typename Look>
bool for_each_piece(const Net& net, const Look& look) {
  for (const MovingRun& moving_run : net.moving_runs) {
    const std::size_t count = moving_run.nodes.size();
    std::size_t from = 0;
    const auto is_held = [&](std::size_t k) {
      const std::size_t node = moving_run.nodes[k % count];
      return node >= net.moving && net.tangent_given(node);
    };
    for (std::size_t to = 1; to < (moving_run.closed ? count + 1 : count); ++to) {
      const std::size_t node = moving_run.nodes[to % count];
      if (node < net.moving && net.given[node] == 0) continue;
      if (is_held(from) && is_held(to) && to > from + 2 && !look(moving_run, from, to)) return false;
      from = to;
    }
  }
  return true;
}

/// The piece of a run from place `from` to place `to`, by every stride-th node, at `positions`.
Piece piece_of(const Net& net, std::span<const Vector3> positions, const MovingRun& moving_run, std::size_t from,
               std::size_t to, std::size_t stride) {
  const auto& nodes = moving_run.nodes;
  const std::size_t end = nodes[to % nodes.size()];
  std::vector<Vector3> places;
  std::vector<double> at;
  for (std::size_t k = from; k < to; k += stride) {
    places.push_back(positions[nodes[k]]);
    at.push_back(moving_run.along[k]);
  }
  places.push_back(positions[end]);
  at.push_back(moving_run.along[to]);
  return {std::move(places), net.tangents[nodes[from]], net.tangents[end], at};
}

std::size_t stride_for(std::size_t from, std::size_t to, std::size_t nodes) { return (to - from) / nodes + 1; }

}  // namespace

bool lost_winding(const Net& net, std::span<const Vector3> input) {
  return !for_each_piece(net, [&](const MovingRun& moving_run, std::size_t from, std::size_t to) {
    const std::size_t stride = stride_for(from, to, enough_to_count);
    const Piece before = piece_of(net, input, moving_run, from, to, stride);
    return !before.winds() || !before.unwinds_to(piece_of(net, net.positions, moving_run, from, to, stride));
  });
}

bool wind(Net& net) {
  std::vector<Vector3> positions = net.positions;
  bool winds = false;
  const bool all = for_each_piece(net, [&](const MovingRun& moving_run, std::size_t from, std::size_t to) {
    const Piece coarse = piece_of(net, net.positions, moving_run, from, to, stride_for(from, to, enough_nodes));
    if (!coarse.winds()) return true;
    const auto turns = coarse.nearest();
    Piece piece = piece_of(net, net.positions, moving_run, from, to, 1);
    if (!turns || !piece.bend(*turns)) return false;
    winds = true;
    const auto& nodes = moving_run.nodes;
    for (std::size_t k = from + 1; k < to; ++k) positions[nodes[k]] = piece.places()[k - from];
    return true;
  });
  if (winds && all) net.positions = std::move(positions);
  return winds && all;
}

}  // namespace vspring
