#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "fill/refinement.hpp"
#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// A mesh to whose holes patches are put.
class Filling {
 public:
  /// The mesh must outlive it. Cost: linear.
  explicit Filling(const PolygonMesh& mesh);

  /// Triangulates and refines a patch, flat, or says in the hole why it cannot. Ends where the thread's context is
  /// cancelled; there is no patch then. Cost: see triangulate() and refine().
  void fill(std::size_t hole);

  /// Puts patches where their nodes are now and refines them again, where fairing converged. Returns, per hole,
  /// whether that changed anything.
  std::vector<std::uint8_t> refine_again(const FilledHoles& now);

  [[nodiscard]] const PolygonMesh& input() const noexcept { return mesh_; }
  [[nodiscard]] const Incidence& incidence() const noexcept { return incidence_; }
  [[nodiscard]] std::vector<Hole>& holes() noexcept { return holes_; }

  /// All patches behind the mesh: flat, and where they are.
  [[nodiscard]] FilledHoles filled() const;

 private:
  /// A patch, numbers of rim nodes in the order of the rim.
  struct PatchOfHole {
    Patch patch;
    std::vector<std::vector<Index>> joined;
    std::vector<Index> face_beside;  ///< each edge of the rim
  };
  [[nodiscard]] std::vector<std::vector<Index>> joined(const std::vector<Index>& rim);
  [[nodiscard]] double spacing_at(Index node) const;
  void note_new_edges(const std::vector<Index>& rim, const Patch& patch);

  const PolygonMesh& mesh_;
  Incidence incidence_;
  std::vector<Hole> holes_;
  std::vector<PatchOfHole> patches_;                ///< of every hole
  std::vector<Index> place_in_rim_;                 ///< of every node, in the hole that is being filled; −1 for none
  std::map<Index, std::vector<Index>> new_joined_;  ///< ends of new edges between nodes of the input
};

}  // namespace vspring
