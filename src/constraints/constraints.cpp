#include "vspring/constraints.hpp"

#include <fmt/format.h>

#include <utility>

#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

Vector3 unit(Index node, const Vector3& vector, const char* what) {
  // Scaled first, as squares of lengths may overflow or vanish.
  const double greatest = vector.cwiseAbs().maxCoeff();
  if (!vector.allFinite() || !(greatest > 0))
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("node {}: the {} ({}, {}, {}) has no direction; give one of any length but zero", node,
                            what, vector.x(), vector.y(), vector.z()));
  return (vector / greatest).normalized();
}

}  // namespace

Constraints::Constraints(Index node_count) : flags_(static_cast<std::size_t>(node_count), 0) {}

void Constraints::add_nodes(Index count) { flags_.resize(flags_.size() + static_cast<std::size_t>(count), 0); }

const Vector3& Constraints::Vectors::of(std::size_t node) const {
  static const Vector3 none = Vector3::Zero();
  return node < place_.size() ? values_[place_[node]] : none;
}

void Constraints::Vectors::set(std::size_t node, std::size_t node_count, const Vector3& value) {
  if (values_.empty()) values_.emplace_back(Vector3::Zero());
  place_.resize(node_count, 0);
  if (place_[node] != 0) {
    values_[place_[node]] = value;
    return;
  }
  place_[node] = static_cast<std::uint32_t>(values_.size());
  // `value` may be a reference into values_.
  values_.push_back(value);
}

void Constraints::refuse(Index node) const {
  throw Error(ErrorCode::unusable_constraint,
              fmt::format("node {} does not exist; nodes go from 0 to {}", node, node_count() - 1));
}

void Constraints::fix_position(Index node, const Vector3& position) {
  const std::size_t i = at(node);
  stop_sliding(node);
  positions_.set(i, flags_.size(), position);
  flags_[i] |= position_flag;
}

void Constraints::free_position(Index node) {
  flags_[at(node)] &= static_cast<std::uint8_t>(~position_flag);
  stop_sliding(node);
}

void Constraints::slide_on(std::span<const Index> nodes, const Support& support) {
  for (const Index node : nodes) (void)at(node);
  const auto shared = std::make_shared<const Support>(support);
  for (const Index node : nodes) slide_on(node, shared);
}

void Constraints::slide_on(Index node, std::shared_ptr<const Support> support) {
  free_position(node);
  supports_.resize(flags_.size());
  supports_[at(node)] = std::move(support);
  ++sliding_count_;
}

void Constraints::stop_sliding(Index node) {
  if (support(node) == nullptr) return;
  supports_[at(node)].reset();
  --sliding_count_;
}

void Constraints::fix_normal(Index node, const Vector3& normal) {
  const std::size_t i = at(node);
  normals_.set(i, flags_.size(), unit(node, normal, "normal"));
  flags_[i] |= normal_flag;
}

void Constraints::free_normal(Index node) { flags_[at(node)] &= static_cast<std::uint8_t>(~normal_flag); }

void Constraints::fix_tangent(Index node, const Vector3& tangent) {
  const std::size_t i = at(node);
  tangents_.set(i, flags_.size(), unit(node, tangent, "tangent"));
  free_corner(node);
  flags_[i] |= tangent_flag;
}

void Constraints::free_tangent(Index node) {
  flags_[at(node)] &= static_cast<std::uint8_t>(~tangent_flag);
  for (const NodeSide side : node_sides) free_tangent(node, side);
}

void Constraints::make_corner(Index node) {
  if (corner(node)) return;
  free_tangent(node);
  flags_[at(node)] |= corner_flag;
  ++corner_count_;
}

void Constraints::free_corner(Index node) {
  if (!corner(node)) return;
  free_tangent(node);
  flags_[at(node)] &= static_cast<std::uint8_t>(~corner_flag);
  --corner_count_;
}

void Constraints::fix_tangent(Index node, const Vector3& tangent, NodeSide side) {
  const std::size_t i = at(node);
  const Vector3 given = unit(node, tangent, side == NodeSide::before ? "tangent in" : "tangent out");
  make_corner(node);
  (side == NodeSide::before ? tangents_ : tangents_after_).set(i, flags_.size(), given);
  flags_[i] |= flag_of(side);
}

void Constraints::hold_as(Index node, const Constraints& other, Index of) {
  const auto slides_with = other.support(of) != nullptr ? other.supports_[other.at(of)] : nullptr;
  free_position(node);
  free_normal(node);
  free_corner(node);
  free_tangent(node);
  if (slides_with) slide_on(node, slides_with);
  if (other.position_fixed(of)) fix_position(node, other.position(of));
  if (other.normal_fixed(of)) fix_normal(node, other.normal(of));
  if (other.tangent_fixed(of)) fix_tangent(node, other.tangent(of));
  if (!other.corner(of)) return;
  make_corner(node);
  for (const NodeSide side : node_sides) {
    if (other.tangent_fixed(of, side)) fix_tangent(node, other.tangent(of, side), side);
  }
}

namespace {

template <typename Shape>
void fix_boundary_of(Constraints& constraints, const Shape& shape) {
  const auto boundary = boundary_nodes(shape);
  for (Index i = 0; i < shape.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0) constraints.fix_position(i, shape.position(i));
  }
}

}  // namespace

void fix_boundary_positions(Constraints& constraints, const PolygonMesh& mesh) { fix_boundary_of(constraints, mesh); }

void fix_boundary_positions(Constraints& constraints, const PolygonCurve& curve) {
  fix_boundary_of(constraints, curve);
}

}  // namespace vspring
