#include "shape/junctions.hpp"

#include <algorithm>
#include <cstddef>
#include <map>
#include <span>
#include <utility>
#include <vector>

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

}  // namespace vspring
