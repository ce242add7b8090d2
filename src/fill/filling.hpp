#pragma once

#include <map>
#include <vector>

#include "fill/refinement.hpp"
#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// A mesh to whose holes patches are put, flat.
class Filling {
 public:
  /// The mesh must outlive it. Cost: linear.
  explicit Filling(const PolygonMesh& mesh);

  /// Triangulates and refines a patch and puts it behind what there is, or says in the hole why it cannot. Ends where
  /// the thread's context is cancelled; nothing is put then. Cost: see triangulate() and refine().
  void fill(Hole& hole);

  [[nodiscard]] const PolygonMesh& input() const noexcept { return mesh_; }
  [[nodiscard]] const Incidence& incidence() const noexcept { return incidence_; }
  [[nodiscard]] std::vector<Hole>& holes() noexcept { return holes_; }

  /// Mesh, likenesses and holes; the rest is left.
  [[nodiscard]] FilledHoles take();

 private:
  [[nodiscard]] std::vector<std::vector<Index>> joined(const std::vector<Index>& rim);
  [[nodiscard]] double spacing_at(Index node) const;
  void put(Hole& hole, const Patch& patch, const std::vector<Index>& face_beside_rim);

  const PolygonMesh& mesh_;
  Incidence incidence_;
  std::vector<Hole> holes_;
  std::vector<Index> place_in_rim_;                 ///< of every node, in the hole that is being filled; −1 for none
  std::map<Index, std::vector<Index>> new_joined_;  ///< ends of new edges between nodes of the input
  std::vector<Vector3> positions_;
  std::vector<Index> face_begin_;
  std::vector<Index> corners_;
  std::vector<Index> node_like_;
  std::vector<Index> face_like_;
};

}  // namespace vspring
