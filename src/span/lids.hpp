#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

namespace vspring {

/// By which angles loops turn from those beside them.
class LoopTurns {
 public:
  explicit LoopTurns(std::size_t loops) : beside_(loops) {}

  /// Two loops turn by an angle along an edge of this length. degrees: between the normals of their faces.
  void add(std::size_t a, std::size_t b, double length, double degrees);

  /// The mean angle between a loop and those beside it, in degrees; 0 if there are none. is_away: per loop, whether it
  /// does not count.
  [[nodiscard]] double mean_without(std::size_t loop, const std::vector<std::uint8_t>& is_away) const;

  /// The loops that turn by more than 60° from those beside them, and have no corner, or turn by more than 45° nearly
  /// all around from loops most of which do not; the one that turns most first, and then without it. may_be, is_round:
  /// per loop, whether it may be a lid, and whether it has no corner. Cost: quadratic in the loops.
  [[nodiscard]] std::vector<std::size_t> lids(const std::vector<std::uint8_t>& may_be,
                                              const std::vector<std::uint8_t>& is_round) const;

 private:
  struct Shared {
    double length = 0;
    double turn = 0;  ///< times length
  };
  [[nodiscard]] bool turns_from_most(std::size_t loop, const std::vector<std::uint8_t>& is_away) const;
  [[nodiscard]] bool is_beside_smooth(std::size_t loop, std::vector<std::uint8_t> is_away) const;

  std::vector<std::map<std::size_t, Shared>> beside_;
};

}  // namespace vspring
