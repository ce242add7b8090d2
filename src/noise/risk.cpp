#include "noise/risk.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

/// One step of averaging.
void step(const ScanMesh& mesh, std::size_t width, const std::vector<double>& now, std::vector<double>& next,
          ThreadTeam& team) {
  parallel_ranges(team, mesh.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto neighbours = mesh.moving_neighbours.of(i);
      const double* own = now.data() + i * width;
      double* result = next.data() + i * width;
      if (neighbours.empty()) {
        std::copy_n(own, width, result);
        continue;
      }
      std::fill_n(result, width, 0.0);
      for (const std::uint32_t j : neighbours) {
        const double* other = now.data() + j * width;
        for (std::size_t k = 0; k < width; ++k) result[k] += other[k];
      }
      const double share = 0.5 / static_cast<double>(neighbours.size());
      for (std::size_t k = 0; k < width; ++k) result[k] = 0.5 * own[k] + share * result[k];
    }
  });
}

}  // namespace

Risks risks_of(const ScanMesh& mesh, const std::vector<const Places*>& shapes, const Places& noisy,
               const std::vector<Vector3>& normals, const std::vector<double>& followed, double deviation,
               ThreadTeam& team) {
  Risks risks{.shapes = shapes.size(), .values = std::vector<double>(mesh.moving * shapes.size()), .means = {}};
  parallel_ranges(team, mesh.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (std::size_t k = 0; k < shapes.size(); ++k) {
        const double distance = ((*shapes[k])[i] - noisy[i]).dot(normals[i]);
        const std::size_t place = i * shapes.size() + k;
        risks.values[place] = distance * distance + 2 * deviation * deviation * followed[place];
      }
    }
  });
  risks.means.assign(shapes.size(), 0);
  for (std::size_t place = 0; place < risks.values.size(); ++place) {
    end_if_cancelled_at(place);
    risks.means[place % shapes.size()] += risks.values[place] / static_cast<double>(mesh.moving);
  }
  return risks;
}

std::vector<Places> choose(const ScanMesh& mesh, const std::vector<const Places*>& shapes, Risks risks,
                           std::span<const Choice> choices, double deviation, ThreadTeam& team) {
  const std::size_t width = risks.shapes;
  std::vector<double> next(risks.values.size());
  std::vector<Places> results;
  int steps = 0;
  for (const Choice& choice : choices) {
    for (; steps < choice.steps; ++steps) {
      step(mesh, width, risks.values, next, team);
      risks.values.swap(next);
    }
    Places& result = results.emplace_back(*shapes.front());
    const double scale = choice.weight / (deviation * deviation);
    parallel_ranges(team, mesh.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      std::vector<double> risk(width);
      for (std::size_t i = begin; i < end; ++i) {
        for (std::size_t k = 0; k < width; ++k)
          risk[k] = (1 - choice.whole) * risks.values[i * width + k] + choice.whole * risks.means[k];
        const double least = *std::min_element(risk.begin(), risk.end());
        Vector3 sum = Vector3::Zero();
        double weights = 0;
        for (std::size_t k = 0; k < width; ++k) {
          const double weight = std::exp(scale * (least - risk[k]));
          sum += weight * (*shapes[k])[i];
          weights += weight;
        }
        result[i] = sum / weights;
      }
    });
  }
  return results;
}

}  // namespace vspring
