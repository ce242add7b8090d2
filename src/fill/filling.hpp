#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "fill/refinement.hpp"
#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// A mesh whose holes are filled with patches.
class Filling {
 public:
  /// The mesh must outlive it. Cost: linear.
  explicit Filling(const PolygonMesh& mesh);

  /// Triangulates and refines a patch, without fairing, or records in the hole why it cannot. If the thread's context
  /// is cancelled there is no patch. Cost: see triangulate() and refine().
  void fill(std::size_t hole);

  /// Takes the faired positions of patches that converged, and refines these again. Returns, per hole, whether that
  /// changed anything.
  std::vector<std::uint8_t> refine_again(const FilledHoles& now);

  [[nodiscard]] const PolygonMesh& input() const noexcept { return mesh_; }
  [[nodiscard]] const Incidence& incidence() const noexcept { return incidence_; }
  [[nodiscard]] std::vector<Hole>& holes() noexcept { return holes_; }

  /// The mesh followed by all patches: flat, and at their present positions.
  [[nodiscard]] FilledHoles filled() const;

 private:
  /// A patch; its first nodes are those of the rim, in order.
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
  std::vector<PatchOfHole> patches_;                ///< per hole
  std::vector<Index> place_in_rim_;                 ///< per node, in the hole being filled; −1 for none
  std::map<Index, std::vector<Index>> new_joined_;  ///< ends of new edges between nodes of the input
};

}  // namespace vspring
