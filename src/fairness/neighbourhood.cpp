#include "fairness/neighbourhood.hpp"

#include <algorithm>

namespace vspring {

namespace {

constexpr std::size_t most_nodes = 96;
constexpr int fewest_rings = 2;
constexpr int most_rings = 5;
// At the hub of a large fan only evenly spread faces are looked at, and in large faces only the nodes near by:
// otherwise the hub's neighbours together would cost the square of their number.
constexpr std::size_t most_corners = 32;
constexpr Index reach_in_face = 8;

}  // namespace

void Neighbourhood::add(Index node) {
  std::size_t slot = (static_cast<std::uint32_t>(node) * 2654435761U) >> 24;
  while (seen_[slot].round == round_) {
    if (seen_[slot].node == node) return;
    slot = (slot + 1) % slots;
  }
  if (nodes_.size() > most_nodes || !mesh_->position(node).allFinite()) return;
  seen_[slot] = {node, round_};
  nodes_.push_back(node);
}

void Neighbourhood::add_face(Corner corner) {
  const auto face = mesh_->face(corner.face);
  const auto size = static_cast<Index>(face.size());
  const auto at = [&](Index place) { return face[static_cast<std::size_t>((place % size + size) % size)]; };
  if (size <= 2 * reach_in_face + 1) {
    for (Index k = 1; k < size; ++k) add(at(corner.place + k));
  } else {
    for (Index k = 1; k <= reach_in_face; ++k) {
      add(at(corner.place + k));
      add(at(corner.place - k));
    }
  }
}

std::span<const Index> Neighbourhood::around(Index node, std::size_t wanted) {
  ++round_;
  nodes_.clear();
  add(node);
  std::size_t begin = 0;
  for (int ring = 0; ring < most_rings && (ring < fewest_rings || nodes_.size() <= wanted); ++ring) {
    const std::size_t end = nodes_.size();
    for (; begin < end; ++begin) {
      const auto corners = incidence_->corners(nodes_[begin]);
      const std::size_t step = (corners.size() + most_corners - 1) / most_corners;
      for (std::size_t k = 0; k < corners.size(); k += step) add_face(corners[k]);
    }
  }
  return nodes_.empty() ? std::span<const Index>() : std::span<const Index>(nodes_).subspan(1);
}

}  // namespace vspring
