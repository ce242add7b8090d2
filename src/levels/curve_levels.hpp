#pragma once

#include <cstdint>
#include <vector>

#include "spring/curve_net.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// One level of a curve's hierarchy (§4.7, §4.8).
struct CurveLevel {
  CurveNet curve;
  /// For every strand and place the place in the strand of the next finer level; empty on the finest.
  std::vector<std::vector<std::uint32_t>> finer;
  /// For every strand and place where it lies along the strand: what the lengths of edges go by. A closed strand has
  /// one more entry, the first place again.
  std::vector<std::vector<double>> along;
};

/// The hierarchy of a curve, the coarsest level first, the curve itself last. Between nodes that are held or have a
/// given direction every second node is left out, as long as enough are left to tell the shape. Sets the shares of all
/// coarse nets, and with Distribution::keep those of the finest, from the lengths that the edges have now. Cost:
/// linear.
std::vector<CurveLevel> curve_levels(CurveNet curve, Distribution distribution);

/// Makes a shape fit to start from: averages neighbours until no node turns the curve sharply. Held nodes and nodes
/// with a given direction stay, and may be corners.
void untangle(CurveLevel& level);

/// The start of last resort, which forgets the shape: nodes go on the straight lines between held nodes and nodes with
/// a given direction. What has fewer than two of those stays.
void start_from_chords(CurveLevel& level);

/// Hands the shape of a level down to the next coarser one: its nodes stay where they are.
void restrict_shape(const CurveLevel& fine, CurveLevel& coarse);

/// Hands the shape of a level up to the next finer one: nodes that it lacks go on the cubic with the tangents of their
/// neighbours, whose error on a circle falls with the sixth power of the spacing. Needs directions on the coarse level.
void prolong(const CurveLevel& coarse, CurveLevel& fine);

}  // namespace vspring
