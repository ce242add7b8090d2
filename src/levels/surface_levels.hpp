#pragma once

#include <cstdint>
#include <vector>

#include "base/threads.hpp"
#include "levels/coarsening.hpp"
#include "spring/model.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// One level of a surface's hierarchy (§4.7).
struct SurfaceLevel {
  Net net;
  /// For every node its number in the net of the next finer level; empty on the finest.
  std::vector<std::uint32_t> finer;
  /// The nodes of the next finer level that this one lacks, in its numbers; empty on the finest. Groups as from
  /// coarsen().
  std::vector<Removals> removals;
  /// Where its nodes lie by rest_positions() of the finest net; empty on that, and with Distribution::even.
  std::vector<Vector3> places;
};

/// The hierarchy of a surface, the coarsest level first, the surface itself last. Coarser levels are triangulations of
/// about a quarter of the nodes, with constraints and boundary loops of their own; they follow from connectivity and
/// constraints alone. There are as many as it takes to come down to some twenty moving nodes. With
/// Distribution::keep the shares of the finest net are set from where the nodes are now, those of all others, and with
/// Distribution::smooth all, from their rest_positions(). Cost: linear; the same result on any number of threads.
std::vector<SurfaceLevel> surface_levels(Net net, const Model& model, Distribution distribution, ThreadTeam& team);

/// Hands the shape of a level down to the next coarser one: nodes stay where they are, with their normals. Cost: linear
/// in the coarse nodes.
void restrict_shape(const SurfaceLevel& fine, SurfaceLevel& coarse);

/// Hands the shape of a level up to the next finer one. Nodes that it lacks go between their parents, and from there
/// along their normal to where the V-Springs to the parents balance (Eqs. 4, 5): exactly onto spheres, elsewhere with
/// an error that falls with the third power of the spacing if that of the coarse normals does with the second. Then
/// all nodes are evened out in the same manner, as the regularisation (§4.4) wants them. Needs directions on the coarse
/// level, sets them on the fine one. Cost: linear; the same result on any number of threads.
void prolong(const SurfaceLevel& coarse, SurfaceLevel& fine, ThreadTeam& team);

}  // namespace vspring
