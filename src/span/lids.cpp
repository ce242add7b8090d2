#include "span/lids.hpp"

#include <utility>

namespace vspring {

namespace {

// In degrees: on average from the loops beside it, and from one that it does not go on into.
constexpr double least_turn = 60;
constexpr double least_turn_from_one = 45;
// As a share of the length of a loop.
constexpr double most_of_length = 0.85;

}  // namespace

void LoopTurns::add(std::size_t a, std::size_t b, double length, double degrees) {
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    Shared& shared = beside_[one][other];
    shared.length += length;
    shared.turn += length * degrees;
  }
}

double LoopTurns::mean_without(std::size_t loop, const std::vector<std::uint8_t>& is_away) const {
  Shared sum;
  for (const auto& [other, shared] : beside_[loop]) {
    if (is_away[other] != 0) continue;
    sum.length += shared.length;
    sum.turn += shared.turn;
  }
  return sum.length > 0 ? sum.turn / sum.length : 0;
}

bool LoopTurns::turns_from_most(std::size_t loop, const std::vector<std::uint8_t>& is_away) const {
  double turned = 0;
  double length = 0;
  for (const auto& [other, shared] : beside_[loop]) {
    if (is_away[other] != 0) continue;
    length += shared.length;
    if (shared.turn > least_turn_from_one * shared.length) turned += shared.length;
  }
  return length > 0 && turned > most_of_length * length;
}

bool LoopTurns::is_beside_smooth(std::size_t loop, std::vector<std::uint8_t> is_away) const {
  is_away[loop] = 1;
  double smooth = 0;
  double length = 0;
  for (const auto& [other, shared] : beside_[loop]) {
    if (is_away[other] != 0) continue;
    length += shared.length;
    if (!turns_from_most(other, is_away)) smooth += shared.length;
  }
  return smooth > length / 2;
}

std::vector<std::size_t> LoopTurns::lids(const std::vector<std::uint8_t>& may_be,
                                         const std::vector<std::uint8_t>& is_round) const {
  std::vector<std::size_t> result;
  std::vector<std::uint8_t> is_away(beside_.size(), 0);
  while (true) {
    std::size_t most = beside_.size();
    double turn = least_turn;
    for (std::size_t l = 0; l < beside_.size(); ++l) {
      if (may_be[l] == 0 || is_away[l] != 0 || !(mean_without(l, is_away) > turn)) continue;
      if (is_round[l] == 0 && !(turns_from_most(l, is_away) && is_beside_smooth(l, is_away))) continue;
      most = l;
      turn = mean_without(l, is_away);
    }
    if (most == beside_.size()) return result;
    is_away[most] = 1;
    result.push_back(most);
  }
}

}  // namespace vspring
