#include <algorithm>
#include <cstddef>
#include <limits>

#include "base/cancellation.hpp"
#include "levels/coarsening.hpp"

namespace vspring {

namespace {

// Nodes that a boundary loop keeps, if it has so many: with fewer it is no smooth curve.
constexpr std::size_t least_loop = 6;
// Nodes with more neighbours are kept: no other node could take them all over.
constexpr std::size_t many_neighbours = 12;
// Nodes with fewer neighbours are kept only if no other will do: in a mesh of valences four and eight they would be
// half of all.
constexpr std::size_t few_neighbours = 6;

class IndependentSet {
 public:
  IndependentSet(const Triangulation& triangulation, std::span<const Vector3> places)
      : triangulation_(triangulation), places_(places), state_(triangulation.size(), State::free) {
    if (places.empty()) return;
    shortest_.assign(triangulation.size(), std::numeric_limits<double>::infinity());
    for (std::size_t i = 0; i < triangulation.size(); ++i)
      triangulation.for_each_neighbour(i, [&](std::size_t j) { shortest_[i] = std::min(shortest_[i], square(i, j)); });
  }

  void keep_fixed() {
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      if (triangulation_.kind(i) != Triangulation::Kind::fixed) continue;
      keep(i);
      triangulation_.for_each_neighbour(i, [&](std::size_t j) { keep(j); });
    }
  }

  void keep_constrained(const std::vector<std::uint8_t>& constrained) {
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      const bool wanted = constrained[i] != 0 || triangulation_.ring(i).size() > many_neighbours;
      if (wanted && triangulation_.kind(i) == Triangulation::Kind::closed && is_free(i)) keep(i);
    }
  }

  void keep_loops() {
    std::vector<std::uint8_t> seen(triangulation_.size(), 0);
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      if (triangulation_.kind(i) != Triangulation::Kind::open || seen[i] != 0) continue;
      walk_loop(i, seen);
      thin_loop();
    }
  }

  /// Advances from kept nodes, like a front, over all others.
  void keep_rest() {
    advance();
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      if (!is_free(i)) continue;
      keep(i);
      advance();
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> take() const {
    std::vector<std::uint8_t> kept(state_.size());
    std::transform(state_.begin(), state_.end(), kept.begin(),
                   [](State state) { return static_cast<std::uint8_t>(state == State::kept); });
    return kept;
  }

 private:
  /// waiting: free, and two steps from a kept node.
  enum class State : std::uint8_t { free, waiting, covered, kept };

  [[nodiscard]] bool is_free(std::size_t i) const { return state_[i] == State::free || state_[i] == State::waiting; }

  [[nodiscard]] double square(std::size_t i, std::size_t j) const { return (places_[i] - places_[j]).squaredNorm(); }

  /// Whether one of two neighbours can represent the other.
  [[nodiscard]] bool near(std::size_t i, std::size_t j) const {
    return places_.empty() || square(i, j) <= far_neighbour * far_neighbour * std::max(shortest_[i], shortest_[j]);
  }

  void keep(std::size_t i) {
    if (state_[i] == State::kept) return;
    state_[i] = State::kept;
    triangulation_.for_each_neighbour(i, [&](std::size_t j) {
      if (state_[j] != State::kept && near(i, j)) state_[j] = State::covered;
    });
    triangulation_.for_each_neighbour(i, [&](std::size_t j) {
      if (triangulation_.ring(j).size() > many_neighbours || !near(i, j)) return;
      triangulation_.for_each_neighbour(j, [&](std::size_t k) {
        if (state_[k] != State::free || !near(j, k)) return;
        state_[k] = State::waiting;
        (triangulation_.ring(k).size() < few_neighbours ? later_ : front_).push_back(static_cast<std::uint32_t>(k));
      });
    });
  }

  /// First come, first kept: keeps one node in four. Of all orders tried at this rate none left more valences of six.
  /// Preferring nodes with the most ways to kept ones leaves more, but keeps one node in three and a half.
  void advance() {
    for (;;) {
      const bool later = next_ == front_.size();
      if (later && next_later_ == later_.size()) return;
      const std::uint32_t i = later ? later_[next_later_++] : front_[next_++];
      end_if_cancelled_at(i);
      if (state_[i] == State::waiting) keep(i);
    }
  }

  /// Fills loop_ with the boundary through a node, as far as it goes.
  void walk_loop(std::size_t start, std::vector<std::uint8_t>& seen) {
    loop_.clear();
    for (std::size_t i = start; triangulation_.kind(i) == Triangulation::Kind::open && seen[i] == 0;) {
      seen[i] = 1;
      loop_.push_back(static_cast<std::uint32_t>(i));
      const auto ring = triangulation_.ring(i);
      const bool back = loop_.size() > 1 && ring.back() == loop_[loop_.size() - 2];
      i = back ? ring.front() : ring.back();
    }
  }

  void thin_loop() {
    const std::size_t size = loop_.size();
    const auto node = [&](std::size_t k) { return loop_[k % size]; };
    bool evenly = size < 2 * least_loop;
    for (std::size_t k = 0; k < size; ++k) evenly = evenly && near(node(k), node(k + 1));
    if (evenly) {
      const std::size_t wanted = std::min(size, least_loop);
      for (std::size_t k = 0; k < wanted; ++k) keep(loop_[k * size / wanted]);
      return;
    }
    // Nodes kept already set the rhythm. Where two rhythms meet, there may be three edges between kept nodes instead of
    // two.
    const auto kept = [&](std::size_t k) { return state_[node(k)] == State::kept; };
    const auto is_near_kept = [&](std::size_t k, std::size_t other) { return kept(k) && near(node(k), node(other)); };
    std::size_t begin = 0;
    while (begin < size && !kept(begin)) ++begin;
    if (begin == size) begin = 0;
    for (std::size_t k = begin; k < begin + size; ++k) {
      if (!is_near_kept(k + size - 1, k) && !is_near_kept(k + 1, k)) keep(node(k));
    }
  }

  const Triangulation& triangulation_;
  std::span<const Vector3> places_;
  std::vector<double> shortest_;  ///< squared length of the shortest edge at every node; empty without places
  std::vector<State> state_;
  std::vector<std::uint32_t> front_;
  std::size_t next_ = 0;
  std::vector<std::uint32_t> later_;
  std::size_t next_later_ = 0;
  std::vector<std::uint32_t> loop_;
};

}  // namespace

std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained,
                                              std::span<const Vector3> places) {
  IndependentSet chooser(triangulation, places);
  chooser.keep_fixed();
  chooser.keep_constrained(constrained);
  chooser.keep_loops();
  chooser.keep_rest();
  return chooser.take();
}

}  // namespace vspring
