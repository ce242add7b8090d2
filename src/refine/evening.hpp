#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

#include "refine/editable_triangles.hpp"
#include "refine/input_surface.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Triangles on a surface, and what their nodes may do.
struct TrianglesOnSurface {
  EditableTriangles triangles;
  // Per node.
  std::vector<Vector3> places;
  std::vector<SurfacePlace> origins;  ///< where on the surface it is, or was when it was made
  std::vector<Vector3> normals;       ///< of the surface there
  std::vector<std::uint8_t> stays;    ///< 1: is not moved or removed
  std::vector<Index> lines;           ///< the line on which it moves, or EditableTriangles::no_line
};

/// Makes triangles even: see remesh().
class Evening {
 public:
  /// hold(node, a, b): constrains a new node between two nodes of the boundary, and returns whether it stays.
  using Hold = std::function<bool(Index node, Index a, Index b)>;

  Evening(TrianglesOnSurface& shape, const InputSurface& surface, double length, Hold hold);

  /// Throws Error(invalid_argument) for too many nodes.
  void run();

 private:
  /// A triangle before and after a change.
  struct Change {
    std::array<Vector3, 3> before;
    std::array<Vector3, 3> after;
    Vector3 normal;  ///< of the surface there; of any length
  };

  void find_targets();
  void spread(const std::vector<Index>& from, bool upwards);
  void split_long_edges();
  void split(Index a, Index b);
  void collapse_short_edges();
  [[nodiscard]] bool may_collapse(Index from, Index to) const;
  void flip_edges(bool by_angles);
  [[nodiscard]] bool improves(const std::array<Index, 4>& nodes, bool by_angles) const;
  [[nodiscard]] bool may_flip(const std::array<Index, 4>& nodes) const;
  void move_nodes();
  void move_node(Index node);
  [[nodiscard]] Vector3 middle_around(Index node) const;
  [[nodiscard]] Vector3 middle_on_line(Index node) const;
  [[nodiscard]] bool may_move(Index node, const Vector3& to, const Vector3& normal) const;
  [[nodiscard]] SurfacePlace on_surface(const Vector3& place, const Vector3& normal, Index line, Index near) const;
  [[nodiscard]] Change change_of(const EditableTriangles::Triangle& triangle, Index node, const Vector3& to,
                                 const Vector3& normal) const;
  [[nodiscard]] const Vector3& place(Index node) const { return shape_.places[static_cast<std::size_t>(node)]; }
  [[nodiscard]] const Vector3& normal(Index node) const { return shape_.normals[static_cast<std::size_t>(node)]; }
  [[nodiscard]] bool stays(Index node) const { return shape_.stays[static_cast<std::size_t>(node)] != 0; }
  [[nodiscard]] Index line(Index node) const { return shape_.lines[static_cast<std::size_t>(node)]; }
  [[nodiscard]] double length(Index a, Index b) const { return (place(a) - place(b)).norm(); }
  /// The length of an edge as a share of what it should be.
  [[nodiscard]] double excess(Index a, Index b) const {
    return 2 * length(a, b) / (targets_[static_cast<std::size_t>(a)] + targets_[static_cast<std::size_t>(b)]);
  }
  [[nodiscard]] bool is_at_boundary(Index node) const {
    return triangles_.neighbours(node).size() != triangles_.around(node).size();
  }

  TrianglesOnSurface& shape_;
  EditableTriangles& triangles_;
  const InputSurface& surface_;
  double length_;
  Hold hold_;
  double most_excess_ = 0;       ///< of an edge that a collapse makes
  std::vector<double> targets_;  ///< per node, how long edges should be there
};

}  // namespace vspring
