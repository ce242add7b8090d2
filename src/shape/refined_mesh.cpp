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
  // Numbered as in mean_of.
  std::vector<double> all(values.begin(), values.end());
  for (Index node = kept_node_count(); node < mesh.node_count(); ++node) {
    for (std::size_t c = 0; c < width; ++c)
      all.push_back(mean(node, [&](Index other) { return all[width * static_cast<std::size_t>(other) + c]; }));
  }
  if (removed.empty()) return all;
  std::vector<double> result;
  result.reserve(width * static_cast<std::size_t>(mesh.node_count()));
  for (const Index number : numbers_in_means()) {
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(width * static_cast<std::size_t>(number));
    result.insert(result.end(), first, first + static_cast<std::ptrdiff_t>(width));
  }
  return result;
}

std::vector<Index> RefinedMesh::numbers_in_means() const {
  std::vector<Index> numbers;
  numbers.reserve(mesh.positions().size());
  auto next = removed.begin();
  for (Index number = 0; number < input_node_count() + new_node_count(); ++number) {
    if (next != removed.end() && *next == number)
      ++next;
    else
      numbers.push_back(number);
  }
  return numbers;
}

MeshEdges RefinedMesh::parts_of(const MeshEdges& edges) const {
  std::map<std::pair<Index, Index>, Index> middles;
  for (Index node = kept_node_count(); node < mesh.node_count(); ++node) {
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
