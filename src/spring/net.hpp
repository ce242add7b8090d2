#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shape/frame.hpp"
#include "spring/rings.hpp"
#include "spring/sphere_springs.hpp"
#include "spring/tied_points.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// The part of a shape that takes part in fairing, in coordinates and an order of its own: all that the sweep and the
/// solvers see.
///
/// Local nodes: first those that move, numbered so that neighbours lie close in memory; then held nodes whose direction
/// is computed; then all other nodes that a moving node looks at. Coordinates are centred and scaled by a power of two
/// to a box of about 1.
struct Net {
  static constexpr std::uint8_t given_normal = 1;
  static constexpr std::uint8_t given_tangent = 2;

  std::vector<Vector3> positions;
  std::vector<Vector3> normals;     ///< unit, or zero where there is none; of curves only where a rule needs them
  std::vector<Vector3> tangents;    ///< of curves, unit or zero; empty for surfaces
  std::vector<Vector3> curvatures;  ///< of curves, where Model::prepare() asks for them; else empty
  std::size_t moving = 0;           ///< nodes 0 … moving − 1 move
  std::size_t computed = 0;         ///< nodes 0 … computed − 1 have rings; directions are computed where not given
  std::vector<std::uint8_t> given;  ///< which directions constraints give, for every node
  Rings rings;
  /// Places of all nodes in the input, where constraints put some of them elsewhere; else empty.
  std::vector<Vector3> input;
  std::vector<double> laplacian_weights;  ///< what links count in the regularisation; empty: all the same
  std::vector<Vector3>
      target_positions;     ///< to where the regularisation draws moving nodes, on surfaces too; empty: nowhere
  SphereSprings spheres;    ///< of surfaces; empty where springs are those of Eq. 4
  TiedPoints points;        ///< scattered points that pull at nodes; empty where there are none
  std::vector<Index> node;  ///< number in the shape of every local node
  Frame frame;
  double tiny = 0;  ///< see node_force()

  [[nodiscard]] bool is_curve() const { return !tangents.empty(); }
  [[nodiscard]] bool normal_given(std::size_t i) const { return (given[i] & given_normal) != 0; }
  [[nodiscard]] bool tangent_given(std::size_t i) const { return (given[i] & given_tangent) != 0; }
  [[nodiscard]] std::span<const double> weights_of(std::size_t i) const {
    if (laplacian_weights.empty()) return {};
    return std::span(laplacian_weights).subspan(rings.begin(i), rings.links(i).size());
  }
};

/// The mean length of the edges of the moving nodes, in the coordinates of the net. Cost: linear.
double mean_edge(const Net& net);

/// The mean of the places of a node's neighbours; its own where it has none.
Vector3 mean_of_neighbours(const Net& net, std::size_t node);

/// Gathers the net of a mesh under constraints. The mesh must have passed check_constraints(). Cost: linear in the
/// mesh, once, and in the moving nodes.
/// for_spheres: with rings of all held nodes of the faces around moving ones, also where their normal is given.
Net gather_net(const PolygonMesh& mesh, const Constraints& constraints, bool for_spheres = false);

/// The part of gathering that no longer looks at connectivity: places nodes, takes given directions over and sets
/// `tiny`. Needs node, rings, moving and computed.
void place_net(Net& net, const std::vector<Vector3>& positions, const Constraints& constraints);

/// The shape's positions with those of the net in place: moving nodes go the share `strength` of their way, fixed nodes
/// are exactly where the constraints say, all others untouched.
std::vector<Vector3> scatter_positions(const Net& net, std::vector<Vector3> positions, const Constraints& constraints,
                                       double strength);
/// The same with other places of the moving nodes, in the net's coordinates.
std::vector<Vector3> scatter_places(const Net& net, std::span<const Vector3> places, std::vector<Vector3> positions,
                                    const Constraints& constraints, double strength);

}  // namespace vspring
