#pragma once

// Masks of voxels, for tests and benchmarks.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::support {

/// The common sides of voxels of different materials, in a box around the origin of twice the given size: each once,
/// facing from the greater number of a material to the lesser. material: of the middle of a voxel.
inline PolygonMesh sides_of_materials(const Vector3& size, const Vector3& box,
                                      const std::function<int(const Vector3&)>& material) {
  std::map<std::array<int, 3>, Index> numbers;
  std::vector<Vector3> places;
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  const auto node = [&](const std::array<int, 3>& at) {
    const auto [found, is_new] = numbers.emplace(at, static_cast<Index>(places.size()));
    if (is_new) places.emplace_back(size.x() * at[0], size.y() * at[1], size.z() * at[2]);
    return found->second;
  };
  const auto material_of = [&](const std::array<int, 3>& at) {
    return material(Vector3(size.x() * (at[0] + 0.5), size.y() * (at[1] + 0.5), size.z() * (at[2] + 0.5)));
  };
  std::array<int, 3> most{};
  for (std::size_t axis = 0; axis < 3; ++axis)
    most[axis] = static_cast<int>(std::ceil(box[static_cast<int>(axis)] / size[static_cast<int>(axis)]));
  std::array<int, 3> at{};
  for (at[0] = -most[0]; at[0] < most[0]; ++at[0]) {
    for (at[1] = -most[1]; at[1] < most[1]; ++at[1]) {
      for (at[2] = -most[2]; at[2] < most[2]; ++at[2]) {
        for (std::size_t axis = 0; axis < 3; ++axis) {
          for (const int side : {0, 1}) {
            std::array<int, 3> beside = at;
            beside[axis] += side == 1 ? 1 : -1;
            if (material_of(at) <= material_of(beside)) continue;
            std::vector<Index> face;
            for (const auto& [u, v] : {std::pair(0, 0), std::pair(1, 0), std::pair(1, 1), std::pair(0, 1)}) {
              std::array<int, 3> corner = at;
              corner[axis] += side;
              corner[(axis + 1) % 3] += u;
              corner[(axis + 2) % 3] += v;
              face.push_back(node(corner));
            }
            if (side == 0) std::reverse(face.begin(), face.end());
            corners.insert(corners.end(), face.begin(), face.end());
            begin.push_back(static_cast<Index>(corners.size()));
          }
        }
      }
    }
  }
  return {std::move(places), std::move(begin), std::move(corners)};
}

/// The sides of the voxels whose middles are inside.
inline PolygonMesh sides_of_voxels(const Vector3& size, const Vector3& box,
                                   const std::function<bool(const Vector3&)>& inside) {
  return sides_of_materials(size, box, [&](const Vector3& middle) { return inside(middle) ? 1 : 0; });
}

}  // namespace vspring::support
