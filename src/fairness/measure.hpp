#pragma once

#include <cstdint>
#include <vector>

#include "base/threads.hpp"
#include "spring/rings.hpp"
#include "vspring/fairness.hpp"

namespace vspring {

/// Measures the fairness of one mesh again and again while its nodes move.
class FairnessMeter {
 public:
  /// With constraints only faces with a moving node count. Mesh and team must outlive it.
  FairnessMeter(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team);

  /// positions: one per node. constraints: as given to the constructor, but positions and normals may differ. Cost:
  /// linear.
  [[nodiscard]] Fairness measure(const std::vector<Vector3>& positions, const Constraints* constraints) const;

 private:
  /// Two faces at an edge, and whether they run along it in the same direction.
  struct Neighbours {
    Index a;
    Index b;
    bool same_sense;
  };

  const PolygonMesh* mesh_;
  ThreadTeam* team_;
  std::vector<std::uint8_t> counted_;   // one per face
  std::vector<Index> node_;             // of the faces that count, ascending
  Rings rings_;                         // around these nodes, with the numbers of the mesh
  std::vector<Neighbours> neighbours_;  // faces that count
};

/// As the public measure(), on a team of threads.
Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team);

}  // namespace vspring
