#include "shape/fan.hpp"

#include <algorithm>

namespace vspring {

namespace {

constexpr Index open_side = -1;

// With more faces, sorting is faster than comparing all pairs.
constexpr std::size_t few_faces = 16;

/// steps: less than once around.
Index along(std::span<const Index> face, Index place, Index steps) {
  const auto size = static_cast<Index>(face.size());
  const Index there = place + steps;
  return face[static_cast<std::size_t>(there < 0 ? there + size : there < size ? there : there - size)];
}

}  // namespace

void FanWalker::find_neighbours() {
  neighbours_.resize(2 * corners_.size());
  for (std::size_t k = 0; k < corners_.size(); ++k) {
    const auto face = mesh_->face(corners_[k].face);
    neighbours_[2 * k] = along(face, corners_[k].place, 1);
    neighbours_[2 * k + 1] = along(face, corners_[k].place, -1);
  }
}

bool FanWalker::pair_all_around(Index node) {
  const std::size_t faces = corners_.size();
  if (faces > few_faces) return false;
  twin_.assign(2 * faces, open_side);
  for (std::size_t a = 0; a < faces; ++a) {
    const Index before = neighbours_[2 * a + 1];
    // Takes the first that fits: if each side finds a partner of its own, no neighbour occurs twice.
    std::size_t b = faces;
    for (std::size_t k = faces; k-- > 0;) b = neighbours_[2 * k] == before ? k : b;
    if (b == faces || before == node || twin_[2 * b] != open_side) return false;
    twin_[2 * b] = static_cast<Index>(2 * a + 1);
    twin_[2 * a + 1] = static_cast<Index>(2 * b);
  }
  return true;
}

void FanWalker::pair_sides(Index node) {
  const auto sides = static_cast<Index>(2 * corners_.size());
  ends_.clear();
  for (Index side = 0; side < sides; ++side) ends_.push_back({neighbour(side), side});
  std::sort(ends_.begin(), ends_.end(), [](const End& a, const End& b) {
    return a.neighbour != b.neighbour ? a.neighbour < b.neighbour : a.side < b.side;
  });
  twin_.assign(static_cast<std::size_t>(sides), open_side);
  for (std::size_t k = 0; k < ends_.size();) {
    std::size_t end = k;
    while (end < ends_.size() && ends_[end].neighbour == ends_[k].neighbour) ++end;
    if (end - k == 2 && ends_[k].neighbour != node) {
      const Index a = ends_[k].side;
      const Index b = ends_[k + 1].side;
      twin_[static_cast<std::size_t>(a)] = b;
      twin_[static_cast<std::size_t>(b)] = a;
      if (a % 2 == b % 2 && fan_.flipped_neighbour < 0) fan_.flipped_neighbour = ends_[k].neighbour;
    } else if (end - k > 2 && fan_.crowded_neighbour < 0) {
      fan_.crowded_neighbour = ends_[k].neighbour;
    }
    k = end;
  }
}

void FanWalker::walk_chain(Index first_side) {
  const std::size_t first_link = fan_.links.size();
  const bool open = twin_[static_cast<std::size_t>(first_side)] == open_side;
  emit(neighbour(first_side), Link::spoke_bit | Link::start_bit);
  for (Index side = first_side; side != open_side && visited_[static_cast<std::size_t>(side / 2)] == 0;) {
    visited_[static_cast<std::size_t>(side / 2)] = 1;
    const Corner corner = corners_[static_cast<std::size_t>(side / 2)];
    const auto face = mesh_->face(corner.face);
    const Index step = side % 2 == 0 ? 1 : -1;
    for (Index k = 2; k + 1 < static_cast<Index>(face.size()); ++k) emit(along(face, corner.place, k * step), 0);
    emit(neighbour(side ^ 1), Link::spoke_bit);
    side = twin_[static_cast<std::size_t>(side ^ 1)];
  }
  ++fan_.chains;
  if (open) return;
  if (first_link == 0 && fan_.links.size() > 1 && visited_.end() == std::find(visited_.begin(), visited_.end(), 0)) {
    // A single closed chain: its last link repeats the first.
    fan_.links.pop_back();
    fan_.links.front().code &= ~Link::start_bit;
    fan_.closed = true;
  } else {
    fan_.links.back().code &= ~Link::spoke_bit;
  }
}

const Fan& FanWalker::walk(Index node) {
  corners_ = incidence_->corners(node);
  fan_.links.clear();
  fan_.closed = false;
  fan_.chains = 0;
  fan_.crowded_neighbour = fan_.flipped_neighbour = fan_.repeating_face = -1;
  if (corners_.empty()) return fan_;
  for (std::size_t k = 1; k < corners_.size(); ++k) {
    if (corners_[k].face == corners_[k - 1].face && fan_.repeating_face < 0) fan_.repeating_face = corners_[k].face;
  }
  find_neighbours();
  const bool all_around = pair_all_around(node);
  if (!all_around) pair_sides(node);
  visited_.assign(corners_.size(), 0);
  // Open chains first, from where the orientation of faces leads inwards; the remaining chains are closed.
  const auto sides = static_cast<Index>(twin_.size());
  for (Index parity = 0; parity < 2 && !all_around; ++parity) {
    for (Index side = parity; side < sides; side += 2) {
      if (twin_[static_cast<std::size_t>(side)] == open_side && visited_[static_cast<std::size_t>(side / 2)] == 0)
        walk_chain(side);
    }
  }
  for (Index side = 0; side < sides; side += 2) {
    if (visited_[static_cast<std::size_t>(side / 2)] == 0) walk_chain(side);
  }
  return fan_;
}

}  // namespace vspring
