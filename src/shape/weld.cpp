#include "vspring/weld.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <span>
#include <utility>

#include "shape/coincident_nodes.hpp"
#include "shape/corner_items.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

/// The corners of a face as representatives, without repeats of the corner before.
std::vector<Index> welded_corners(std::span<const Index> face, const std::vector<Index>& representative) {
  std::vector<Index> corners;
  for (const Index node : face) {
    const Index first = representative[static_cast<std::size_t>(node)];
    if (corners.empty() || corners.back() != first) corners.push_back(first);
  }
  while (corners.size() > 1 && corners.back() == corners.front()) corners.pop_back();
  return corners;
}

bool lies_at_three_places(const PolygonMesh& mesh, std::span<const Index> face) {
  const Vector3& first = mesh.position(face[0]);
  const auto other = std::find_if(face.begin(), face.end(), [&](Index i) { return mesh.position(i) != first; });
  return other != face.end() && std::any_of(other, face.end(), [&](Index i) {
           return mesh.position(i) != first && mesh.position(i) != mesh.position(*other);
         });
}

/// Nodes that no face has any more, unless another one that they are joined with stays.
std::vector<Index> removed_from(const Welded& welded, const PolygonMesh& input, const RefinedMesh& refined,
                                std::span<const Index> corners) {
  std::vector<std::uint8_t> is_used(input.positions().size(), 0);
  for (const Index node : corners) {
    if (node < input.node_count()) is_used[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<std::uint8_t> is_gone(input.positions().size(), 0);
  for (const Index node : refined.removed) is_gone[static_cast<std::size_t>(node)] = 1;
  std::vector<Index> removed;
  for (Index node = 0; node < input.node_count(); ++node) {
    const auto i = static_cast<std::size_t>(node);
    if (is_used[i] == 0 && is_gone[static_cast<std::size_t>(welded.representative[i])] != 0) removed.push_back(node);
  }
  return removed;
}

/// Takes nodes out of a mesh, of which no corner has them.
void remove_nodes(std::span<const Index> removed, std::vector<Vector3>& positions, std::vector<Index>& corners) {
  std::vector<Index> number(positions.size(), -1);
  std::vector<Vector3> kept;
  auto next = removed.begin();
  for (std::size_t node = 0; node < positions.size(); ++node) {
    if (next != removed.end() && static_cast<std::size_t>(*next) == node) {
      ++next;
      continue;
    }
    number[node] = static_cast<Index>(kept.size());
    kept.push_back(positions[node]);
  }
  positions = std::move(kept);
  for (Index& corner : corners) corner = number[static_cast<std::size_t>(corner)];
}

}  // namespace

Welded weld(const PolygonMesh& mesh, double tolerance) {
  const FaceNodes used(mesh);
  Welded result;
  result.tolerance = used.length(tolerance);
  CoincidentNodes near = coincident_nodes(mesh.positions(), used.nodes, used.box, result.tolerance);
  if (near.chained.first >= 0)
    throw Error(ErrorCode::unusable_shape,
                fmt::format("nodes {} and {} are {:.3g} apart, and nodes between them lead from one to the other, none "
                            "further than {:.3g} from the next: they cannot all be one",
                            near.chained.first, near.chained.second,
                            (mesh.position(near.chained.first) - mesh.position(near.chained.second)).stableNorm(),
                            result.tolerance),
                {{Remedy::weld, "weld within less"}});
  result.representative = std::move(near.first);
  for (const Index node : used.nodes)
    result.joined += result.representative[static_cast<std::size_t>(node)] != node ? 1 : 0;

  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  face_begin.reserve(static_cast<std::size_t>(mesh.face_count()) + 1);
  corners.reserve(mesh.corners().size());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const std::vector<Index> welded = welded_corners(face, result.representative);
    if (welded.size() >= 3) {
      corners.insert(corners.end(), welded.begin(), welded.end());
    } else if (face.size() < 3) {
      for (const Index node : face) corners.push_back(result.representative[static_cast<std::size_t>(node)]);
    } else if (lies_at_three_places(mesh, face)) {
      result.collapsed.push_back(f);
    }
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  result.mesh = PolygonMesh(mesh.positions(), std::move(face_begin), std::move(corners));
  return result;
}

std::vector<Vector3> Welded::positions(const std::vector<Vector3>& of_mesh) const {
  if (of_mesh.size() != representative.size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} positions given for {} nodes", of_mesh.size(), representative.size()));
  std::vector<Vector3> result = of_mesh;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const Index first = representative[i];
    if (first == static_cast<Index>(i)) continue;
    const Vector3& place = of_mesh[static_cast<std::size_t>(first)];
    result[i] = place != mesh.position(first) ? place : mesh.position(static_cast<Index>(i));
  }
  return result;
}

RefinedMesh Welded::unwelded(const PolygonMesh& input, const RefinedMesh& refined) const {
  std::vector<Index> own(mesh.corners().size(), -1);  // per corner of `mesh`, the node of the input
  const std::vector<FaceParts> parts = parts_of_faces(mesh, refined);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = input.face(f);
    const bool is_whole = face.size() == mesh.face(f).size();
    if (is_whole)
      std::copy(face.begin(), face.end(), own.begin() + mesh.face_begin(f));
    else if (parts[static_cast<std::size_t>(f)].is_divided)
      throw Error(ErrorCode::unusable_shape,
                  fmt::format("face {}: welding has joined two of its nodes, so it cannot be divided", f),
                  {{Remedy::weld, "weld within less"}, {Remedy::rules, "hold its nodes"}});
  }
  const CornerItems items = refined_items(mesh, refined, own, input.node_count(), /*joins_seams=*/true);
  std::vector<Vector3> positions = input.positions();
  for (std::size_t k = 0; k < items.new_count(); ++k) {
    Vector3 sum = Vector3::Zero();
    const auto of = items.means(k);
    for (std::size_t j = 0; j < of.size(); ++j) {
      const Vector3& place = positions[static_cast<std::size_t>(of[j])];
      sum += items.shares.empty() ? Vector3(place / static_cast<double>(of.size()))
                                  : Vector3(items.shares[static_cast<std::size_t>(items.mean_begin[k]) + j] * place);
    }
    positions.push_back(sum);
  }
  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  for (Index f = 0; f < refined.mesh.face_count(); ++f) {
    const Index from = refined.face_from[static_cast<std::size_t>(f)];
    const auto begin = items.items.begin() + refined.mesh.face_begin(f);
    const auto face = input.face(from);
    if (parts[static_cast<std::size_t>(from)].is_divided)
      corners.insert(corners.end(), begin, begin + static_cast<std::ptrdiff_t>(refined.mesh.face(f).size()));
    else
      corners.insert(corners.end(), face.begin(), face.end());
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  RefinedMesh result = {.mesh = {},
                        .mean_begin = items.mean_begin,
                        .mean_of = items.mean_of,
                        .face_from = refined.face_from,
                        .shares = items.shares,
                        .mean_face = refined.mean_face};
  if (refined.is_remeshed()) {
    result.removed = removed_from(*this, input, refined, corners);
    remove_nodes(result.removed, positions, corners);
  }
  result.mesh = PolygonMesh(std::move(positions), std::move(face_begin), std::move(corners));
  return result;
}

}  // namespace vspring
