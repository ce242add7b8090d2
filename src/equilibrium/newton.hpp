#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <vector>

#include "equilibrium/equilibrium.hpp"
#include "spring/model.hpp"

namespace vspring {

/// The derivative of all displacements of the model by the positions of the moving nodes; it includes that normals turn
/// with them. By central differences, each over the few nodes whose displacements depend on the node that is moved.
class ForceDerivative {
 public:
  /// The net must outlive it and keep its links.
  ForceDerivative(Net& net, const Model& model);

  /// At the places where nodes are now: a row and a column for every coordinate, three in a row for each node. Needs
  /// directions; the net is moved about and left as it was. Cost: linear, about 15 µs a node.
  const Eigen::SparseMatrix<double>& find();

 private:
  Net* net_;
  const Model* model_;
  // Of every moving node, in order: the nodes whose normals and those whose displacements depend on its place.
  std::vector<std::vector<std::uint32_t>> normals_;
  std::vector<std::vector<std::uint32_t>> forces_;
  Eigen::SparseMatrix<double> matrix_;
};

/// The work of one step, in iterations of go_to_equilibrium().
constexpr double work_of_newton_step = 60;

/// Goes to where all displacements of the model vanish by Newton's steps, with the whole derivative: to the equilibrium
/// nearby, also one that the plain iteration and go_to_equilibrium() would leave. Steps are so short that no edge turns
/// much. Nodes are anywhere on the way where the outcome is not converged. Cost for n nodes of a curve: linear, for
/// each step.
EquilibriumResult go_by_newton(Net& net, const Model& model, const EquilibriumTask& task, ThreadTeam& team,
                               Context& context);

}  // namespace vspring
