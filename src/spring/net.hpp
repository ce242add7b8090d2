#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shape/frame.hpp"
#include "spring/rings.hpp"
#include "spring/sphere_springs.hpp"
#include "spring/tied_points.hpp"
#include "spring/whole_faces.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// A run of nodes of one chain of a curve that hangs together by moving nodes: local numbers, in order. Moving ones
/// ascend.
struct MovingRun {
  std::vector<std::uint32_t> nodes;
  /// The last node joins the first. The first is held, so that what moves is cut there.
  bool closed = false;
  /// Where its nodes lie along it: what the lengths of edges go by. A closed run has one more entry, the first node
  /// again. Set by curve_levels().
  std::vector<double> along = {};
};

/// Which nodes there are, what holds them and what pulls at them: what one run of a solver leaves as it is.
struct NetProblem {
  static constexpr std::uint8_t given_normal = 1;
  static constexpr std::uint8_t given_tangent = 2;

  bool is_curve = false;  ///< else a surface
  // Nodes and their neighbours.
  std::vector<Index> node;          ///< number in the shape of every local node
  std::size_t moving = 0;           ///< nodes 0 … moving − 1 move
  std::size_t computed = 0;         ///< nodes 0 … computed − 1 have rings; directions are computed where not given
  std::vector<std::uint8_t> given;  ///< which directions constraints give, for every node
  Rings rings;
  WholeFaces whole_faces;              ///< those that are cut in the rings
  std::vector<MovingRun> moving_runs;  ///< of curves: the order of nodes
  Frame frame;                         ///< the coordinates
  double tiny = 0;                     ///< see node_force()
  /// Places of all nodes in the input, where constraints put some of them elsewhere; else empty.
  std::vector<Vector3> input;

  // What acts on moving nodes besides the V-Springs of Eq. 4; each is empty where it does not.
  std::vector<double> laplacian_weights;  ///< what links count in the regularisation (§4.4); empty: all the same
  std::vector<Vector3> target_positions;  ///< to where the regularisation draws the nodes, on surfaces too
  SphereSprings spheres;                  ///< of surfaces, in place of those V-Springs
  TiedPoints points;                      ///< scattered points (§4.5)

  [[nodiscard]] bool normal_given(std::size_t i) const { return (given[i] & given_normal) != 0; }
  [[nodiscard]] bool tangent_given(std::size_t i) const { return (given[i] & given_tangent) != 0; }
  [[nodiscard]] std::span<const double> weights_of(std::size_t i) const {
    if (laplacian_weights.empty()) return {};
    return std::span(laplacian_weights).subspan(rings.begin(i), rings.links(i).size());
  }
};

/// Where the nodes are and which way they face, one entry for every node: what a solver changes. Held nodes have the
/// places and directions that constraints give.
struct NetState {
  std::vector<Vector3> positions;
  std::vector<Vector3> normals;     ///< unit, or zero where there is none; of curves only where a rule needs them
  std::vector<Vector3> tangents;    ///< of curves, unit or zero; empty for surfaces
  std::vector<Vector3> curvatures;  ///< of curves, where Model::prepare() asks for them; else empty
};

/// The part of a shape that takes part in fairing, in coordinates and an order of its own: all that the sweep and the
/// solvers see.
///
/// Local nodes: first those that move, numbered so that neighbours lie close in memory; then held nodes whose direction
/// is computed; then all other nodes that a moving node looks at. Coordinates are centred and scaled by a power of two
/// to a box of about 1.
struct Net : NetProblem, NetState {};

/// The mean length of the edges of the moving nodes, in the coordinates of the net. Cost: linear.
double mean_edge(const Net& net);
/// That of one node, 0 without any.
double mean_edge(const Net& net, std::size_t node);

/// The mean of the places of a node's neighbours; its own where it has none.
Vector3 mean_of_neighbours(const Net& net, std::size_t node);

/// Gathers the net of a mesh under constraints. The mesh must have passed check_constraints(). Cost: linear in the
/// mesh, once, and in the moving nodes.
/// Large faces are cut, see with_large_faces_cut(), and kept whole beside.
/// for_spheres: with rings of all held nodes of the faces around moving ones, also where their normal is given.
Net gather_net(const PolygonMesh& mesh, const Constraints& constraints, bool for_spheres = false);

/// The part of gathering that no longer looks at connectivity: places nodes, takes given directions over and sets
/// `tiny`. Needs node, rings, moving and computed.
void place_net(Net& net, const std::vector<Vector3>& positions, const Constraints& constraints);

/// Where place_net() puts the nodes, in the net's coordinates.
std::vector<Vector3> start_places(const Net& net, const std::vector<Vector3>& positions,
                                  const Constraints& constraints);

/// The positions of a shape, with those of held nodes where constraints have them.
std::vector<Vector3> positions_as_held(std::vector<Vector3> positions, const Constraints& constraints);

/// The shape's positions with those of the net in place: moving nodes go the share `strength` of their way, fixed nodes
/// are exactly where the constraints say, all others untouched.
std::vector<Vector3> scatter_positions(const Net& net, std::vector<Vector3> positions, const Constraints& constraints,
                                       double strength);
/// The same with other places of the moving nodes, in the net's coordinates.
std::vector<Vector3> scatter_places(const Net& net, std::span<const Vector3> places, std::vector<Vector3> positions,
                                    const Constraints& constraints, double strength);

}  // namespace vspring
