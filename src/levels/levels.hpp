#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/threads.hpp"
#include "levels/coarsening.hpp"
#include "spring/model.hpp"
#include "spring/net.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// One level of the hierarchy of a shape (§4.7).
struct Level {
  Net net;
  /// Per node its number in the net of the next finer level; empty on the finest.
  std::vector<std::uint32_t> finer;
  /// Of surfaces: the nodes of the next finer level that this one lacks, in its numbers; empty on the finest. Groups as
  /// from coarsen().
  std::vector<Removals> removals;
  /// Of surfaces: the rest_positions() of the nodes in the finest net; empty on the finest level, and with
  /// Distribution::even.
  std::vector<Vector3> places;
};

/// Hands the shape of a level down to the next coarser one: nodes stay where they are, on surfaces with their normals.
/// Cost: linear in the coarse nodes.
inline void restrict_shape(const Level& fine, Level& coarse) {
  Net& to = coarse.net;
  const Net& from = fine.net;
  for (std::size_t k = 0; k < coarse.finer.size(); ++k) {
    const std::size_t i = coarse.finer[k];
    if (k < to.moving) to.positions[k] = from.positions[i];
    if (!to.is_curve) to.normals[k] = from.normals[i];
  }
}

/// The hierarchy of a curve (§4.7, §4.8), the coarsest level first, the curve itself last. Between nodes that are held
/// or have a given direction every second node is left out, as long as enough remain to show the shape. Sets the shares
/// of all coarse nets, and with Distribution::keep those of the finest, from the lengths that the edges have now. Cost:
/// linear.
std::vector<Level> curve_levels(Net net, Distribution distribution);

/// Makes a shape usable as a start: averages neighbours until the curve turns sharply at no node. Held nodes and nodes
/// with a given direction stay, and may be corners.
void untangle(Net& net);

/// The start of last resort, which ignores the shape: puts nodes on the straight lines between held nodes and nodes
/// with a given direction. Runs with fewer than two of these do not change.
void start_from_chords(Net& net);

/// Hands the shape of a level up to the next finer one: missing nodes go on the cubic with the tangents of their
/// neighbours, whose error on a circle is of sixth order in the spacing. Needs directions on the coarse level.
void prolong_curve(const Level& coarse, Level& fine);

/// The hierarchy of a surface, the coarsest level first, the surface itself last. Coarser levels are triangulations of
/// about a quarter of the nodes, with constraints and boundary loops of their own; they follow from connectivity and
/// constraints alone. Levels are added down to about twenty moving nodes. With Distribution::keep the shares of the
/// finest net follow from the present places; those of other nets, and all with Distribution::smooth, follow from
/// rest_positions(). Cost: linear; the same result on any number of threads.
std::vector<Level> surface_levels(Net net, const Model& model, Distribution distribution, ThreadTeam& team);

/// Hands the shape of a level up to the next finer one. Missing nodes go between their parents, and from there along
/// their normal to where the V-Springs to the parents balance (Eqs. 4, 5). That is exact on spheres; elsewhere the
/// error is of third order in the spacing if that of the coarse normals is of second. Then all nodes are moved likewise
/// to where the regularisation (§4.4) wants them. Needs directions on the coarse level, sets them on the fine one.
/// Cost: linear; the same result on any number of threads.
void prolong_surface(const Level& coarse, Level& fine, ThreadTeam& team);

}  // namespace vspring
