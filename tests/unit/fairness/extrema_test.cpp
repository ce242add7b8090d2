#include "fairness/extrema.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "base/random.hpp"
#include "vspring/generate.hpp"

namespace vspring::extrema_test {
namespace {

struct Field {
  std::vector<double> values;
  std::vector<std::uint8_t> used;
  std::vector<std::uint8_t> inside;
};

/// From every node as much as can be seen of it: the highest place that a way to a higher node must go down to, by
/// looking at all nodes above a level again and again.
Index by_flooding(const NodeGraph& graph, const Field& field, double threshold) {
  const auto at = [](Index node) { return static_cast<std::size_t>(node); };
  const auto higher = [&](Index a, Index b) {
    return field.values[at(a)] != field.values[at(b)] ? field.values[at(a)] > field.values[at(b)] : a < b;
  };
  Index count = 0;
  for (Index summit = 0; summit < graph.size(); ++summit) {
    if (field.inside[at(summit)] == 0) continue;
    std::vector<std::uint8_t> flooded(field.values.size(), 0);
    std::vector<Index> rim = {summit};
    flooded[at(summit)] = 1;
    double low = field.values[at(summit)];
    for (bool is_overtopped = false; !rim.empty() && !is_overtopped;) {
      const auto highest = std::min_element(rim.begin(), rim.end(), higher);
      const Index node = *highest;
      rim.erase(highest);
      is_overtopped = higher(node, summit);
      if (is_overtopped) break;
      low = std::min(low, field.values[at(node)]);
      graph.for_each_neighbour(node, [&](Index j) {
        if (field.used[at(j)] == 0 || flooded[at(j)] != 0) return;
        flooded[at(j)] = 1;
        rim.push_back(j);
      });
    }
    if (field.values[at(summit)] - low > threshold) ++count;
  }
  return count;
}

TEST(Maxima, AreThoseThatFloodingFinds) {
  for (const generate::Faces faces : {generate::Faces::triangles, generate::Faces::mixed}) {
    const PolygonMesh mesh = generate::plane({.columns = 14, .rows = 11, .faces = faces}, 1, 1);
    const Incidence incidence(mesh);
    const NodeGraph graph(mesh, incidence);
    Random random(11);
    for (int round = 0; round < 20; ++round) {
      Field field;
      for (Index i = 0; i < mesh.node_count(); ++i) {
        // Whole numbers in every other round: many nodes are as high as their neighbours.
        const double value = random.uniform(0, 9);
        field.values.push_back(round % 2 == 0 ? value : std::floor(value));
        field.used.push_back(random.uniform(0, 1) < 0.9 ? 1 : 0);
        field.inside.push_back(field.used.back() != 0 && random.uniform(0, 1) < 0.8 ? 1 : 0);
      }
      for (const double threshold : {0.5, 2.0, 4.0}) {
        EXPECT_EQ(count_maxima(graph, field.values, field.used, field.inside, threshold),
                  by_flooding(graph, field, threshold));
      }
    }
  }
}

}  // namespace
}  // namespace vspring::extrema_test
