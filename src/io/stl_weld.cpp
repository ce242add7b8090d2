#include "io/stl_weld.hpp"

#include <Eigen/Core>
#include <array>
#include <bit>

namespace vspring {
namespace {

using Bits = std::array<std::uint64_t, 3>;

Bits bits_of(const Vector3& position) {
  // Adding zero turns −0 into 0.
  return {Eigen::numext::bit_cast<std::uint64_t>(position.x() + 0.0),
          Eigen::numext::bit_cast<std::uint64_t>(position.y() + 0.0),
          Eigen::numext::bit_cast<std::uint64_t>(position.z() + 0.0)};
}

std::size_t hash_of(const Bits& bits) {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : bits) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

}  // namespace

// A closed surface of triangles has six corners to a node.
Weld::Weld(std::size_t corners) : slots_(std::bit_ceil(corners / 3 + 16), -1), mask_(slots_.size() - 1) {
  positions.reserve(corners / 6);
}

Index Weld::node_at(const Vector3& position) {
  const Bits bits = bits_of(position);
  std::size_t slot = hash_of(bits) & mask_;
  for (; slots_[slot] >= 0; slot = (slot + 1) & mask_) {
    if (bits_of(positions[slots_[slot]]) == bits) return slots_[slot];
  }
  const auto node = static_cast<Index>(positions.size());
  slots_[slot] = node;
  positions.push_back(position);
  if (2 * positions.size() > slots_.size()) grow();
  return node;
}

void Weld::grow() {
  slots_.assign(2 * slots_.size(), -1);
  mask_ = slots_.size() - 1;
  for (std::size_t node = 0; node < positions.size(); ++node) {
    std::size_t slot = hash_of(bits_of(positions[node])) & mask_;
    while (slots_[slot] >= 0) slot = (slot + 1) & mask_;
    slots_[slot] = static_cast<Index>(node);
  }
}

}  // namespace vspring
