#include "vspring/constraints.hpp"

#include <fmt/format.h>

#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

Constraints::Constraints(Index node_count)
    : flags_(static_cast<std::size_t>(node_count), 0),
      positions_(static_cast<std::size_t>(node_count), Vector3::Zero()),
      normals_(static_cast<std::size_t>(node_count), Vector3::Zero()) {}

std::size_t Constraints::at(Index node) const {
  if (node < 0 || node >= node_count())
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("node {} does not exist; nodes go from 0 to {}", node, node_count() - 1));
  return static_cast<std::size_t>(node);
}

void Constraints::fix_position(Index node, const Vector3& position) {
  const std::size_t i = at(node);
  positions_[i] = position;
  flags_[i] |= position_flag;
}

void Constraints::free_position(Index node) { flags_[at(node)] &= static_cast<std::uint8_t>(~position_flag); }

void Constraints::fix_normal(Index node, const Vector3& normal) {
  const std::size_t i = at(node);
  // Scaled first, so that lengths whose squares overflow or vanish are no special case.
  const double greatest = normal.cwiseAbs().maxCoeff();
  if (!normal.allFinite() || !(greatest > 0))
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("node {}: the normal ({}, {}, {}) has no direction; give one of any length but zero", node,
                            normal.x(), normal.y(), normal.z()));
  normals_[i] = (normal / greatest).normalized();
  flags_[i] |= normal_flag;
}

void Constraints::free_normal(Index node) { flags_[at(node)] &= static_cast<std::uint8_t>(~normal_flag); }

void fix_boundary_positions(Constraints& constraints, const PolygonMesh& mesh) {
  const auto boundary = boundary_nodes(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0) constraints.fix_position(i, mesh.position(i));
  }
}

}  // namespace vspring
