#pragma once

#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// Edges of a surface, each by its two nodes.
using MeshEdges = std::vector<std::pair<Index, Index>>;

/// A polygonal surface: node positions and faces of any number of nodes (triangles, quads, n-gons, mixed).
///
/// Connectivity is fixed at construction; positions may change. Only memory safety is checked here: a mesh may have
/// non-manifold spots, repeated or isolated nodes, or coordinates that are not finite. check() lists these; fair()
/// refuses them where a node would have to move there. Copies share faces and positions, so copying takes no time or
/// memory.
class PolygonMesh {
 public:
  /// A mesh without nodes.
  PolygonMesh();
  /// Shares faces and positions.
  PolygonMesh(const PolygonMesh&) = default;
  /// Likewise.
  PolygonMesh& operator=(const PolygonMesh&) = default;
  /// Moving is copying: the source stays valid.
  PolygonMesh(PolygonMesh&& other) noexcept : PolygonMesh(static_cast<const PolygonMesh&>(other)) {}
  /// Likewise.
  PolygonMesh& operator=(PolygonMesh&& other) noexcept { return *this = static_cast<const PolygonMesh&>(other); }
  ~PolygonMesh() = default;

  /// positions: one per node. face_begin: faces + 1 ascending offsets into corners, the first 0 and the last
  /// corners.size(). corners: the nodes of each face in order around it.
  /// Throws Error(unusable_shape) naming the face when offsets do not ascend or a node number is out of range.
  /// Cost: linear.
  PolygonMesh(std::vector<Vector3> positions, std::vector<Index> face_begin, std::vector<Index> corners);

  /// A mesh from flat arrays, as other libraries and languages have them. coordinates: x, y, z of each node in turn.
  /// Other arguments as for the constructor. Throws what it throws, and Error(invalid_argument) unless there are three
  /// coordinates a node. Cost: one copy of each array.
  [[nodiscard]] static PolygonMesh from_arrays(std::span<const double> coordinates, std::span<const Index> face_begin,
                                               std::span<const Index> corners);
  /// A mesh whose faces all have `sides` nodes, 3 in a mesh of triangles. Throws, too, Error(invalid_argument) unless
  /// `sides` is 1 or more and the number of corners is a multiple of it, at most 2³¹ − 1.
  [[nodiscard]] static PolygonMesh from_arrays(std::span<const double> coordinates, std::span<const Index> corners,
                                               Index sides = 3);

  /// Number of nodes, those of no face among them.
  [[nodiscard]] Index node_count() const noexcept { return static_cast<Index>(positions_->size()); }
  /// Number of faces, of whatever number of nodes.
  [[nodiscard]] Index face_count() const noexcept { return faces_->count; }

  /// One per node; see coordinates() for a flat array.
  [[nodiscard]] const std::vector<Vector3>& positions() const noexcept { return *positions_; }
  /// Of one node, from 0 to node_count() − 1.
  [[nodiscard]] const Vector3& position(Index node) const { return (*positions_)[static_cast<std::size_t>(node)]; }
  /// Replaces the positions; copies of the mesh keep theirs. References from positions() become invalid. Throws
  /// Error(invalid_argument) unless there is one position per node.
  void set_positions(std::vector<Vector3> positions);
  /// Likewise by a flat array: x, y, z of each node in turn. Cost: one copy.
  void set_positions(std::span<const double> coordinates);

  /// The nodes of a face, in order around it.
  [[nodiscard]] std::span<const Index> face(Index face) const {
    const Index begin = face_begin(face);
    return {faces_->corners.data() + begin, static_cast<std::size_t>(face_begin(face + 1) - begin)};
  }
  /// The offset of a face's first node in corners(); for face_count(), the end of the last face.
  [[nodiscard]] Index face_begin(Index face) const {
    return faces_->begin.empty() ? face * faces_->sides : faces_->begin[static_cast<std::size_t>(face)];
  }
  /// These offsets of all faces, and the end. Cost: linear, as each call makes them anew.
  [[nodiscard]] std::vector<Index> face_begin() const;
  /// The nodes of all faces, face by face.
  [[nodiscard]] const std::vector<Index>& corners() const noexcept { return faces_->corners; }
  /// Whether both meshes have equally many nodes and the same faces. Cost: none if they share faces, else linear.
  [[nodiscard]] bool has_same_faces(const PolygonMesh& other) const;

 private:
  struct Faces {
    Index count = 0;
    Index sides = 0;  ///< of every face, where `begin` is empty
    std::vector<Index> begin;
    std::vector<Index> corners;
  };
  /// Throws as the public constructor does.
  [[nodiscard]] static Faces faces_of(std::vector<Index> face_begin, std::vector<Index> corners);
  PolygonMesh(std::vector<Vector3> positions, Faces faces);

  std::shared_ptr<const std::vector<Vector3>> positions_;
  std::shared_ptr<const Faces> faces_;
};

/// Collects a mesh node by node and face by face.
class MeshBuilder {
 public:
  /// Returns the number of the new node.
  Index add_node(const Vector3& position) {
    positions_.push_back(position);
    return static_cast<Index>(positions_.size()) - 1;
  }
  /// Appends a face of these nodes, in order around it; take() checks them.
  void add_face(std::span<const Index> nodes) {
    corners_.insert(corners_.end(), nodes.begin(), nodes.end());
    face_begin_.push_back(static_cast<Index>(corners_.size()));
  }
  /// Likewise, of nodes in braces.
  void add_face(std::initializer_list<Index> nodes) { add_face(std::span(nodes.begin(), nodes.size())); }

  /// Hands the mesh over; throws as the constructor of PolygonMesh does.
  [[nodiscard]] PolygonMesh take() { return {std::move(positions_), std::move(face_begin_), std::move(corners_)}; }

 private:
  std::vector<Vector3> positions_;
  std::vector<Index> face_begin_ = {0};
  std::vector<Index> corners_;
};

}  // namespace vspring
