#pragma once

#include <cstddef>
#include <vector>

#include "shape/sheets.hpp"
#include "solve/lines_of_surface.hpp"
#include "vspring/constraints.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// A surface cut along its sharp edges: each side has its own nodes there, which it holds.
class SharpSides {
 public:
  /// The chains are held where they are, or are lines that are fitted first. with_boundary: so is the boundary, from
  /// one end of a chain to the next. Throws what as_sharp_edges() throws, and Error(unusable_constraint) for
  /// constraints of another node count. The mesh must outlive it.
  SharpSides(const PolygonMesh& mesh, const Constraints& constraints, const FairOptions& options, SharpCurves curves,
             bool with_boundary);

  /// Lines, and what is held of the surface as a whole. Sides hold them where hold() has them.
  [[nodiscard]] LinesOfSurface& lines() { return lines_; }
  /// How many of them are chains; those of the boundary follow.
  [[nodiscard]] std::size_t chains() const { return chains_; }

  /// The sides: nodes of the mesh, then the copies that other sides have of them.
  [[nodiscard]] const MeshOfSheets& cut() const { return cut_; }
  /// What they hold.
  [[nodiscard]] Constraints held() const;
  /// Positions of all nodes of the sides, given those of the mesh.
  [[nodiscard]] std::vector<Vector3> positions(std::vector<Vector3> of_mesh) const;
  /// Turns the result for the sides into that for the mesh: the share `strength` of the way.
  void join_sides(double strength, std::vector<Vector3>& positions, FairReport& report) const;
  /// Whether the surface has more folds or crossings than the mesh, as its lines have moved; not where options accept
  /// that. positions: of the nodes of the mesh.
  [[nodiscard]] bool is_worse(const std::vector<Vector3>& positions, const FairOptions& options,
                              const Context& context) const;

 private:
  [[nodiscard]] std::vector<Index> nodes_with_copies() const;

  const PolygonMesh* mesh_;
  SharpEdges sharp_;
  Constraints constraints_;  ///< with chains held that stay
  bool fixes_normals_;
  std::size_t chains_;
  LinesOfSurface lines_;
  MeshOfSheets cut_;
};

/// Says of a surface that is_worse() what has been done about it: its sharp edges stay in this one, or it is handed
/// out.
void tell_that_edges_stay(FairReport& report);
void tell_that_it_is_worse(FairReport& report);

/// fair() with options.sharp_edges.
FairResult fair_sharp_sides(const PolygonMesh& mesh, const Constraints& constraints, FairOptions options,
                            Context& context);

}  // namespace vspring
