#include "fill/filling.hpp"

#include <algorithm>
#include <utility>

#include "fill/rim.hpp"
#include "fill/triangulation.hpp"
#include "shape/face_geometry.hpp"

namespace vspring {

namespace {

/// Calls use(neighbour) for both edges at the node of every face there.
template <typename Use>
void for_each_neighbour(const PolygonMesh& mesh, const Incidence& incidence, Index node, const Use& use) {
  for (const Corner corner : incidence.corners(node)) {
    const auto face = mesh.face(corner.face);
    const auto place = static_cast<std::size_t>(corner.place);
    use(face[(place + 1) % face.size()]);
    use(face[(place + face.size() - 1) % face.size()]);
  }
}

}  // namespace

Filling::Filling(const PolygonMesh& mesh)
    : mesh_(mesh),
      incidence_(mesh),
      holes_(find_holes(mesh, incidence_)),
      place_in_rim_(static_cast<std::size_t>(mesh.node_count()), -1),
      positions_(mesh.positions()),
      face_begin_(mesh.face_begin()),
      corners_(mesh.corners()) {}

void Filling::fill(Hole& hole) {
  const std::vector<Index>& nodes = hole.rim;
  Rim rim;
  std::vector<Index> faces;
  Patch patch;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    faces.push_back(face_beside(mesh_, incidence_, nodes[k], nodes[(k + 1) % nodes.size()]));
    rim.places.push_back(mesh_.position(nodes[k]));
    rim.normals.push_back(unit_normal(mesh_.face(faces.back()), mesh_.positions()));
    patch.spacing.push_back(spacing_at(nodes[k]));
    patch.like.push_back(static_cast<Index>(k));
  }
  rim.joined = joined(nodes);
  Triangulation triangulation = triangulate(rim);
  if (triangulation.triangles.empty() || triangulation.is_folded) {
    hole.state = HoleState::unfillable;
    hole.fault = triangulation.is_folded ? HoleFault::folded : HoleFault::no_triangulation;
    return;
  }
  patch.places = rim.places;
  patch.triangles = std::move(triangulation.triangles);
  refine(patch, rim.joined);
  put(hole, patch, faces);
}

std::vector<std::vector<Index>> Filling::joined(const std::vector<Index>& rim) {
  for (std::size_t k = 0; k < rim.size(); ++k) place_in_rim_[static_cast<std::size_t>(rim[k])] = static_cast<Index>(k);
  const auto last = static_cast<Index>(rim.size()) - 1;
  std::vector<std::vector<Index>> result(rim.size());
  for (std::size_t k = 0; k < rim.size(); ++k) {
    const auto here = static_cast<Index>(k);
    const auto note = [&](Index neighbour) {
      const Index there = place_in_rim_[static_cast<std::size_t>(neighbour)];
      if (there < 0) return;
      const Index apart = std::abs(there - here);
      if (apart > 1 && apart < last) result[k].push_back(there);
    };
    for_each_neighbour(mesh_, incidence_, rim[k], note);
    if (const auto more = new_joined_.find(rim[k]); more != new_joined_.end())
      std::for_each(more->second.begin(), more->second.end(), note);
    std::sort(result[k].begin(), result[k].end());
  }
  for (const Index node : rim) place_in_rim_[static_cast<std::size_t>(node)] = -1;
  return result;
}

double Filling::spacing_at(Index node) const {
  double sum = 0;
  int count = 0;
  for_each_neighbour(mesh_, incidence_, node, [&](Index neighbour) {
    sum += (mesh_.position(neighbour) - mesh_.position(node)).norm();
    ++count;
  });
  return sum / count;
}

void Filling::put(Hole& hole, const Patch& patch, const std::vector<Index>& face_beside_rim) {
  const auto rim_size = hole.rim.size();
  hole.state = HoleState::filled;
  hole.first_node = static_cast<Index>(positions_.size());
  hole.node_count = static_cast<Index>(patch.places.size() - rim_size);
  hole.first_face = static_cast<Index>(face_begin_.size()) - 1;
  hole.face_count = static_cast<Index>(patch.triangles.size());
  const auto node_of = [&](Index node) {
    const auto k = static_cast<std::size_t>(node);
    return k < rim_size ? hole.rim[k] : hole.first_node + static_cast<Index>(k - rim_size);
  };
  const auto like = [&](Index node) { return static_cast<std::size_t>(patch.like[static_cast<std::size_t>(node)]); };
  for (std::size_t k = rim_size; k < patch.places.size(); ++k) {
    positions_.push_back(patch.places[k]);
    node_like_.push_back(hole.rim[like(static_cast<Index>(k))]);
  }
  for (const auto& triangle : patch.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index node = node_of(triangle[c]);
      const Index next = node_of(triangle[(c + 1) % 3]);
      corners_.push_back(node);
      if (node >= hole.first_node || next >= hole.first_node) continue;
      new_joined_[node].push_back(next);
      new_joined_[next].push_back(node);
    }
    face_begin_.push_back(static_cast<Index>(corners_.size()));
    face_like_.push_back(face_beside_rim[like(triangle[0])]);
  }
}

FilledHoles Filling::take() {
  FilledHoles result;
  result.mesh = PolygonMesh(std::move(positions_), std::move(face_begin_), std::move(corners_));
  result.positions = result.mesh.positions();
  result.node_like = std::move(node_like_);
  result.face_like = std::move(face_like_);
  result.holes = std::move(holes_);
  return result;
}

}  // namespace vspring
