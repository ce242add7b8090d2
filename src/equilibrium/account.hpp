#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "spring/net.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// The diagonal of the box around the net, in its coordinates.
double diagonal(const Net& net);

/// Fills the counts of a report on a shape with so many moving nodes.
void count_nodes(std::size_t moving, const Constraints& constraints, FairReport& report);
/// The same where all usable nodes move that no constraint holds.
void count_nodes(std::span<const std::uint8_t> usable, const Constraints& constraints, FairReport& report);

/// Fills how far nodes moved from the input to the result.
void measure_moves(const Net& net, const std::vector<Vector3>& before, const std::vector<Vector3>& after,
                   FairReport& report);

/// How far a shape is from an equilibrium, in words: "expected to be 0.4 % of the size away from one".
std::string distance_from_equilibrium(const FairReport& report);

/// Words to append that say which nodes the last level had to keep in place; empty if none.
std::string words_of_kept(const FairReport& report);

}  // namespace vspring
