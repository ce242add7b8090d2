#include "levels/coarse_nodes.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace vspring {

namespace {

using Kind = Triangulation::Kind;

// Nodes that a boundary loop keeps, if it has them: with fewer it is no smooth curve any more.
constexpr std::size_t least_loop = 6;
// Nodes rated worse than this are all the same.
constexpr std::size_t worst_rating = 31;
// Nodes of more neighbours are kept: no neighbour could take over so many.
constexpr std::size_t many_neighbours = 12;

class Chooser {
 public:
  explicit Chooser(const Triangulation& triangulation)
      : triangulation_(triangulation),
        state_(triangulation.size(), State::free),
        rating_(triangulation.size(), 0),
        ways_(triangulation.size(), 0) {}

  void keep_fixed() {
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      if (triangulation_.kind(i) != Kind::fixed) continue;
      keep(i);
      triangulation_.for_each_neighbour(i, [&](std::size_t j) { keep(j); });
    }
  }

  void keep_constrained(const std::vector<std::uint8_t>& constrained) {
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      const bool wanted = constrained[i] != 0 || triangulation_.ring(i).size() > many_neighbours;
      if (wanted && triangulation_.kind(i) == Kind::closed && state_[i] == State::free) keep(i);
    }
  }

  void keep_loops() {
    std::vector<std::uint8_t> seen(triangulation_.size(), 0);
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      if (triangulation_.kind(i) != Kind::open || seen[i] != 0) continue;
      walk_loop(i, seen);
      thin_loop();
    }
  }

  /// Goes on from what is kept, like a front, over everything else.
  void keep_rest() {
    advance();
    for (std::size_t i = 0; i < triangulation_.size(); ++i) {
      if (state_[i] != State::free) continue;
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
  enum class State : std::uint8_t { free, covered, kept };

  /// Nodes waiting to be looked at, first come, first served.
  struct Queue {
    std::vector<std::uint32_t> nodes;
    std::size_t next = 0;
  };

  void keep(std::size_t i) {
    if (state_[i] == State::kept) return;
    state_[i] = State::kept;
    triangulation_.for_each_neighbour(i, [&](std::size_t j) {
      if (state_[j] == State::free) state_[j] = State::covered;
    });
    // A node two steps away along a straight line is reached in one way, one in between in two. The squares of the
    // numbers of ways are summed, so the straight ones come first and rows go on.
    reached_.clear();
    triangulation_.for_each_neighbour(i, [&](std::size_t j) {
      if (triangulation_.ring(j).size() > many_neighbours) return;
      triangulation_.for_each_neighbour(j, [&](std::size_t k) {
        if (state_[k] != State::free) return;
        if (ways_[k]++ == 0) reached_.push_back(static_cast<std::uint32_t>(k));
      });
    });
    for (const std::uint32_t k : reached_) {
      const std::size_t ways = std::exchange(ways_[k], 0U);
      rating_[k] = static_cast<std::uint8_t>(std::min(worst_rating, rating_[k] + ways * ways));
      queues_[rating_[k]].nodes.push_back(k);
      lowest_ = std::min<std::size_t>(lowest_, rating_[k]);
    }
  }

  void advance() {
    while (lowest_ <= worst_rating) {
      Queue& queue = queues_[lowest_];
      if (queue.next == queue.nodes.size()) {
        queue.nodes.clear();
        queue.next = 0;
        ++lowest_;
        continue;
      }
      const std::uint32_t i = queue.nodes[queue.next++];
      if (state_[i] == State::free && rating_[i] == lowest_) keep(i);
    }
  }

  /// Fills loop_ with the boundary through a node, as far as it goes.
  void walk_loop(std::size_t start, std::vector<std::uint8_t>& seen) {
    loop_.clear();
    for (std::size_t i = start; triangulation_.kind(i) == Kind::open && seen[i] == 0;) {
      seen[i] = 1;
      loop_.push_back(static_cast<std::uint32_t>(i));
      const auto ring = triangulation_.ring(i);
      const bool back = loop_.size() > 1 && ring.back() == loop_[loop_.size() - 2];
      i = back ? ring.front() : ring.back();
    }
  }

  void thin_loop() {
    const std::size_t size = loop_.size();
    if (size < 2 * least_loop) {
      const std::size_t wanted = std::min(size, least_loop);
      for (std::size_t k = 0; k < wanted; ++k) keep(loop_[k * size / wanted]);
      return;
    }
    // Nodes kept already give the beat. Where two beats meet, two edges between kept nodes may be three.
    const auto kept = [&](std::size_t k) { return state_[loop_[k % size]] == State::kept; };
    std::size_t begin = 0;
    while (begin < size && !kept(begin)) ++begin;
    if (begin == size) begin = 0;
    for (std::size_t k = begin; k < begin + size; ++k) {
      if (!kept(k + size - 1) && !kept(k + 1)) keep(loop_[k % size]);
    }
  }

  const Triangulation& triangulation_;
  std::vector<State> state_;
  std::vector<std::uint8_t> rating_;
  std::vector<std::uint32_t> ways_;
  std::vector<std::uint32_t> reached_;
  std::vector<std::uint32_t> loop_;
  std::array<Queue, worst_rating + 1> queues_;
  std::size_t lowest_ = worst_rating + 1;
};

}  // namespace

std::vector<std::uint8_t> choose_coarse_nodes(const Triangulation& triangulation,
                                              const std::vector<std::uint8_t>& constrained) {
  Chooser chooser(triangulation);
  chooser.keep_fixed();
  chooser.keep_constrained(constrained);
  chooser.keep_loops();
  chooser.keep_rest();
  return chooser.take();
}

}  // namespace vspring
