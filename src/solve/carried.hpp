#pragma once

#include <Eigen/SparseCore>
#include <cstdint>
#include <optional>
#include <vector>

#include "base/threads.hpp"
#include "linear/cholesky_solver.hpp"
#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// How far held nodes that are put aside take the nodes about them along the surface: from where a node is to where
/// constraints put it, across its normal; of that a share which rises from none for one of its edges to all for two.
/// What goes less far leaves its neighbours where they are, and so does what goes along the normal, and a node of a
/// boundary: from a rim the spacing goes evenly inwards by itself, while it has a pole at a single node. One entry per
/// node; empty where all are zero. Cost: linear, next to nothing where nothing is put elsewhere.
std::vector<Vector3> carrying_moves(const PolygonMesh& mesh, const Constraints& constraints);

/// Free nodes that are taken along, as a thin plate would go (least bending of the moves over the edges). A mesh of
/// which single nodes have been put aside is a start with needles; this is one without, and its spacing goes along. The
/// largest moves that do not fold it are about two thirds of the way to where nothing moves.
class CarriedNodes {
 public:
  /// moves: of held nodes, one entry per node. The mesh has to keep its faces, and stay where it is.
  CarriedNodes(const PolygonMesh& mesh, const Constraints& constraints, const std::vector<Vector3>& moves,
               ThreadTeam& team);

  /// Whether these are moves of the same nodes.
  [[nodiscard]] bool are_for(const std::vector<Vector3>& moves) const;

  /// Where all nodes lie then. None where no node is taken along; the nearest 20,000 are. Cost: n^1.5 of these the
  /// first time, some 0.2 s for 10,000 nodes; then n log n.
  [[nodiscard]] std::optional<std::vector<Vector3>> positions_with(const std::vector<Vector3>& moves);

 private:
  void find_free(const Constraints& constraints, const std::vector<Vector3>& moves);
  [[nodiscard]] double mean_square_edge(Index node) const;
  void factorise();

  Incidence incidence_;
  NodeGraph graph_;
  std::vector<Vector3> positions_;
  std::vector<std::uint8_t> moved_;
  std::vector<Index> free_;
  std::vector<std::int32_t> column_of_;  ///< of free nodes
  std::vector<Index> rows_;              ///< nodes where the plate bends
  Eigen::SparseMatrix<double> of_free_;  ///< how it bends with free nodes
  Eigen::SparseMatrix<double> of_held_;  ///< and with all nodes, of which that counts what held ones do
  CholeskySolver solver_;
  bool is_ready_ = false;
};

}  // namespace vspring
