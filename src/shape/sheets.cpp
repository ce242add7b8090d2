#include "shape/sheets.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "shape/edges.hpp"
#include "shape/incidence.hpp"

namespace vspring {

namespace {

class LineFinder {
 public:
  explicit LineFinder(const PolygonMesh& mesh) {
    const Incidence incidence(mesh);
    EdgeFinder edges(mesh, incidence);
    for (Index node = 0; node < mesh.node_count(); ++node) {
      edges.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
        if (uses.size() == 3) left_[node].push_back(neighbour);
      });
    }
    for (const auto& [node, neighbours] : left_) {
      if (neighbours.size() != 2) ends_.push_back(node);
    }
  }

  std::vector<PolygonCurve::Chain> find() {
    std::vector<PolygonCurve::Chain> chains;
    for (const Index end : ends_) {
      while (!left_[end].empty()) chains.push_back({.nodes = walk(end), .closed = false});
    }
    for (auto& [node, neighbours] : left_) {
      if (neighbours.empty()) continue;
      std::vector<Index> loop = walk(node);
      loop.pop_back();
      chains.push_back({.nodes = std::move(loop), .closed = true});
    }
    return chains;
  }

 private:
  [[nodiscard]] bool is_end(Index node) const { return std::binary_search(ends_.begin(), ends_.end(), node); }

  /// Walks along edges not passed yet, to the next end or back to its start.
  std::vector<Index> walk(Index from) {
    std::vector<Index> nodes = {from};
    do {
      const Index here = nodes.back();
      const Index next = left_[here].back();
      left_[here].pop_back();
      std::erase(left_[next], here);
      nodes.push_back(next);
    } while (nodes.back() != from && !is_end(nodes.back()));
    return nodes;
  }

  std::map<Index, std::vector<Index>> left_;  ///< per node on a line, its neighbours along edges not passed yet
  std::vector<Index> ends_;
};

}  // namespace

PolygonCurve junction_lines(const PolygonMesh& mesh) { return {mesh.positions(), LineFinder(mesh).find()}; }

MeshOfSheets into_sheets(const PolygonMesh& mesh, std::span<const Index> nodes,
                         std::span<const std::pair<Index, Index>> sharp) {
  const Incidence incidence(mesh);
  EdgeFinder edges(mesh, incidence);
  std::vector<Index> corners = mesh.corners();
  std::vector<Vector3> positions = mesh.positions();
  std::vector<Index> origin;
  for (const Index node : nodes) {
    const auto around = incidence.corners(node);
    const auto place_of = [&](Index face) {
      const auto found = std::lower_bound(around.begin(), around.end(), face,
                                          [](const Corner& corner, Index f) { return corner.face < f; });
      return static_cast<std::size_t>(found - around.begin());
    };
    const bool is_twice_in_one = std::adjacent_find(around.begin(), around.end(), [](const Corner& a, const Corner& b) {
                                   return a.face == b.face;
                                 }) != around.end();
    if (around.empty() || is_twice_in_one) continue;
    DisjointSets sheets(around.size());
    edges.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      const std::pair<Index, Index> edge = std::minmax(node, neighbour);
      if (uses.size() == 2 && !std::binary_search(sharp.begin(), sharp.end(), edge))
        (void)sheets.join(place_of(uses[0].face), place_of(uses[1].face));
    });
    std::vector<Index> node_of(around.size(), -1);
    node_of[sheets.find(0)] = node;
    for (std::size_t k = 0; k < around.size(); ++k) {
      Index& own = node_of[sheets.find(k)];
      if (own < 0) {
        own = static_cast<Index>(positions.size());
        positions.push_back(mesh.position(node));
        origin.push_back(node);
      }
      const Index corner = mesh.face_begin(around[k].face) + around[k].place;
      corners[static_cast<std::size_t>(corner)] = own;
    }
  }
  return {PolygonMesh(std::move(positions), mesh.face_begin(), std::move(corners)), std::move(origin)};
}

}  // namespace vspring
