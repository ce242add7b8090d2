#pragma once

#include <utility>
#include <vector>

#include "span/loops.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/span.hpp"

namespace vspring {

/// The loops that are spanned, as their sides are seen.
struct Sides {
  /// Half-arcs of each side, from one corner of the loop to the next; one side if it has no corner.
  std::vector<std::vector<Index>> sides;
};

/// Cuts a loop where one of its curves does not go on as the next and turns by more than 30°. Cost: linear.
Sides sides_of(const Loop& loop, const Arcs& arcs);

/// How many edges each arc gets: about its length over edge_length, and the same number on opposite sides of loops of
/// four sides that differ by less than a factor of 2.5. loops: the ones to be spanned. Cost: linear.
std::vector<Index> edges_of_arcs(const Arcs& arcs, const std::vector<Sides>& loops, double edge_length);

/// Makes the faces of loops, one after the other.
class PatchMaker {
 public:
  /// places: of the nodes on curves. nodes_of_arc: these nodes along each arc, both ends included.
  PatchMaker(std::vector<Vector3> places, std::vector<std::vector<Index>> nodes_of_arc);

  /// Makes a grid of quads where opposite sides have the same number of edges, else triangles. Sets the nodes and faces
  /// of the loop, or returns why there can be none.
  std::string span(const Sides& loop, NetworkLoop& made);

  [[nodiscard]] PolygonMesh take();

 private:
  [[nodiscard]] std::vector<Index> nodes_along(const std::vector<Index>& halves) const;
  void make_grid(const std::vector<std::vector<Index>>& sides);
  [[nodiscard]] std::string make_triangles(const std::vector<Index>& rim);
  void add_face(const std::vector<Index>& nodes);
  [[nodiscard]] const Vector3& place(Index node) const { return places_[static_cast<std::size_t>(node)]; }

  std::vector<Vector3> places_;
  std::vector<std::vector<Index>> nodes_of_arc_;
  std::vector<Index> face_begin_ = {0};
  std::vector<Index> corners_;
  std::vector<std::vector<Index>> joined_;  ///< per node on curves those to which an edge leads
};

}  // namespace vspring
