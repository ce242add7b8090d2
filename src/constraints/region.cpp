#include "vspring/region.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cstdint>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "base/message_text.hpp"
#include "vspring/constraints.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

std::vector<Index> boundary_list(const PolygonMesh& mesh) {
  const auto boundary = boundary_nodes(mesh);
  std::vector<Index> nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0) nodes.push_back(i);
  }
  return nodes;
}

/// Gives nodes the estimated normals; those without a usable face keep theirs free.
void fix_estimated(Constraints& constraints, const PolygonMesh& mesh, const std::vector<Index>& nodes,
                   std::span<const std::uint8_t> usable_face) {
  const auto normals = estimate_normals(mesh, nodes, usable_face);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!normals[k].isZero(0)) constraints.fix_normal(nodes[k], normals[k]);
  }
}

/// How messages about a region begin.
std::string called(const Region& region) {
  return region.name.empty() ? "region" : fmt::format("region \"{}\"", in_one_line(region.name));
}

std::vector<Index> nodes_within(const std::vector<Vector3>& positions, const auto& inside) {
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (inside(positions[i])) nodes.push_back(static_cast<Index>(i));
  }
  return nodes;
}

std::vector<Index> nodes_of_group(const Region& region, const std::string& name, const Groups& groups) {
  const auto group = groups.find(name);
  if (group != groups.end()) return group->second;
  std::string known;
  for (const auto& [other, members] : groups) known += (known.empty() ? "" : ", ") + other;
  throw Error(ErrorCode::unusable_constraint,
              fmt::format("{}: the shape has no such group; {}", called(region),
                          known.empty() ? "it has none at all" : "it has " + in_one_line(known, 1000)));
}

/// The named nodes, ascending and once each.
std::vector<Index> nodes_of_list(const Region& region, std::vector<Index> nodes, std::size_t node_count) {
  for (const Index node : nodes) {
    if (node < 0 || static_cast<std::size_t>(node) >= node_count)
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("{}: {} is not a node; nodes go from 0 to {}",
                              region.name.empty() ? "region" : in_one_line(region.name, 4096), node,
                              static_cast<std::int64_t>(node_count) - 1));
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// The nodes of each kind of region.
struct RegionSelector {
  const std::vector<Vector3>& positions;
  const Region& region;
  const Groups& groups;

  std::vector<Index> operator()(const SphereRegion& sphere) const {
    return nodes_within(positions, [&](const Vector3& p) { return (p - sphere.centre).norm() <= sphere.radius; });
  }
  std::vector<Index> operator()(const BoxRegion& corners) const {
    const Eigen::AlignedBox<double, 3> box(corners.from.cwiseMin(corners.to), corners.from.cwiseMax(corners.to));
    return nodes_within(positions, [&](const Vector3& p) { return box.contains(p); });
  }
  std::vector<Index> operator()(const GroupRegion& named) const { return nodes_of_group(region, named.group, groups); }
  std::vector<Index> operator()(const NodeRegion& list) const {
    return nodes_of_list(region, list.nodes, positions.size());
  }
};

}  // namespace

void fix_boundary_normals(Constraints& constraints, const PolygonMesh& mesh) {
  fix_estimated(constraints, mesh, boundary_list(mesh), {});
}

void restrict_to_region(Constraints& constraints, const PolygonMesh& mesh, std::span<const Index> region) {
  Constraints restricted = constraints;
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Index i : region) {
    (void)restricted.position_fixed(i);  // throws for a node out of range
    inside[static_cast<std::size_t>(i)] = 1;
  }
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (inside[static_cast<std::size_t>(i)] == 0 && !restricted.position_fixed(i))
      restricted.fix_position(i, mesh.position(i));
  }
  std::vector<std::uint8_t> outer_face(static_cast<std::size_t>(mesh.face_count()), 1);
  std::vector<std::uint8_t> rim(static_cast<std::size_t>(mesh.node_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto moves = [&](Index i) { return !restricted.position_fixed(i); };
    if (std::none_of(face.begin(), face.end(), moves)) continue;
    outer_face[static_cast<std::size_t>(f)] = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      if (moves(a) && !moves(b)) rim[static_cast<std::size_t>(b)] = 1;
      if (moves(b) && !moves(a)) rim[static_cast<std::size_t>(a)] = 1;
    }
  }
  // With faces all around, the moving faces give a better normal than an estimate from one side.
  const std::vector<std::uint8_t> boundary = boundary_nodes(mesh);
  std::vector<Index> rim_nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (rim[node] != 0 && boundary[node] != 0 && !restricted.normal_fixed(i)) rim_nodes.push_back(i);
  }
  fix_estimated(restricted, mesh, rim_nodes, outer_face);
  constraints = std::move(restricted);
}

std::vector<Index> select_region(const std::vector<Vector3>& positions, const Region& region, const Groups& groups) {
  std::vector<Index> nodes = std::visit(RegionSelector{positions, region, groups}, region.extent);
  if (nodes.empty()) throw Error(ErrorCode::unusable_constraint, fmt::format("{}: no node lies in it", called(region)));
  return nodes;
}

}  // namespace vspring
