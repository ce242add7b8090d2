#pragma once

#include <vector>

#include "levels/level.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// The hierarchy of a curve (§4.7, §4.8), the coarsest level first, the curve itself last. Between nodes that are held
/// or have a given direction every second node is left out, as long as enough remain to show the shape. Sets the shares
/// of all coarse nets, and with Distribution::keep those of the finest, from the lengths that the edges have now. Cost:
/// linear.
std::vector<Level> curve_levels(Net net, Distribution distribution);

/// Makes a shape usable as a start: averages neighbours until the curve turns sharply at no node. Held nodes and nodes
/// with a given direction stay, and may be corners.
void untangle(Net& net);

/// The start of last resort, which forgets the shape: puts nodes on the straight lines between held nodes and nodes
/// with a given direction. Runs with fewer than two of these do not change.
void start_from_chords(Net& net);

/// Hands the shape of a level up to the next finer one: missing nodes go on the cubic with the tangents of their
/// neighbours, whose error on a circle is of sixth order in the spacing. Needs directions on the coarse level.
void prolong_curve(const Level& coarse, Level& fine);

}  // namespace vspring
