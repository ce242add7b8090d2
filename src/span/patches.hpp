#pragma once

#include <string>
#include <vector>

#include "span/curve_nodes.hpp"
#include "span/loops.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/span.hpp"

namespace vspring {

/// The sides of a loop.
struct Sides {
  /// Half-arcs of each side, from one corner of the loop to the next; one side if it has no corner.
  std::vector<std::vector<Index>> sides;
};

/// Cuts a loop where one of its curves does not go on as the next and turns by more than 30°. Cost: linear.
Sides sides_of(const Loop& loop, const Arcs& arcs);

/// How many edges each arc gets: about its length over edge_length, and the same number on opposite sides of loops of
/// four sides that differ by less than a factor of 2.5. loops: the ones to be spanned. Cost: linear.
std::vector<Index> edges_of_arcs(const Arcs& arcs, const std::vector<Sides>& loops, double edge_length);

/// The faces that span a loop, and the places of the nodes within it.
struct LoopFaces {
  bool is_grid = false;         ///< a grid of quads; else triangles
  std::vector<Vector3> places;  ///< of the nodes within the loop
  /// Of all faces: nodes on curves by their numbers, and behind all of these the nodes within the loop.
  std::vector<Index> corners;

  /// How many nodes each face has.
  [[nodiscard]] std::size_t sides() const { return is_grid ? 4 : 3; }
};

/// Makes the faces of loops, one loop after the other.
class FaceMaker {
 public:
  /// nodes: on the curves; they must outlive it.
  explicit FaceMaker(const CurveNodes& nodes);

  /// Makes a grid of quads where opposite sides have the same number of edges, else triangles. are_fine: whether
  /// triangles are split until they are as dense as the nodes on the curves. Returns why there can be no faces; empty
  /// if there are.
  std::string span(const Sides& loop, bool are_fine, LoopFaces& made);

 private:
  [[nodiscard]] std::vector<Index> nodes_along(const std::vector<Index>& halves) const;
  void make_grid(const std::vector<std::vector<Index>>& sides, LoopFaces& made) const;
  [[nodiscard]] std::string make_triangles(const std::vector<Index>& rim, bool are_fine, LoopFaces& made);
  [[nodiscard]] const Vector3& place(Index node) const { return nodes_.places[static_cast<std::size_t>(node)]; }

  const CurveNodes& nodes_;
  std::vector<std::vector<Index>> joined_;  ///< per node on curves those to which an edge leads
};

/// The mesh of the nodes on curves and of the spanned loops, one after the other; tells each loop where its nodes and
/// faces are. faces: per loop. Cost: linear.
PolygonMesh mesh_of(const CurveNodes& nodes, const std::vector<LoopFaces>& faces, std::vector<NetworkLoop>& loops);

}  // namespace vspring
