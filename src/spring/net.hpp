#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "shape/frame.hpp"
#include "spring/rings.hpp"
#include "spring/sphere_springs.hpp"
#include "spring/whole_faces.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Scattered points, each tied to one node of a net (§4.5), in the coordinates of the net.
struct TiedPoints {
  std::vector<Vector3> positions;
  std::vector<double> weights;         ///< k_j of Eq. 9
  std::vector<Vector3> normals;        ///< of the surface there, unit or zero; empty: unknown
  std::vector<std::uint32_t> numbers;  ///< per point its number among the given ones; clusters have none
  std::vector<std::uint32_t> order;    ///< the points, node by node of the net
  std::vector<std::uint32_t> begin;    ///< where each node's points begin in that order, and their number at the end
  std::vector<std::uint32_t> end;      ///< where the points that pull at the node end; empty: all pull
  bool are_nodes = false;              ///< whether each is the place of a node in the input, to which it stays tied
  std::vector<double> factors;         ///< per node the factor of the average of its k_j; empty: 1

  [[nodiscard]] bool empty() const noexcept { return order.empty(); }
  /// The points that pull at a node.
  [[nodiscard]] std::span<const std::uint32_t> of(std::size_t node) const noexcept {
    return {order.data() + begin[node], (end.empty() ? begin[node + 1] : end[node]) - begin[node]};
  }
  /// All points of a node, also those that it faces away from, which do not pull.
  [[nodiscard]] std::span<const std::uint32_t> all_of(std::size_t node) const noexcept {
    return {order.data() + begin[node], begin[node + 1] - begin[node]};
  }
  [[nodiscard]] double factor(std::size_t node) const noexcept { return factors.empty() ? 1 : factors[node]; }
};

/// A run of nodes of one chain of a curve, connected by moving nodes: local numbers, in order. Those of moving nodes
/// ascend.
struct MovingRun {
  std::vector<std::uint32_t> nodes;
  /// Whether the last node joins the first, which is held.
  bool closed = false;
  /// Places of its nodes along it, at whose distances the lengths of edges aim. A closed run has one more entry, for
  /// the first node again. Set by curve_levels().
  std::vector<double> along = {};
};

/// The nodes, what holds them and what pulls at them: constant during one run of a solver.
struct NetProblem {
  static constexpr std::uint8_t given_normal = 1;
  static constexpr std::uint8_t given_tangent = 2;

  bool is_curve = false;  ///< else a surface
  // Nodes and their neighbours.
  std::vector<Index> node;          ///< per local node its number in the shape
  std::size_t moving = 0;           ///< nodes 0 … moving − 1 move
  std::size_t computed = 0;         ///< nodes 0 … computed − 1 have rings; directions are computed where not given
  std::vector<std::uint8_t> given;  ///< per node, which directions constraints give
  Rings rings;
  WholeFaces whole_faces;              ///< those that are cut in the rings
  std::vector<MovingRun> moving_runs;  ///< of curves: the order of nodes
  Frame frame;                         ///< the coordinates
  double tiny = 0;                     ///< see node_force()
  /// What each moving node slides on, in the net's coordinates; null for one that does not. Empty: none slides.
  std::vector<std::shared_ptr<const Support>> supports;
  /// Places of all nodes in the input, if constraints put some of them elsewhere; else empty.
  std::vector<Vector3> input;

  // What acts on moving nodes besides the V-Springs of Eq. 4; each is empty if it does not.
  std::vector<double> laplacian_weights;  ///< share of every link in the regularisation (§4.4); empty: equal
  std::vector<Vector3> target_positions;  ///< to which the regularisation draws nodes, also of surfaces
  SphereSprings spheres;                  ///< of surfaces, in place of those V-Springs
  TiedPoints points;                      ///< scattered points (§4.5)

  [[nodiscard]] bool slides(std::size_t i) const { return i < supports.size() && supports[i] != nullptr; }
  [[nodiscard]] bool normal_given(std::size_t i) const { return (given[i] & given_normal) != 0; }
  [[nodiscard]] bool tangent_given(std::size_t i) const { return (given[i] & given_tangent) != 0; }
  [[nodiscard]] std::span<const double> weights_of(std::size_t i) const {
    if (laplacian_weights.empty()) return {};
    return std::span(laplacian_weights).subspan(rings.begin(i), rings.links(i).size());
  }
};

/// Places and directions of the nodes, which a solver changes; one entry per node. Held nodes have those that
/// constraints give.
struct NetState {
  std::vector<Vector3> positions;
  std::vector<Vector3> normals;     ///< of unit length, or zero for none; of curves only if a rule needs them
  std::vector<Vector3> tangents;    ///< of curves, unit or zero; empty for surfaces
  std::vector<Vector3> curvatures;  ///< of curves, if Model::prepare() asks for them; else empty
};

/// The part of a shape that takes part in fairing, in coordinates and an order of its own. The sweep and the solvers
/// see nothing else.
///
/// Local nodes: first those that move, numbered so that neighbours lie close in memory; then held nodes whose direction
/// is computed; then all other nodes on which moving nodes depend. Coordinates are centred and scaled by a power of two
/// to a box of about 1.
struct Net : NetProblem, NetState {};

/// The mean length of the edges of the moving nodes, in the coordinates of the net. Cost: linear.
double mean_edge(const Net& net);
/// The mean length of the edges of one node; 0 if it has none.
double mean_edge(const Net& net, std::size_t node);

/// The mean of the places of a node's neighbours; its own place if it has none.
Vector3 mean_of_neighbours(const Net& net, std::size_t node);

/// Gathers the net of a mesh under constraints. The mesh must have passed check_constraints(). Cost: linear in the
/// mesh, once, and in the moving nodes. Large faces are cut, see with_large_faces_cut(); Net::whole_faces has them
/// whole. for_spheres: adds rings of all held nodes of the faces around moving ones, also of those with a given normal.
Net gather_net(const PolygonMesh& mesh, const Constraints& constraints, bool for_spheres = false);

/// The part of gathering that does not depend on connectivity: places nodes, copies given directions and sets `tiny`.
/// Needs node, rings, moving and computed.
void place_net(Net& net, const std::vector<Vector3>& positions, const Constraints& constraints);

/// The places at which place_net() puts the nodes, in the net's coordinates.
std::vector<Vector3> start_places(const Net& net, const std::vector<Vector3>& positions,
                                  const Constraints& constraints);

/// The positions of a shape, held nodes at the positions of their constraints, those that slide on their supports.
std::vector<Vector3> positions_as_held(std::vector<Vector3> positions, const Constraints& constraints);

/// The shape's positions, updated from the net: moving nodes go the share `strength` of their way, fixed nodes are
/// exactly where constraints say, those that slide on their supports, all others do not change.
std::vector<Vector3> scatter_positions(const Net& net, std::vector<Vector3> positions, const Constraints& constraints,
                                       double strength);
/// scatter_positions() with these places of the moving nodes, in the net's coordinates.
std::vector<Vector3> scatter_places(const Net& net, std::span<const Vector3> places, std::vector<Vector3> positions,
                                    const Constraints& constraints, double strength);

}  // namespace vspring
