#include "shape/boundary.hpp"

#include <algorithm>
#include <utility>

#include "shape/edges.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

}  // namespace

Boundary::Boundary(const PolygonMesh& mesh, const Incidence& incidence, std::span<const std::uint8_t> inside)
    : mesh_(&mesh), incidence_(&incidence), nodes_(static_cast<std::size_t>(mesh.node_count()), 0) {
  EdgeFinder edges(mesh, incidence);
  FanWalker walker(mesh, incidence);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const bool is_inside = !inside.empty() && inside[static_cast<std::size_t>(i)] != 0;
    // Walking around the node is faster than comparing all its edges.
    if (is_inside || walker.walk(i).closed) continue;
    edges.at_node(i, [&](Index j, std::span<const EdgeUse> uses) {
      if (uses.size() == 1 && i < j) edges_.push_back({i, j, uses.front().forward});
    });
  }
  for (const Edge& edge : edges_)
    nodes_[static_cast<std::size_t>(edge.low)] = nodes_[static_cast<std::size_t>(edge.high)] = 1;
}

std::size_t Boundary::side_towards(Index from, Index to) const {
  const std::pair<Index, Index> key = std::minmax(from, to);
  const auto found = std::lower_bound(edges_.begin(), edges_.end(), key, [](const Edge& edge, const auto& wanted) {
    return std::pair(edge.low, edge.high) < wanted;
  });
  if (found == edges_.end() || found->low != key.first || found->high != key.second) return none;
  return 2 * static_cast<std::size_t>(found - edges_.begin()) + (to == key.second ? 1 : 0);
}

// Around a node every open chain of faces lies between two successive boundary edges.
void Boundary::join_chains(Index i, const Fan& fan, std::vector<std::size_t>& next) const {
  for (std::size_t begin = 0; begin < fan.links.size();) {
    std::size_t end = begin + 1;
    while (end < fan.links.size() && !fan.links[end].start()) ++end;
    if (fan.links[begin].start() && fan.links[end - 1].spoke()) {
      const std::size_t a = side_towards(static_cast<Index>(fan.links[end - 1].node()), i);
      const std::size_t b = side_towards(static_cast<Index>(fan.links[begin].node()), i);
      if (a != none && b != none) {
        next[a] = b ^ 1U;
        next[b] = a ^ 1U;
      }
    }
    begin = end;
  }
}

std::vector<std::size_t> Boundary::next_sides() const {
  std::vector<std::size_t> next(2 * edges_.size(), none);
  FanWalker walker(*mesh_, *incidence_);
  for (Index i = 0; i < mesh_->node_count(); ++i) {
    if (nodes_[static_cast<std::size_t>(i)] != 0) join_chains(i, walker.walk(i), next);
  }
  return next;
}

std::vector<std::vector<Index>> Boundary::loops() const {
  const std::vector<std::size_t> next = next_sides();
  std::vector<std::vector<Index>> all;
  std::vector<std::uint8_t> used(edges_.size(), 0);
  for (std::size_t first = 0; first < edges_.size(); ++first) {
    if (used[first] != 0) continue;
    // In the sense of the first edge's face.
    std::size_t side = 2 * first + (edges_[first].forward ? 1 : 0);
    // A chain that ends at an edge of more than two faces is entered at its beginning.
    for (std::size_t back = side ^ 1U; next[back] != none && next[back] / 2 != first; back = next[back])
      side = next[back] ^ 1U;
    std::vector<Index> loop;
    while (side != none && used[side / 2] == 0) {
      used[side / 2] = 1;
      loop.push_back(node(side ^ 1U));
      if (next[side] == none) loop.push_back(node(side));
      side = next[side];
    }
    all.push_back(std::move(loop));
  }
  return all;
}

std::vector<std::uint8_t> boundary_nodes(const PolygonMesh& mesh) {
  const Incidence incidence(mesh);
  return Boundary(mesh, incidence).nodes();
}

std::vector<std::vector<Index>> boundary_loops(const PolygonMesh& mesh) {
  const Incidence incidence(mesh);
  return Boundary(mesh, incidence).loops();
}

std::vector<Index> components(const PolygonMesh& mesh) {
  std::vector<Index> root(static_cast<std::size_t>(mesh.node_count()));
  for (std::size_t i = 0; i < root.size(); ++i) root[i] = static_cast<Index>(i);
  const auto find = [&](Index i) {
    while (root[static_cast<std::size_t>(i)] != i) {
      root[static_cast<std::size_t>(i)] = root[static_cast<std::size_t>(root[static_cast<std::size_t>(i)])];
      i = root[static_cast<std::size_t>(i)];
    }
    return i;
  };
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 1; k < face.size(); ++k) {
      const auto [low, high] = std::minmax({find(face[0]), find(face[k])});
      root[static_cast<std::size_t>(high)] = low;
    }
  }
  std::vector<Index> component(root.size());
  Index count = 0;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const Index first = find(i);
    component[static_cast<std::size_t>(i)] = first == i ? count++ : component[static_cast<std::size_t>(first)];
  }
  return component;
}

PolygonCurve boundary_curve(const PolygonMesh& mesh) {
  std::vector<PolygonCurve::Chain> chains;
  for (std::vector<Index>& loop : boundary_loops(mesh)) chains.push_back({.nodes = std::move(loop), .closed = true});
  return {mesh.positions(), std::move(chains)};
}

}  // namespace vspring
