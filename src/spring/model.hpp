#pragma once

#include <memory>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"
#include "spring/v_spring.hpp"
#include "vspring/model.hpp"

namespace vspring {

/// A run of moving nodes that one thread works on in order.
struct Block {
  std::size_t begin;
  std::size_t end;
};

/// The rules of the spring model for one kind of shape: its whole interface to the sweep and the solvers.
class Model {
 public:
  Model() = default;
  virtual ~Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Allocates in the net what find_forces() needs of every node besides its place and direction. move() must not use
  /// it, as it does not follow the newest positions. Does nothing the second time.
  virtual void prepare(Net& net) const = 0;

  /// Step 1 of Fig. 3: computes normals or tangents, unless given, of the nodes begin … end − 1, which have rings.
  virtual void update_directions(Net& net, std::size_t begin, std::size_t end) const = 0;

  /// The share of every link in the regularisation (§4.4) that sends each node to its present place; aligned with the
  /// links of the net. Nodes that noise has put outside their neighbours are sent among these. Needs directions.
  [[nodiscard]] virtual std::vector<double> present_laplacian_weights(const Net& net) const = 0;

  /// Steps 2 and 3 of Fig. 3: moves the nodes of a block one after the other, each from the newest positions. Returns
  /// the largest displacement relative to the mean length of the node's edges (§4.6), infinity where one is not finite.
  virtual double move(Net& net, Block block) const = 0;

  /// Finds the force on every node of the block, points included, without moving it.
  virtual void find_forces(const Net& net, Block block, std::span<NodeForce> forces) const = 0;
};

[[nodiscard]] std::unique_ptr<const Model> surface_model(PseudoNormals pseudo_normals, Forces forces = Forces::steady);
[[nodiscard]] std::unique_ptr<const Model> curve_model(const CurveRules& rules, Forces forces = Forces::steady);
/// The model of one curve. In a plane, normals lie in the plane, and both kinds of NormalPlane are the same; with
/// printed forces and chords a normal is the mean of those of the segments. points: in the coordinates of the shape;
/// they determine the plane of a straight line.
[[nodiscard]] std::unique_ptr<const Model> curve_model_for(const Net& net, CurveRules rules,
                                                           Forces forces = Forces::steady,
                                                           std::span<const Vector3> points = {});

/// Computes the directions of all nodes of the net that have rings.
void update_directions(Net& net, const Model& model, ThreadTeam& team);

/// Sets the net's shares for the regularisation, from its present places.
void set_laplacian_weights(Net& net, const Model& model, Distribution distribution, ThreadTeam& team);

}  // namespace vspring
