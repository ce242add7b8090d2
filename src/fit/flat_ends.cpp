#include "fit/flat_ends.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"

namespace vspring {

namespace {

// In half voxels: how far down the surface goes, and by how much less or more; how far aside of the rim it may be then,
// also as a share of the depth.
constexpr std::int64_t depth_of_end = 6;
constexpr std::int64_t more_or_less = 1;
constexpr std::int64_t most_aside = 3;
constexpr double aside_of_depth = 0.5;
constexpr double least_share_of_rim = 0.8;
constexpr std::size_t least_inside = 12;
// Least cosine of the angle between an axis and the normals of faces that face along it.
constexpr double least_cosine = 0.7;

using Cell = std::array<std::int64_t, 3>;

/// The plane of the grid in which a face lies, and the side to which it faces.
struct Plane {
  int axis;
  std::int64_t level;
  int sign;
  bool operator==(const Plane&) const = default;
};

class FlatEnds {
 public:
  FlatEnds(const PolygonMesh& mesh, const Vector3& size) : mesh_(mesh), incidence_(mesh), size_(size) {
    for (const Vector3& position : mesh.positions()) {
      Cell& cell = cells_.emplace_back();
      for (int axis = 0; axis < 3; ++axis)
        cell[static_cast<std::size_t>(axis)] =
            std::llround(2 * (position[axis] - mesh.positions()[0][axis]) / size[axis]);
    }
    for (Index f = 0; f < mesh.face_count(); ++f) planes_.push_back(plane_of(f));
    for (int axis = 0; axis < 3; ++axis) {
      for (const int sign : {-1, 1}) walls_.push_back(cells_not_looking(axis, -sign));
    }
  }

  [[nodiscard]] std::vector<std::uint8_t> find() {
    DisjointSets terraces(planes_.size());
    for (Index node = 0; node < mesh_.node_count(); ++node) join_at(node, terraces);
    struct Terrace {
      std::size_t rim = 0;
      std::size_t tall = 0;
      std::size_t inside = 0;
    };
    std::vector<Terrace> found(planes_.size());
    std::vector<std::optional<std::size_t>> inside_of(cells_.size());
    for (Index node = 0; node < mesh_.node_count(); ++node) {
      const std::vector<std::size_t> around = terraces_at(node, terraces);
      const auto& corners = incidence_.corners(node);
      const bool all_flat = std::all_of(corners.begin(), corners.end(), [&](const auto& corner) {
        return planes_[static_cast<std::size_t>(corner.face)].has_value();
      });
      if (around.size() == 1 && all_flat) {
        ++found[around[0]].inside;
        inside_of[static_cast<std::size_t>(node)] = around[0];
        continue;
      }
      for (const std::size_t terrace : around) {
        ++found[terrace].rim;
        found[terrace].tall += goes_down(cells_[static_cast<std::size_t>(node)], *planes_[terrace]) ? 1 : 0;
      }
    }
    std::vector<std::uint8_t> nodes(cells_.size(), 0);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      if (!inside_of[i]) continue;
      const Terrace& terrace = found[*inside_of[i]];
      const bool is_end = static_cast<double>(terrace.tall) >= least_share_of_rim * static_cast<double>(terrace.rim);
      nodes[i] = is_end && terrace.inside >= least_inside ? 1 : 0;
    }
    return nodes;
  }

 private:
  [[nodiscard]] std::optional<Plane> plane_of(Index f) const {
    const auto face = mesh_.face(f);
    if (face.size() < 3) return std::nullopt;
    const Vector3 area = twice_vector_area(face, mesh_.positions());
    for (int axis = 0; axis < 3; ++axis) {
      const auto level = [&](Index node) {
        return cells_[static_cast<std::size_t>(node)][static_cast<std::size_t>(axis)];
      };
      if (std::all_of(face.begin(), face.end(), [&](Index node) { return level(node) == level(face[0]); }))
        return Plane{axis, level(face[0]), area[axis] < 0 ? -1 : 1};
    }
    return std::nullopt;
  }

  void join_at(Index node, DisjointSets& terraces) const {
    const auto& corners = incidence_.corners(node);
    for (std::size_t a = 0; a < corners.size(); ++a) {
      const auto first = static_cast<std::size_t>(corners[a].face);
      for (std::size_t b = 0; b < a && planes_[first]; ++b) {
        const auto second = static_cast<std::size_t>(corners[b].face);
        if (planes_[second] == planes_[first]) (void)terraces.join(first, second);
      }
    }
  }

  [[nodiscard]] std::vector<std::size_t> terraces_at(Index node, DisjointSets& terraces) const {
    std::vector<std::size_t> around;
    for (const auto& corner : incidence_.corners(node)) {
      const auto face = static_cast<std::size_t>(corner.face);
      if (planes_[face]) around.push_back(terraces.find(face));
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    return around;
  }

  /// Of nodes none of whose faces looks that way, in order.
  [[nodiscard]] std::vector<Cell> cells_not_looking(int axis, int sign) const {
    std::vector<std::uint8_t> looks(cells_.size(), 0);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Vector3 area = twice_vector_area(mesh_.face(f), mesh_.positions());
      if (!(sign * area[axis] > least_cosine * area.norm())) continue;
      for (const Index node : mesh_.face(f)) looks[static_cast<std::size_t>(node)] = 1;
    }
    std::vector<Cell> cells;
    for (std::size_t i = 0; i < cells_.size(); ++i) {
      if (looks[i] == 0) cells.push_back(cells_[i]);
    }
    std::sort(cells.begin(), cells.end());
    return cells;
  }

  /// Whether the surface is near the line from a node inwards, three voxels below, and is not the other side of a thin
  /// part.
  [[nodiscard]] bool goes_down(const Cell& rim, const Plane& plane) const {
    const auto axis = static_cast<std::size_t>(plane.axis);
    const std::size_t u = (axis + 1) % 3;
    const std::size_t v = (axis + 2) % 3;
    const auto aside_along = [&](std::size_t across) {
      const double most =
          aside_of_depth * depth_of_end * size_[static_cast<int>(axis)] / size_[static_cast<int>(across)];
      return std::clamp<std::int64_t>(std::llround(most), 1, most_aside);
    };
    const std::int64_t aside_u = aside_along(u);
    const std::int64_t aside_v = aside_along(v);
    const std::vector<Cell>& walls = walls_[2 * axis + (plane.sign > 0 ? 1 : 0)];
    Cell at = rim;
    for (std::int64_t down = depth_of_end - more_or_less; down <= depth_of_end + more_or_less; ++down) {
      at[axis] = rim[axis] - plane.sign * down;
      for (at[u] = rim[u] - aside_u; at[u] <= rim[u] + aside_u; ++at[u]) {
        for (at[v] = rim[v] - aside_v; at[v] <= rim[v] + aside_v; ++at[v]) {
          if (std::binary_search(walls.begin(), walls.end(), at)) return true;
        }
      }
    }
    return false;
  }

  const PolygonMesh& mesh_;
  Incidence incidence_;
  Vector3 size_;
  std::vector<Cell> cells_;               // in half voxels
  std::vector<std::vector<Cell>> walls_;  // by axis and sign of a plane: of nodes that do not look the other way
  std::vector<std::optional<Plane>> planes_;
};

}  // namespace

std::vector<std::uint8_t> nodes_of_flat_ends(const PolygonMesh& mesh, const Vector3& size) {
  return FlatEnds(mesh, size).find();
}

}  // namespace vspring
