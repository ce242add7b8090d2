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

/// The rules of the spring model for one kind of shape: all that the sweep and the solvers know of it.
class Model {
 public:
  Model() = default;
  virtual ~Model() = default;
  Model(const Model&) = delete;
  Model& operator=(const Model&) = delete;

  /// Makes room in the net for what find_forces() takes from every node beside its place and direction; move() must do
  /// without, as that is not of the newest positions. Nothing where there is room already.
  virtual void prepare(Net& net) const = 0;

  /// Step 1 of Fig. 3: normals or tangents of the nodes begin … end − 1, which have rings, where they are not given.
  virtual void update_directions(Net& net, std::size_t begin, std::size_t end) const = 0;

  /// What every link counts in the regularisation (§4.4) so that the present place of each node is where it is sent;
  /// aligned with the links of the net; but not of nodes that noise has put outside their neighbours, which are sent
  /// among these. Needs directions.
  [[nodiscard]] virtual std::vector<double> present_laplacian_weights(const Net& net) const = 0;

  /// Steps 2 and 3 of Fig. 3: moves the nodes of a block one after the other, each from the newest positions. Returns
  /// the largest displacement relative to the mean length of the node's edges (§4.6), infinity where one is not finite.
  virtual double move(Net& net, Block block) const = 0;

  /// The same displacements for nodes that stay: one force for every node of the block, with what its points ask.
  virtual void find_forces(const Net& net, Block block, std::span<NodeForce> forces) const = 0;
};

[[nodiscard]] std::unique_ptr<const Model> surface_model(PseudoNormals pseudo_normals, Forces forces = Forces::steady);
[[nodiscard]] std::unique_ptr<const Model> curve_model(const CurveRules& rules, Forces forces = Forces::steady);
/// For one curve: in a plane, normals in the plane are all there is, and both kinds of normal plane are the same; as
/// printed, with chords, each is the mean of those of the segments. points: in the coordinates of the shape; they tell
/// the plane of a straight line.
[[nodiscard]] std::unique_ptr<const Model> curve_model_for(const Net& net, CurveRules rules,
                                                           Forces forces = Forces::steady,
                                                           std::span<const Vector3> points = {});

/// Directions of all nodes of the net that have rings.
void update_directions(Net& net, const Model& model, ThreadTeam& team);

/// Sets what the regularisation aims at: the net's shares, from its present places.
void set_laplacian_weights(Net& net, const Model& model, Distribution distribution, ThreadTeam& team);

}  // namespace vspring
