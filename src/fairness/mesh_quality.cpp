#include "fairness/mesh_quality.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/edges.hpp"
#include "shape/face_geometry.hpp"

namespace vspring {

namespace {

class Inspection {
 public:
  Inspection(const PolygonMesh& mesh, const Incidence& incidence, const std::vector<Vector3>& positions,
             const std::vector<std::uint8_t>& marked, const std::vector<std::uint8_t>& oriented)
      : mesh_(mesh),
        incidence_(incidence),
        positions_(positions),
        marked_(marked),
        oriented_(oriented),
        vector_areas_(marked.size(), Vector3::Zero()),
        against_(mesh.corners().size(), 0) {}

  MeshQuality inspect(ThreadTeam& team) {
    MeshQuality all;
    over_faces(team, all, [&](Index f, MeshQuality& part) { look_at_face(f, part); });
    const auto nodes = static_cast<std::size_t>(mesh_.node_count());
    const auto look = [&](std::size_t begin, std::size_t end, MeshQuality& part) {
      EdgeFinder edges(mesh_, incidence_);
      for (std::size_t i = begin; i < end; ++i) {
        look_at_edges(static_cast<Index>(i), edges, part);
        if (oriented_[i] != 0) judge_faces(static_cast<Index>(i));
      }
    };
    for (const MeshQuality& part : parallel_parts(team, nodes, nodes_per_task, MeshQuality(), look)) all.add(part);
    over_faces(team, all, [&](Index f, MeshQuality& part) { part.flipped_faces += flipped(f) ? 1 : 0; });
    return all;
  }

 private:
  [[nodiscard]] const Vector3& at(Index node) const { return positions_[static_cast<std::size_t>(node)]; }
  [[nodiscard]] bool marked(Index face) const { return marked_[static_cast<std::size_t>(face)] != 0; }

  template <typename Look>
  void over_faces(ThreadTeam& team, MeshQuality& all, const Look& look) {
    const auto look_at = [&](std::size_t begin, std::size_t end, MeshQuality& part) {
      for (std::size_t f = begin; f < end; ++f) {
        if (marked_[f] != 0) look(static_cast<Index>(f), part);
      }
    };
    for (const MeshQuality& part : parallel_parts(team, marked_.size(), faces_per_task, MeshQuality(), look_at))
      all.add(part);
  }

  void look_at_face(Index f, MeshQuality& part) {
    const auto face = mesh_.face(f);
    const Vector3 normal = unit_normal(face, positions_);
    if (normal.isZero(0)) ++part.zero_area_faces;
    Vector3& area = vector_areas_[static_cast<std::size_t>(f)];
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Vector3 after = at(face[(k + 1) % face.size()]) - at(face[k]);
      const Vector3 before = at(face[(k + face.size() - 1) % face.size()]) - at(face[k]);
      area += (at(face[k]) - at(face[0])).cross(after);
      if (after.isZero(0) || before.isZero(0)) continue;
      const Vector3 cross = after.cross(before);
      double angle = std::atan2(cross.norm(), after.dot(before));
      if (cross.dot(normal) < 0) angle = 2 * std::numbers::pi - angle;
      part.smallest_angle = std::min(part.smallest_angle, angle);
      part.greatest_angle = std::max(part.greatest_angle, angle);
    }
  }

  void look_at_edges(Index node, EdgeFinder& edges, MeshQuality& part) const {
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    edges.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour == node ||
          std::none_of(uses.begin(), uses.end(), [&](const EdgeUse& use) { return marked(use.face); }))
        return;
      const double length = (at(neighbour) - at(node)).norm();
      if (length > 0) {
        shortest = std::min(shortest, length);
        longest = std::max(longest, length);
      } else if (neighbour > node) {
        ++part.zero_length_edges;
      }
    });
    if (!(longest > 0)) return;
    part.shortest_edge = std::min(part.shortest_edge, shortest);
    part.longest_edge = std::max(part.longest_edge, longest);
    part.neighbouring_edge_spread = std::max(part.neighbouring_edge_spread, longest / shortest);
  }

  void judge_faces(Index node) {
    Vector3 around = Vector3::Zero();
    for (const Corner corner : incidence_.corners(node)) around += vector_area(corner);
    for (const Corner corner : incidence_.corners(node)) {
      if (vector_area(corner).dot(around) < 0) against_[place(corner)] = 1;
    }
  }

  [[nodiscard]] const Vector3& vector_area(Corner corner) const {
    return vector_areas_[static_cast<std::size_t>(corner.face)];
  }
  [[nodiscard]] std::size_t place(Corner corner) const {
    return static_cast<std::size_t>(mesh_.face_begin(corner.face)) + static_cast<std::size_t>(corner.place);
  }

  [[nodiscard]] bool flipped(Index f) const {
    const auto begin = against_.begin() + mesh_.face_begin(f);
    const auto end = against_.begin() + mesh_.face_begin(f + 1);
    return std::find(begin, end, 0) == end;
  }

  const PolygonMesh& mesh_;
  const Incidence& incidence_;
  const std::vector<Vector3>& positions_;
  const std::vector<std::uint8_t>& marked_;
  const std::vector<std::uint8_t>& oriented_;
  std::vector<Vector3> vector_areas_;  // doubled; of marked faces
  std::vector<std::uint8_t> against_;  // one per corner
};

}  // namespace

void MeshQuality::add(const MeshQuality& other) {
  shortest_edge = std::min(shortest_edge, other.shortest_edge);
  longest_edge = std::max(longest_edge, other.longest_edge);
  neighbouring_edge_spread = std::max(neighbouring_edge_spread, other.neighbouring_edge_spread);
  smallest_angle = std::min(smallest_angle, other.smallest_angle);
  greatest_angle = std::max(greatest_angle, other.greatest_angle);
  flipped_faces += other.flipped_faces;
  zero_length_edges += other.zero_length_edges;
  zero_area_faces += other.zero_area_faces;
}

MeshQuality mesh_quality(const PolygonMesh& mesh, const Incidence& incidence, const std::vector<Vector3>& positions,
                         const std::vector<std::uint8_t>& marked_faces, const std::vector<std::uint8_t>& oriented_nodes,
                         ThreadTeam& team) {
  return Inspection(mesh, incidence, positions, marked_faces, oriented_nodes).inspect(team);
}

}  // namespace vspring
