#include "vspring/refined_mesh.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <utility>

#include "vspring/error.hpp"

namespace vspring {

std::vector<double> RefinedMesh::at_nodes(std::span<const double> values) const {
  const auto nodes = static_cast<std::size_t>(input_node_count());
  if (nodes == 0 ? !values.empty() : values.size() % nodes != 0)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} values given for the {} nodes before refinement", values.size(), nodes));
  const std::size_t width = nodes == 0 ? 0 : values.size() / nodes;
  std::vector<double> result(values.begin(), values.end());
  result.resize(width * static_cast<std::size_t>(mesh.node_count()), 0);
  for (Index node = input_node_count(); node < mesh.node_count(); ++node) {
    const auto of = means(node);
    for (std::size_t c = 0; c < width; ++c) {
      double sum = 0;
      for (const Index other : of) sum += result[width * static_cast<std::size_t>(other) + c];
      result[width * static_cast<std::size_t>(node) + c] = sum / static_cast<double>(of.size());
    }
  }
  return result;
}

MeshEdges RefinedMesh::parts_of(const MeshEdges& edges) const {
  std::map<std::pair<Index, Index>, Index> middles;
  for (Index node = input_node_count(); node < mesh.node_count(); ++node) {
    if (const auto of = means(node); of.size() == 2) middles.emplace(std::minmax(of[0], of[1]), node);
  }
  MeshEdges parts;
  // Those that are still to be looked at, the next one last.
  MeshEdges left(edges.rbegin(), edges.rend());
  while (!left.empty()) {
    const auto [a, b] = left.back();
    left.pop_back();
    if (const Index worst = std::min(a, b) < 0 ? std::min(a, b) : std::max(a, b);
        worst < 0 || worst >= mesh.node_count())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("edge from node {} to node {}: there is no node {}", a, b, worst));
    const auto middle = middles.find(std::minmax(a, b));
    if (middle == middles.end()) {
      parts.emplace_back(a, b);
    } else {
      left.emplace_back(middle->second, b);
      left.emplace_back(a, middle->second);
    }
  }
  return parts;
}

}  // namespace vspring
