#include "io/moved_nodes.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <array>

#include "vspring/error.hpp"

namespace vspring {
namespace {

bool same_bits(const Vector3& a, const Vector3& b) {
  using Bits = std::array<std::uint64_t, 3>;
  return Eigen::numext::bit_cast<Bits>(std::array{a.x(), a.y(), a.z()}) ==
         Eigen::numext::bit_cast<Bits>(std::array{b.x(), b.y(), b.z()});
}

}  // namespace

std::vector<std::uint8_t> moved_nodes(const std::vector<Vector3>& before, const std::vector<Vector3>& positions) {
  std::vector<std::uint8_t> moved(positions.size(), 0);
  for (std::size_t node = 0; node < positions.size(); ++node) {
    if (same_bits(before[node], positions[node])) continue;
    moved[node] = 1;
    if (!positions[node].allFinite())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("node {}: its position is not finite; only a position that was read so may be", node));
  }
  return moved;
}

}  // namespace vspring
