#include "fill/filling.hpp"

#include <algorithm>
#include <utility>

#include "fill/rim.hpp"
#include "fill/rim_triangles.hpp"
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
      patches_(holes_.size()),
      place_in_rim_(static_cast<std::size_t>(mesh.node_count()), -1) {}

void Filling::fill(std::size_t number) {
  Hole& hole = holes_[number];
  const std::vector<Index>& nodes = hole.rim;
  Rim rim;
  PatchOfHole made;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    made.face_beside.push_back(face_beside(mesh_, incidence_, nodes[k], nodes[(k + 1) % nodes.size()]));
    rim.places.push_back(mesh_.position(nodes[k]));
    rim.normals.push_back(unit_normal(mesh_.face(made.face_beside.back()), mesh_.positions()));
    made.patch.spacing.push_back(spacing_at(nodes[k]));
    made.patch.like.push_back(static_cast<Index>(k));
  }
  rim.joined = joined(nodes);
  RimTriangles triangulation = triangulate(rim);
  if (triangulation.triangles.empty() || triangulation.is_folded) {
    hole.state = HoleState::unfillable;
    hole.fault = triangulation.is_folded ? HoleFault::folded : HoleFault::no_triangulation;
    return;
  }
  made.patch.places = made.patch.flat = std::move(rim.places);
  made.patch.triangles = std::move(triangulation.triangles);
  made.joined = std::move(rim.joined);
  refine(made.patch, made.joined);
  note_new_edges(nodes, made.patch);
  patches_[number] = std::move(made);
  hole.state = HoleState::filled;
}

std::vector<std::uint8_t> Filling::refine_again(const FilledHoles& now) {
  std::vector<std::uint8_t> changed(holes_.size(), 0);
  for (std::size_t h = 0; h < holes_.size(); ++h) {
    const Hole& hole = now.holes[h];
    Patch& patch = patches_[h].patch;
    std::copy_n(now.positions.begin() + std::max<Index>(hole.first_node, 0), hole.node_count,
                patch.places.end() - hole.node_count);
    if (hole.outcome == Outcome::converged) changed[h] = refine(patch, patches_[h].joined) ? 1 : 0;
  }
  return changed;
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

void Filling::note_new_edges(const std::vector<Index>& rim, const Patch& patch) {
  const auto count = static_cast<Index>(rim.size());
  for (const auto& triangle : patch.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = triangle[c];
      const Index b = triangle[(c + 1) % 3];
      if (a >= count || b >= count) continue;
      new_joined_[rim[static_cast<std::size_t>(a)]].push_back(rim[static_cast<std::size_t>(b)]);
      new_joined_[rim[static_cast<std::size_t>(b)]].push_back(rim[static_cast<std::size_t>(a)]);
    }
  }
}

FilledHoles Filling::filled() const {
  FilledHoles result;
  result.holes = holes_;
  result.positions = mesh_.positions();
  std::vector<Vector3> flat = mesh_.positions();
  std::vector<Index> face_begin = mesh_.face_begin();
  std::vector<Index> corners = mesh_.corners();
  for (std::size_t h = 0; h < holes_.size(); ++h) {
    Hole& hole = result.holes[h];
    if (hole.state != HoleState::filled) continue;
    const Patch& patch = patches_[h].patch;
    const std::size_t rim = hole.rim.size();
    hole.first_node = static_cast<Index>(flat.size());
    hole.node_count = static_cast<Index>(patch.places.size() - rim);
    hole.first_face = static_cast<Index>(face_begin.size()) - 1;
    hole.face_count = static_cast<Index>(patch.triangles.size());
    const auto like = [&](Index node) { return static_cast<std::size_t>(patch.like[static_cast<std::size_t>(node)]); };
    for (std::size_t k = rim; k < patch.places.size(); ++k) {
      flat.push_back(patch.flat[k]);
      result.positions.push_back(patch.places[k]);
      result.node_like.push_back(hole.rim[like(static_cast<Index>(k))]);
    }
    for (const auto& triangle : patch.triangles) {
      for (const Index node : triangle) {
        const auto k = static_cast<std::size_t>(node);
        corners.push_back(k < rim ? hole.rim[k] : hole.first_node + static_cast<Index>(k - rim));
      }
      face_begin.push_back(static_cast<Index>(corners.size()));
      result.face_like.push_back(patches_[h].face_beside[like(triangle[0])]);
    }
  }
  result.mesh = PolygonMesh(std::move(flat), std::move(face_begin), std::move(corners));
  return result;
}

}  // namespace vspring
