#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vspring/noise.hpp"

namespace vspring {

namespace {

using Cell = Eigen::Matrix<std::int64_t, 3, 1>;

// Coordinates closer than this share of the largest are equal, to the rounding of single precision.
constexpr double rounding = 1e-6;
// How far coordinates may be from whole numbers of steps, as a share of a step.
constexpr double off_whole = 0.02;
// Nodes per different coordinate, at least, for coordinates to lie on planes.
constexpr double least_repeats = 4;
// A box of a few faces is no mask.
constexpr std::ptrdiff_t least_nodes = 50;

/// The step of which coordinates, relative to the least, are whole multiples; or none.
std::optional<double> step_of(std::vector<double> values) {
  const std::size_t count = values.size();
  std::sort(values.begin(), values.end());
  const double same = rounding * std::max(std::abs(values.front()), std::abs(values.back()));
  std::vector<double> levels = {values.front()};
  for (const double value : values) {
    if (value - levels.back() > same) levels.push_back(value);
  }
  if (levels.size() < 2 || least_repeats * static_cast<double>(levels.size()) > static_cast<double>(count))
    return std::nullopt;
  double least = levels.back() - levels.front();
  for (std::size_t k = 1; k < levels.size(); ++k) least = std::min(least, levels[k] - levels[k - 1]);
  // The mean of all steps has less rounding.
  const double step = (levels.back() - levels.front()) / std::round((levels.back() - levels.front()) / least);
  const bool is_even = std::all_of(levels.begin(), levels.end(), [&](double level) {
    const double steps = (level - levels.front()) / step;
    return std::abs(steps - std::round(steps)) <= off_whole;
  });
  return is_even ? std::optional(step) : std::nullopt;
}

/// Nodes as cells of the grid, and faces in these.
class VoxelFaces {
 public:
  VoxelFaces(const PolygonMesh& mesh, std::vector<Cell> cells) : mesh_(mesh), cells_(std::move(cells)) {}

  /// Whether faces are sides of voxels: in planes of the grid, over one voxel each.
  [[nodiscard]] bool are_sides() const {
    return all_faces([&](std::span<const Index> face) {
      const Cell away = extent(face);
      return away.maxCoeff() == 1 && away.minCoeff() == 0;
    });
  }

  /// Whether marching cubes or tetrahedra made the faces from a mask: nodes half way between points of the grid, none
  /// at them, and each face within one voxel.
  [[nodiscard]] bool are_between_points() const {
    for (int base = 0; base < 8; ++base) {
      const auto is_middle = [&](Index node) {
        int odd = 0;
        for (int axis = 0; axis < 3; ++axis) odd += ((cell(node)[axis] ^ (base >> axis)) & 1) != 0 ? 1 : 0;
        return odd > 0;
      };
      if (all_faces([&](std::span<const Index> face) {
            return extent(face).maxCoeff() <= 2 && std::all_of(face.begin(), face.end(), is_middle);
          }))
        return true;
    }
    return false;
  }

 private:
  [[nodiscard]] const Cell& cell(Index node) const { return cells_[static_cast<std::size_t>(node)]; }

  [[nodiscard]] Cell extent(std::span<const Index> face) const {
    Cell low = cell(face[0]);
    Cell high = low;
    for (const Index node : face) {
      low = low.cwiseMin(cell(node));
      high = high.cwiseMax(cell(node));
    }
    return high - low;
  }

  template <typename Is>
  [[nodiscard]] bool all_faces(Is is) const {
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (!mesh_.face(f).empty() && !is(mesh_.face(f))) return false;
    }
    return true;
  }

  const PolygonMesh& mesh_;
  std::vector<Cell> cells_;
};

}  // namespace

std::optional<Vector3> voxel_size(const PolygonMesh& mesh) {
  std::vector<std::uint8_t> used(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Index node : mesh.corners()) used[static_cast<std::size_t>(node)] = 1;
  if (std::count(used.begin(), used.end(), 1) < least_nodes) return std::nullopt;
  Vector3 step;
  Vector3 low;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (std::size_t i = 0; i < used.size(); ++i) {
      const double value = mesh.positions()[i][axis];
      if (used[i] == 0) continue;
      if (!std::isfinite(value)) return std::nullopt;
      values.push_back(value);
    }
    if (values.empty()) return std::nullopt;
    low[axis] = *std::min_element(values.begin(), values.end());
    const std::optional<double> found = step_of(std::move(values));
    if (!found) return std::nullopt;
    step[axis] = *found;
  }
  std::vector<Cell> cells(used.size(), Cell::Zero());
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0) continue;
    for (int axis = 0; axis < 3; ++axis)
      cells[i][axis] = std::llround((mesh.positions()[i][axis] - low[axis]) / step[axis]);
  }
  const VoxelFaces faces(mesh, std::move(cells));
  if (faces.are_sides()) return step;
  if (faces.are_between_points()) return 2 * step;
  return std::nullopt;
}

}  // namespace vspring
