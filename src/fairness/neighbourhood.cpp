#include "fairness/neighbourhood.hpp"

#include <algorithm>

namespace vspring {

namespace {

// At the hub of a large fan only evenly spread faces are used, and in large faces only near nodes: otherwise the cost
// would be quadratic in the number of neighbours.
constexpr std::size_t most_corners = 32;
constexpr Index reach_in_face = 8;

/// Calls use(i) for the nodes of a corner's face, except its own.
template <typename Use>
void for_face(const PolygonMesh& mesh, Corner corner, const Use& use) {
  const auto face = mesh.face(corner.face);
  const auto size = static_cast<Index>(face.size());
  const auto at = [&](Index place) { return face[static_cast<std::size_t>((place % size + size) % size)]; };
  if (size <= 2 * reach_in_face + 1) {
    for (Index place = corner.place + 1; place < size; ++place) use(face[static_cast<std::size_t>(place)]);
    for (Index place = 0; place < corner.place; ++place) use(face[static_cast<std::size_t>(place)]);
  } else {
    for (Index k = 1; k <= reach_in_face; ++k) {
      use(at(corner.place + k));
      use(at(corner.place - k));
    }
  }
}

}  // namespace

FaceNeighbours::FaceNeighbours(const PolygonMesh& mesh, const Incidence& incidence,
                               std::span<const std::uint8_t> usable, ThreadTeam& team) {
  const auto gather = [&](std::size_t first, std::size_t last, Part& part) {
    part.begin.reserve(last - first + 1);
    part.nodes.reserve(8 * (last - first));
    for (std::size_t i = first; i < last; ++i) {
      const auto node = static_cast<Index>(i);
      const auto begin = static_cast<std::ptrdiff_t>(part.nodes.size());
      const auto corners = incidence.corners(node);
      const std::size_t step = (corners.size() + most_corners - 1) / most_corners;
      for (std::size_t k = 0; k < corners.size(); k += step) {
        for_face(mesh, corners[k], [&](Index j) {
          if (j == node || usable[static_cast<std::size_t>(j)] == 0) return;
          if (std::find(part.nodes.begin() + begin, part.nodes.end(), j) == part.nodes.end()) part.nodes.push_back(j);
        });
      }
      part.begin.push_back(static_cast<std::uint32_t>(part.nodes.size()));
    }
    part.nodes.shrink_to_fit();
  };
  parts_ = parallel_parts(team, mesh.positions().size(), nodes_per_task, Part(), gather);
}

void Neighbourhood::add(Index node) {
  std::size_t slot = (static_cast<std::uint32_t>(node) * 2654435761U) >> 24;
  while (seen_[slot].round == round_) {
    if (seen_[slot].node == node) return;
    slot = (slot + 1) % slots;
  }
  if (nodes_.size() > most_nodes) return;
  seen_[slot] = {node, round_};
  nodes_.push_back(node);
}

void Neighbourhood::add_ring() {
  const std::size_t end = end_[rings_];
  for (std::size_t k = rings_ > 0 ? end_[rings_ - 1] : 0; k < end; ++k) {
    for (const Index i : neighbours_->of(nodes_[k])) add(i);
  }
  end_[++rings_] = nodes_.size();
}

void Neighbourhood::go_to(Index node) {
  ++round_;
  nodes_.clear();
  add(node);
  rings_ = 0;
  end_[0] = nodes_.size();
}

std::span<const Index> Neighbourhood::around(std::size_t wanted) {
  std::size_t ring = 0;
  for (; ring < most_rings && (ring < fewest_rings || end_[ring] <= wanted); ++ring) {
    if (ring == rings_) add_ring();
  }
  return std::span<const Index>(nodes_).subspan(1, end_[ring] - 1);
}

}  // namespace vspring
