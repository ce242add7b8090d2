#include "vspring/refined_mesh.hpp"

#include <fmt/format.h>

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

}  // namespace vspring
