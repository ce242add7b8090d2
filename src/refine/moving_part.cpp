#include "refine/moving_part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "base/median.hpp"
#include "shape/boundary.hpp"
#include "shape/edges.hpp"
#include "shape/incidence.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

// Of the length of an edge, how far off a support a held end of it counts as on it.
constexpr double on_support = 1e-6;

bool has_repeated_node(std::span<const Index> face) {
  for (std::size_t k = 1; k < face.size(); ++k) {
    if (std::find(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(k), face[k]) !=
        face.begin() + static_cast<std::ptrdiff_t>(k))
      return true;
  }
  return false;
}

void require_finite_nodes(const PolygonMesh& mesh, Index face) {
  for (const Index node : mesh.face(face)) {
    if (!mesh.position(node).allFinite())
      throw Error(ErrorCode::unusable_shape,
                  fmt::format("face {}: its node {} has a coordinate that is not finite; correct it, or hold all "
                              "nodes of the face",
                              face, node));
  }
}

}  // namespace

std::vector<std::uint8_t> moving_faces(const PolygonMesh& mesh, const Constraints& constraints) {
  const std::vector<std::uint8_t> on_boundary = boundary_nodes(mesh);
  const Incidence incidence(mesh);
  EdgeFinder finder(mesh, incidence);
  std::vector<Index> due;
  std::vector<std::uint8_t> in_part(static_cast<std::size_t>(mesh.face_count()), 0);
  const auto take = [&](Index f) {
    if (in_part[static_cast<std::size_t>(f)] != 0) return;
    in_part[static_cast<std::size_t>(f)] = 1;
    due.push_back(f);
  };
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (face.size() >= 3 && !has_repeated_node(face) &&
        std::any_of(face.begin(), face.end(), [&](Index i) { return !constraints.position_fixed(i); }))
      take(f);
  }
  while (!due.empty()) {
    const Index f = due.back();
    due.pop_back();
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index next = face[(k + 1) % face.size()];
      if (on_boundary[static_cast<std::size_t>(face[k])] == 0 || on_boundary[static_cast<std::size_t>(next)] == 0)
        continue;
      finder.at_node(face[k], [&](Index neighbour, std::span<const EdgeUse> uses) {
        if (neighbour != next) return;
        for (const EdgeUse& use : uses) {
          const auto other = mesh.face(use.face);
          if (!has_repeated_node(other) && std::all_of(other.begin(), other.end(), [&](Index i) {
                return on_boundary[static_cast<std::size_t>(i)] != 0;
              }))
            take(use.face);
        }
      });
    }
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (in_part[static_cast<std::size_t>(f)] != 0) require_finite_nodes(mesh, f);
  }
  return in_part;
}

std::vector<std::pair<Index, Index>> edges_kept(const PolygonMesh& mesh, std::span<const std::uint8_t> in_part) {
  std::vector<std::uint8_t> is_of_part(mesh.positions().size(), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (in_part[static_cast<std::size_t>(f)] == 0) continue;
    for (const Index node : mesh.face(f)) is_of_part[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<std::pair<Index, Index>> kept;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (in_part[static_cast<std::size_t>(f)] != 0) continue;
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
      if (is_of_part[static_cast<std::size_t>(low)] != 0 && is_of_part[static_cast<std::size_t>(high)] != 0)
        kept.emplace_back(low, high);
    }
  }
  std::sort(kept.begin(), kept.end());
  return kept;
}

void hold_between(Constraints& constraints, Index node, Index a, Index b, double length) {
  if (constraints.position_fixed(a) && constraints.position_fixed(b))
    constraints.fix_position(node, constraints.position(a) / 2 + constraints.position(b) / 2);
  const auto stays_on = [&](const Support& support, Index other) {
    if (constraints.support(other) != nullptr) return *constraints.support(other) == support;
    if (!constraints.position_fixed(other)) return false;
    const Vector3& place = constraints.position(other);
    const double off = (support.nearest(place).value_or(place) - place).norm();
    return off <= on_support * length;
  };
  for (const auto& [one, other] : {std::pair(a, b), std::pair(b, a)}) {
    const Support* const support = constraints.support(one);
    if (support == nullptr || !stays_on(*support, other)) continue;
    constraints.hold_as(node, constraints, one);
    break;
  }
  if (!constraints.normal_fixed(a) || !constraints.normal_fixed(b)) return;
  // Either sense of a given normal will do.
  const Vector3& one = constraints.normal(a);
  const Vector3& other = constraints.normal(b);
  constraints.fix_normal(node, one.dot(other) < 0 ? Vector3(one - other) : Vector3(one + other));
}

double boundary_reach_of(const PolygonMesh& mesh) {
  std::vector<double> lengths;
  for (const std::vector<Index>& loop : boundary_loops(mesh)) {
    for (std::size_t k = 0; k < loop.size(); ++k) {
      const double length = (mesh.position(loop[(k + 1) % loop.size()]) - mesh.position(loop[k])).norm();
      if (std::isfinite(length)) lengths.push_back(length);
    }
  }
  return lengths.empty() ? 0 : boundary_reach_in_edges * median(lengths);
}

}  // namespace vspring
