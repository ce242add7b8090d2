#include "curve_fit/curvature_swings.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "fairness/extrema.hpp"

namespace vspring {

namespace {

// So that what is left can surely not be seen.
constexpr double share_of_visible = 0.5;

}  // namespace

CurvatureSwings::CurvatureSwings(std::span<const CurvatureRun> runs) {
  double squares = 0;
  double length = 0;
  for (const CurvatureRun& run : runs) {
    for (const CurvatureStation& one : run.stations) {
      squares += one.curvature * one.curvature * one.length;
      length += one.length;
    }
  }
  if (!(length > 0)) return;
  const double visible =
      std::max(share_of_visible * visible_share * std::sqrt(squares / length), visible_curvature / length);
  for (const CurvatureRun& run : runs) runs_.push_back(swings_of(run, visible));
}

CurvatureSwings::Swings CurvatureSwings::swings_of(const CurvatureRun& run, double visible) {
  const std::size_t count = run.stations.size();
  const auto value_at = [&](std::size_t k) { return run.stations[k % count].curvature; };
  Swings swings{.turns = {}, .links = run.link_count(), .closed = run.closed};
  // Around a closed run from its lowest station back to it.
  std::size_t begin = 0;
  for (std::size_t k = 1; k < count && run.closed; ++k) {
    if (value_at(k) < value_at(begin)) begin = k;
  }
  Turn low{begin, value_at(begin)};
  Turn high = low;
  int direction = 0;
  for (std::size_t k = begin + 1; k <= begin + swings.links; ++k) {
    const double value = value_at(k);
    if (direction >= 0 && value > high.value) high = {k, value};
    if (direction <= 0 && value < low.value) low = {k, value};
    if (direction <= 0 && value - low.value > visible) {
      swings.turns.push_back(low);
      direction = 1;
      high = {k, value};
    } else if (direction >= 0 && high.value - value > visible) {
      swings.turns.push_back(high);
      direction = -1;
      low = {k, value};
    }
  }
  swings.turns.push_back(direction >= 0 ? high : low);
  return swings;
}

std::size_t CurvatureSwings::extremes() const {
  std::size_t sum = 0;
  for (const Swings& run : runs_) {
    const std::size_t swings = run.turns.size() - 1;
    sum += run.closed ? swings : swings - (swings > 0 ? 1 : 0);
  }
  return sum;
}

std::optional<std::vector<int>> CurvatureSwings::without(std::size_t rank) const {
  std::vector<std::tuple<double, std::size_t, std::size_t>> all;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    const auto& turns = runs_[r].turns;
    // A closed run has two at least; its first turn is its last.
    const std::size_t spare = runs_[r].closed ? 1 : 0;
    if (turns.size() < (runs_[r].closed ? 5 : 3)) continue;
    for (std::size_t k = spare; k + 1 + spare < turns.size(); ++k)
      all.emplace_back(std::abs(turns[k + 1].value - turns[k].value), r, k);
  }
  if (rank >= all.size()) return std::nullopt;
  std::nth_element(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(rank), all.end());
  const auto [size, run_left_out, swing] = all[rank];
  std::vector<int> senses;
  for (std::size_t r = 0; r < runs_.size(); ++r) {
    Swings run = runs_[r];
    if (r == run_left_out) leave_out(run, swing);
    const std::size_t before = senses.size();
    senses.resize(before + run.links, 0);
    if (run.turns.size() < 2) continue;
    const std::size_t begin = run.closed ? run.turns.front().at : 0;
    std::size_t piece = 0;
    for (std::size_t k = begin; k < begin + run.links; ++k) {
      while (piece + 2 < run.turns.size() && k >= run.turns[piece + 1].at) ++piece;
      senses[before + k % run.links] = run.turns[piece + 1].value > run.turns[piece].value ? 1 : -1;
    }
  }
  return senses;
}

/// Both turns of one inside, and at an end the outer one.
void CurvatureSwings::leave_out(Swings& swings, std::size_t swing) {
  auto& turns = swings.turns;
  const auto first = turns.begin() + static_cast<std::ptrdiff_t>(swing);
  if (!swings.closed && swing == 0)
    turns.erase(first);
  else if (!swings.closed && swing + 2 == turns.size())
    turns.pop_back();
  else
    turns.erase(first, first + 2);
}

}  // namespace vspring
