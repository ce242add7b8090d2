#include "vspring/noise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/threads.hpp"
#include "noise/noisy_places.hpp"
#include "noise/two_rings.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"
#include "shape/turned_faces.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// In standard deviations of the noise: at narrower places the direction of noise cannot be told.
constexpr double least_extent = 2;
// Steps to the neighbours' mean before slopes are measured, and the least cosine of a slope.
constexpr int steps_of_slopes = 5;
constexpr double least_cosine = 0.3;
constexpr std::size_t places_per_task = 256;
constexpr double three_deviations = 0.0027;
// The square of an interval over the variance of a uniform distribution on it.
constexpr double deviations_of_step = 12;
// Fewer nodes show bends as much as noise.
constexpr Index fewest_nodes = 30;
// More than any number of nodes leads to.
constexpr double most_deviations = 10;

/// Unit normals of nodes after steps to the mean of neighbours have removed noise.
std::vector<Vector3> smooth_normals(const PolygonMesh& mesh, const NodeGraph& graph, ThreadTeam& team) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<Vector3> now = mesh.positions();
  std::vector<Vector3> next = now;
  for (int step = 0; step < steps_of_slopes; ++step) {
    parallel_ranges(team, nodes, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Vector3 sum = now[i];
        double count = 1;
        graph.for_each_neighbour(static_cast<Index>(i), [&](Index j) {
          sum += now[static_cast<std::size_t>(j)];
          ++count;
        });
        next[i] = sum / count;
      }
    });
    now.swap(next);
  }
  std::vector<Vector3> normals(nodes, Vector3::Zero());
  const std::vector<std::uint8_t> turned = turned_faces(mesh);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    const Vector3 area = (turned[static_cast<std::size_t>(f)] != 0 ? -1 : 1) * twice_vector_area(face, now);
    for (const Index node : face) normals[static_cast<std::size_t>(node)] += area;
  }
  for (Vector3& normal : normals) normal.stableNormalize();
  return normals;
}

/// Heights above a slope also contain the noise along it: the factor relative to noise across the surface.
double greater_by_slopes(std::span<const Index> nodes, const std::vector<Vector3>& normals) {
  Vector3 axis = Vector3::Zero();
  for (const Index j : nodes) axis += normals[static_cast<std::size_t>(j)];
  axis.stableNormalize();
  double squares = 0;
  for (const Index j : nodes) {
    const double cosine = std::max(least_cosine, std::abs(axis.dot(normals[static_cast<std::size_t>(j)])));
    squares += 1 / (cosine * cosine);
  }
  return std::sqrt(squares / static_cast<double>(nodes.size()));
}

std::vector<double> edges_of(const PolygonMesh& mesh, const NodeGraph& graph) {
  std::vector<double> edges;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    end_if_cancelled_at(static_cast<std::size_t>(i));
    graph.for_each_neighbour(i, [&](Index j) {
      if (j > i) edges.push_back((mesh.position(j) - mesh.position(i)).norm());
    });
  }
  return edges;
}

/// Nodes are uniformly distributed within half a voxel.
NoiseEstimate noise_of_steps(const Vector3& voxel, std::vector<double> edges, Index nodes) {
  NoiseEstimate result;
  result.voxel = voxel;
  result.nodes = nodes;
  result.deviation = voxel.norm() / std::sqrt(3 * deviations_of_step);
  result.edges = result.deviation / value_at_share(edges, 0.5);
  return result;
}

}  // namespace

NoiseEstimate estimate_noise(const PolygonMesh& mesh, const Context& context) {
  const Incidence incidence(mesh);
  const NodeGraph graph(mesh, incidence);
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  if (const auto voxel = voxel_size(mesh)) return noise_of_steps(*voxel, edges_of(mesh, graph), mesh.node_count());
  std::vector<NoisyPlace> found(nodes);
  ThreadTeam team(context.thread_count());
  const std::vector<Vector3> normals = smooth_normals(mesh, graph, team);
  parallel_ranges(team, nodes, places_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> around;
    std::vector<Vector3> places;
    for (std::size_t i = begin; i < end; ++i) {
      two_rings(graph, incidence, static_cast<Index>(i), around);
      places.clear();
      for (const Index j : around) places.push_back(mesh.position(j));
      const auto heights = heights_of(places, {.axes = 2, .degree = 2, .directions = 1});
      if (!heights) continue;
      found[i] = {heights->deviation / greater_by_slopes(around, normals), heights->freedom, heights->extents[1]};
    }
  });
  NoiseEstimate noise = noise_of_places(std::move(found), edges_of(mesh, graph), least_extent);
  forget_rounding(noise, mesh.positions());
  return noise;
}

NoiseEstimate estimate_noise(const PolygonMesh& mesh, std::span<const Index> region, const Context& context) {
  std::vector<Index> new_number(static_cast<std::size_t>(mesh.node_count()), -1);
  std::vector<Vector3> positions;
  for (const Index node : region) {
    if (node < 0 || node >= mesh.node_count())
      throw Error(ErrorCode::invalid_argument, "region: no node " + std::to_string(node));
    Index& number = new_number[static_cast<std::size_t>(node)];
    if (number >= 0) continue;
    number = static_cast<Index>(positions.size());
    positions.push_back(mesh.position(node));
  }
  std::vector<Index> offsets = {0};
  std::vector<Index> corners;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::any_of(face.begin(), face.end(),
                    [&](Index node) { return new_number[static_cast<std::size_t>(node)] < 0; }))
      continue;
    for (const Index node : face) corners.push_back(new_number[static_cast<std::size_t>(node)]);
    offsets.push_back(static_cast<Index>(corners.size()));
  }
  const NoiseEstimate estimate =
      estimate_noise(PolygonMesh(std::move(positions), std::move(offsets), std::move(corners)), context);
  return estimate.nodes >= fewest_nodes ? estimate : estimate_noise(mesh, context);
}

double greatest_of_noise(const NoiseEstimate& noise) {
  const double beyond = std::min(three_deviations, std::log(2) / std::max(1.0, static_cast<double>(noise.nodes)));
  const double deviation = noise.coordinates_differ
                               ? *std::max_element(noise.by_coordinate.begin(), noise.by_coordinate.end())
                               : noise.deviation;
  if (noise.directions == 2) return std::sqrt(-2 * std::log(beyond)) * deviation;
  double low = 0;
  double high = most_deviations;
  while (high - low > 1e-9) {
    const double between = (low + high) / 2;
    (std::erfc(between / std::sqrt(2)) > beyond ? low : high) = between;
  }
  return high * deviation;
}

}  // namespace vspring
