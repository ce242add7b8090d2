#include "levels/coarsening.hpp"

#include <algorithm>
#include <limits>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

constexpr std::size_t least_piece = 4096;
constexpr std::size_t pieces_wanted = 16;
constexpr int most_passes = 4;
constexpr std::size_t none = static_cast<std::size_t>(-1);

class Coarsening {
 public:
  Coarsening(Triangulation& triangulation, std::vector<std::uint8_t>& kept, std::span<const Vector3> places)
      : triangulation_(triangulation), kept_(kept), places_(places) {}

  /// Removes the nodes of a run whose neighbours all lie in the run. Returns the others.
  std::vector<std::uint32_t> remove_within(std::size_t begin, std::size_t end, Removals& removals) {
    std::vector<std::uint32_t> waiting;
    std::vector<std::uint32_t> outside;
    for (std::size_t i = begin; i < end; ++i) {
      if (kept_[i] == 0) waiting.push_back(static_cast<std::uint32_t>(i));
    }
    remove(waiting, removals, [&](std::uint32_t i) {
      const auto ring = triangulation_.ring(i);
      const bool inside = std::all_of(ring.begin(), ring.end(), [&](std::uint32_t j) { return j >= begin && j < end; });
      if (!inside) outside.push_back(i);
      return inside;
    });
    outside.insert(outside.end(), waiting.begin(), waiting.end());
    std::sort(outside.begin(), outside.end());
    return outside;
  }

  void remove_rest(std::vector<std::uint32_t>& waiting, Removals& removals) {
    remove(waiting, removals, [](std::uint32_t) { return true; });
    for (const std::uint32_t i : waiting) kept_[i] = 1;
  }

  void even_out() {
    for (int pass = 0; pass < most_passes; ++pass) {
      std::size_t flips = 0;
      for (std::size_t i = 0; i < triangulation_.size(); ++i) {
        end_if_cancelled_at(i);
        if (kept_[i] != 0 && triangulation_.kind(i) != Triangulation::Kind::fixed) flips += flip_around(i);
      }
      if (flips == 0) return;
    }
  }

 private:
  template <typename Allowed>
  void remove(std::vector<std::uint32_t>& waiting, Removals& removals, const Allowed& allowed) {
    for (int pass = 0; pass < most_passes; ++pass) {
      std::size_t left = 0;
      const std::size_t before = waiting.size();
      for (const std::uint32_t i : waiting) {
        end_if_cancelled_at(i);
        if (!allowed(i)) continue;
        const std::size_t place = best_place(i, pass > 0);
        if (place == none) {
          waiting[left++] = i;
          continue;
        }
        removals.add(i, triangulation_.ring(i));
        triangulation_.collapse(i, place);
      }
      waiting.resize(left);
      if (left == 0 || left == before) return;
    }
  }

  /// The neighbour to collapse a node into: a kept one, so that edges of the coarse level join neighbouring cells of
  /// collapsed nodes; of those not far away the one with the fewest neighbours.
  [[nodiscard]] std::size_t best_place(std::uint32_t i, bool any) const {
    const auto ring = triangulation_.ring(i);
    std::size_t best = none;
    std::size_t fewest = none;
    const double far = far_neighbour * far_neighbour * nearest_kept(i);
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const std::size_t neighbours = triangulation_.ring(ring[k]).size() + (kept_[ring[k]] != 0 ? 0 : 1000) +
                                     (places_.empty() || square(i, ring[k]) <= far ? 0 : 500);
      if ((kept_[ring[k]] == 0 && !any) || neighbours >= fewest || !triangulation_.can_collapse(i, k)) continue;
      fewest = neighbours;
      best = k;
    }
    return best;
  }

  [[nodiscard]] double square(std::uint32_t i, std::uint32_t j) const {
    return (places_[i] - places_[j]).squaredNorm();
  }

  /// The squared distance of the nearest kept neighbour.
  [[nodiscard]] double nearest_kept(std::uint32_t i) const {
    double nearest = std::numeric_limits<double>::infinity();
    if (places_.empty()) return nearest;
    for (const std::uint32_t j : triangulation_.ring(i)) {
      if (kept_[j] != 0) nearest = std::min(nearest, square(i, j));
    }
    return nearest;
  }

  /// The number of neighbours beyond the ideal one.
  [[nodiscard]] long excess(std::uint32_t i) const {
    return static_cast<long>(triangulation_.ring(i).size()) -
           (triangulation_.kind(i) == Triangulation::Kind::closed ? 6 : 4);
  }

  std::size_t flip_around(std::size_t i) {
    std::size_t flips = 0;
    for (std::size_t k = 0; k < triangulation_.ring(i).size(); ++k) {
      if (!worth_flipping(i, k)) continue;
      triangulation_.flip(i, k);
      ++flips;
    }
    return flips;
  }

  [[nodiscard]] bool worth_flipping(std::size_t i, std::size_t place) const {
    const auto ring = triangulation_.ring(i);
    const std::size_t size = ring.size();
    const bool open = triangulation_.kind(i) == Triangulation::Kind::open;
    if (ring[place] < i || (open && (place == 0 || place + 1 == size))) return false;
    const auto a = static_cast<std::uint32_t>(i);
    const std::uint32_t b = ring[place];
    const std::uint32_t c = ring[place > 0 ? place - 1 : size - 1];
    const std::uint32_t d = ring[place + 1 < size ? place + 1 : 0];
    for (const std::uint32_t j : {b, c, d}) {
      if (triangulation_.kind(j) == Triangulation::Kind::fixed) return false;
    }
    // The sum of squares must fall.
    if (excess(a) + excess(b) - excess(c) - excess(d) <= 2) return false;
    if (triangulation_.kind(c) == Triangulation::Kind::open && triangulation_.kind(d) == Triangulation::Kind::open)
      return false;
    const auto can_lose_one = [&](std::uint32_t j) {
      return triangulation_.ring(j).size() > Triangulation::fewest(triangulation_.kind(j));
    };
    const auto can_gain_one = [&](std::uint32_t j) { return triangulation_.ring(j).size() < triangulation_.room(j); };
    return can_lose_one(a) && can_lose_one(b) && can_gain_one(c) && can_gain_one(d) && !triangulation_.joined(c, d);
  }

  Triangulation& triangulation_;
  std::vector<std::uint8_t>& kept_;
  std::span<const Vector3> places_;
};

}  // namespace

std::vector<Removals> coarsen(Triangulation& triangulation, std::vector<std::uint8_t>& kept, ThreadTeam& team,
                              std::span<const Vector3> places) {
  const std::size_t nodes = triangulation.size();
  const std::size_t piece = std::max(least_piece, (nodes + pieces_wanted - 1) / pieces_wanted);
  const std::size_t pieces = (nodes + piece - 1) / piece;
  std::vector<Removals> removals(pieces + 1);
  std::vector<std::vector<std::uint32_t>> left(pieces);
  Coarsening coarsening(triangulation, kept, places);
  parallel_ranges(team, nodes, piece, [&](std::size_t begin, std::size_t end) {
    left[begin / piece] = coarsening.remove_within(begin, end, removals[begin / piece]);
    removals[begin / piece].close();
  });
  std::vector<std::uint32_t> rest;
  for (const auto& part : left) rest.insert(rest.end(), part.begin(), part.end());
  coarsening.remove_rest(rest, removals.back());
  coarsening.even_out();
  return removals;
}

}  // namespace vspring
