#include "constraints/slivers.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <span>
#include <utility>

#include "shape/edges.hpp"
#include "shape/incidence.hpp"
#include "shape/segment.hpp"

namespace vspring {

namespace {

// Height over longest edge: below it, nodes may be in line but for coordinates of few digits.
constexpr double height_of_sliver = 1e-3;
// A sliver next to slivers changes after these.
constexpr int most_rounds = 8;

using Face = std::vector<Index>;

/// The place, among the nodes of a face, at which its longest edge ends.
std::size_t behind_longest_edge(std::span<const Index> face, const std::vector<Vector3>& positions) {
  std::size_t behind = 0;
  double longest = 0;
  for (std::size_t k = 0; k < face.size(); ++k) {
    const std::size_t next = (k + 1) % face.size();
    const double length =
        (positions[static_cast<std::size_t>(face[next])] - positions[static_cast<std::size_t>(face[k])]).squaredNorm();
    if (!(length > longest)) continue;
    longest = length;
    behind = next;
  }
  return behind;
}

/// Whether a face is hardly more than its longest edge.
bool is_sliver(std::span<const Index> face, const std::vector<Vector3>& positions) {
  if (face.size() < 3) return false;
  const std::size_t behind = behind_longest_edge(face, positions);
  const auto place = [&](std::size_t k) -> const Vector3& {
    return positions[static_cast<std::size_t>(face[(behind + k) % face.size()])];
  };
  const Vector3& first = place(0);
  const Vector3& last = place(face.size() - 1);
  const double most = height_of_sliver * height_of_sliver * (last - first).squaredNorm();
  for (std::size_t k = 1; k + 1 < face.size(); ++k) {
    const double share = nearest_share(place(k), first, last);
    if (!((place(k) - (1 - share) * first - share * last).squaredNorm() <= most)) return false;
  }
  return true;
}

/// A face rotated so that its longest edge runs from the last node to the first.
Face from_longest_edge(std::span<const Index> face, const std::vector<Vector3>& positions) {
  Face nodes(face.begin(), face.end());
  std::rotate(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(behind_longest_edge(face, positions)),
              nodes.end());
  return nodes;
}

/// Replacements of slivers and of the faces across their longest edges.
class Leaving {
 public:
  explicit Leaving(const PolygonMesh& mesh) : mesh_(mesh), incidence_(mesh), edges_(mesh, incidence_) {}

  void leave_out(Index sliver) {
    const Face nodes = from_longest_edge(mesh_.face(sliver), mesh_.positions());
    const std::optional<Index> across = face_across(nodes.front(), nodes.back(), sliver);
    if (!across || faces_.contains(sliver) || faces_.contains(*across)) return;
    Face joined;
    for (const Index node : mesh_.face(*across)) {
      if (std::find(nodes.begin() + 1, nodes.end() - 1, node) != nodes.end() - 1) return;
      joined.push_back(node);
      if (node == nodes.front()) joined.insert(joined.end(), nodes.begin() + 1, nodes.end() - 1);
    }
    faces_[*across] = std::move(joined);
    faces_[sliver] = {nodes.front(), nodes.back()};
  }

  [[nodiscard]] bool leaves_any() const { return !faces_.empty(); }

  [[nodiscard]] PolygonMesh take() const {
    MeshBuilder builder;
    for (const Vector3& position : mesh_.positions()) builder.add_node(position);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const auto found = faces_.find(f);
      builder.add_face(found == faces_.end() ? mesh_.face(f) : std::span<const Index>(found->second));
    }
    return builder.take();
  }

 private:
  /// The only other face at an edge, if it runs along it in this direction.
  std::optional<Index> face_across(Index from, Index to, Index face) {
    std::optional<Index> across;
    edges_.at_node(from, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour != to || uses.size() != 2) return;
      const EdgeUse& other = uses[uses[0].face == face ? 1 : 0];
      if (other.face != face && other.forward) across = other.face;
    });
    return across;
  }

  const PolygonMesh& mesh_;
  Incidence incidence_;
  EdgeFinder edges_;
  std::map<Index, Face> faces_;
};

std::vector<Index> slivers_of(const PolygonMesh& mesh) {
  std::vector<Index> slivers;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (is_sliver(mesh.face(f), mesh.positions())) slivers.push_back(f);
  }
  return slivers;
}

}  // namespace

Slivers::Slivers(const PolygonMesh& mesh) : mesh_(mesh), faces_(slivers_of(mesh)) {}

PolygonMesh Slivers::left_out(const Constraints& constraints) const {
  if (constraints.node_count() != mesh_.node_count()) return mesh_;
  PolygonMesh result = mesh_;
  std::vector<Index> slivers = faces_;
  for (int k = 0; k < most_rounds; ++k) {
    std::erase_if(slivers, [&](Index sliver) {
      const auto face = result.face(sliver);
      return !std::all_of(face.begin(), face.end(), [&](Index node) { return constraints.position_fixed(node); });
    });
    if (slivers.empty()) break;
    Leaving leaving(result);
    for (const Index sliver : slivers) leaving.leave_out(sliver);
    if (!leaving.leaves_any()) break;
    result = leaving.take();
    slivers = slivers_of(result);
  }
  return result;
}

}  // namespace vspring
