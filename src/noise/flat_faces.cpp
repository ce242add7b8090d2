#include "noise/flat_faces.hpp"

#include <cmath>
#include <cstdint>
#include <utility>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// Distance between unit normals.
constexpr double alike = 0.3;
// In edge lengths.
constexpr double near = 1.5;
constexpr int steps_of_nodes = 10;

std::vector<Vector3> centres_of(const ScanMesh& mesh, const std::vector<Vector3>& places, ThreadTeam& team) {
  std::vector<Vector3> centres(mesh.faces.size(), Vector3::Zero());
  parallel_ranges(team, centres.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const auto face = mesh.faces.of(f);
      for (const std::uint32_t i : face) centres[f] += places[i];
      centres[f] /= static_cast<double>(face.size());
    }
  });
  return centres;
}

/// The weights of the neighbours of each face, as in ScanMesh::around, without the factor of normals.
std::vector<double> weights_of(const ScanMesh& mesh, const std::vector<Vector3>& places,
                               const std::vector<Vector3>& areas, ThreadTeam& team) {
  const std::vector<Vector3> centres = centres_of(mesh, places, team);
  std::vector<double> squares(mesh.faces.size(), 0);
  for (std::size_t f = 0; f < squares.size(); ++f) {
    end_if_cancelled_at(f);
    const auto face = mesh.faces.of(f);
    for (std::size_t k = 0; k < face.size(); ++k)
      squares[f] += (places[face[(k + 1) % face.size()]] - places[face[k]]).squaredNorm();
    squares[f] /= static_cast<double>(face.size());
  }
  std::vector<double> weights(mesh.around.items.size());
  parallel_ranges(team, squares.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      for (std::size_t k = mesh.around.begin[f]; k < mesh.around.begin[f + 1]; ++k) {
        const std::uint32_t g = mesh.around.items[k];
        const double scale = near * near * (squares[f] + squares[g]);
        const double distance = (centres[f] - centres[g]).squaredNorm();
        weights[k] = areas[g].norm() * (scale > 0 ? std::exp(-distance / scale) : 1);
      }
    }
  });
  return weights;
}

/// Moves nodes so that faces get these normals.
std::vector<Vector3> turned(const ScanMesh& mesh, std::vector<Vector3> places, const std::vector<Vector3>& normals,
                            ThreadTeam& team) {
  std::vector<Vector3> next = places;
  for (int step = 0; step < steps_of_nodes; ++step) {
    const std::vector<Vector3> centres = centres_of(mesh, places, team);
    parallel_ranges(team, mesh.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto faces = mesh.faces_of.of(i);
        Vector3 sum = Vector3::Zero();
        for (const std::uint32_t f : faces) sum += normals[f].dot(centres[f] - places[i]) * normals[f];
        if (!faces.empty()) next[i] = places[i] + sum / static_cast<double>(faces.size());
      }
    });
    places.swap(next);
  }
  return places;
}

}  // namespace

std::vector<std::vector<Vector3>> with_flat_faces(const ScanMesh& mesh, const std::vector<Vector3>& places,
                                                  std::span<const int> turns, ThreadTeam& team) {
  const std::vector<Vector3> areas = face_areas(mesh, places, team);
  const std::vector<double> weights = weights_of(mesh, places, areas, team);
  std::vector<Vector3> normals = areas;
  for (std::size_t f = 0; f < normals.size(); ++f) {
    end_if_cancelled_at(f);
    normals[f].stableNormalize();
  }
  std::vector<Vector3> next = normals;
  std::vector<std::vector<Vector3>> shapes;
  int turn = 0;
  for (const int last : turns) {
    for (; turn < last; ++turn) {
      parallel_ranges(team, normals.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t f = begin; f < end; ++f) {
          Vector3 sum = Vector3::Zero();
          for (std::size_t k = mesh.around.begin[f]; k < mesh.around.begin[f + 1]; ++k) {
            const Vector3& other = normals[mesh.around.items[k]];
            sum += weights[k] * std::exp((normals[f] - other).squaredNorm() / (-2 * alike * alike)) * other;
          }
          next[f] = sum;
          next[f].stableNormalize();
        }
      });
      normals.swap(next);
    }
    shapes.push_back(turned(mesh, places, normals, team));
  }
  return shapes;
}

}  // namespace vspring
