#include "io/file_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/disjoint_sets.hpp"

namespace vspring {
namespace {

/// The length in which edges are measured, so that products of lengths neither overflow nor vanish.
double typical_length(std::span<const Vector3> positions) {
  Vector3 low = Vector3::Constant(HUGE_VAL);
  Vector3 high = Vector3::Constant(-HUGE_VAL);
  for (const Vector3& position : positions) {
    if (!position.allFinite()) continue;
    low = low.cwiseMin(position);
    high = high.cwiseMax(position);
  }
  const double length = (high - low).stableNorm();
  return length > 0 && std::isfinite(length) ? length : 1;
}

class CornerSums {
 public:
  CornerSums(std::span<const Vector3> positions, std::size_t count)
      : positions_(positions), length_(typical_length(positions)), sums_(count, Vector3::Zero()) {}

  void add(std::span<const Index> face, std::size_t corner, Index normal) {
    const Vector3& node = positions_[face[corner]];
    const Vector3 to_next = positions_[face[(corner + 1) % face.size()]] - node;
    const Vector3 to_previous = positions_[face[(corner + face.size() - 1) % face.size()]] - node;
    const double next = to_next.stableNorm();
    const double previous = to_previous.stableNorm();
    if (!(next > 0) || !(previous > 0)) return;
    sums_[normal] += (to_next / next).cross(to_previous / previous) * (length_ / next) * (length_ / previous);
  }
  [[nodiscard]] Vector3 unit(std::size_t normal) const { return unit_or_zero(sums_[normal]); }

 private:
  std::span<const Vector3> positions_;
  double length_;
  std::vector<Vector3> sums_;
};

bool comes_before(const Vector3& a, const Vector3& b) {
  return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
}

/// Of every node a number that those have in common which were at one place and still are.
std::vector<std::size_t> numbers_of_places(std::span<const Vector3> old_positions, std::span<const Vector3> positions) {
  std::vector<std::size_t> order(positions.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return old_positions[a] == old_positions[b] ? comes_before(positions[a], positions[b])
                                                : comes_before(old_positions[a], old_positions[b]);
  });
  std::vector<std::size_t> numbers(order.size(), 0);
  for (std::size_t k = 1; k < order.size(); ++k) {
    const std::size_t here = order[k];
    const std::size_t last = order[k - 1];
    const bool is_one = old_positions[here] == old_positions[last] && positions[here] == positions[last];
    numbers[here] = is_one ? numbers[last] : k;
  }
  return numbers;
}

/// Normals that were the same at one place stay the same: along seams, and where each corner names one of its own.
DisjointSets equal_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                           std::span<const Vector3> before, const std::vector<std::size_t>& places) {
  // Most places have one normal alone.
  std::vector<Index> first(places.size(), -1);
  std::vector<std::uint8_t> has_several(places.size(), 0);
  const auto place_of = [&](std::size_t corner) { return places[static_cast<std::size_t>(mesh.corners()[corner])]; };
  for (std::size_t corner = 0; corner < corner_normals.size(); ++corner) {
    const Index normal = corner_normals[corner];
    if (normal < 0) continue;
    Index& one = first[place_of(corner)];
    if (one >= 0 && one != normal) has_several[place_of(corner)] = 1;
    one = normal;
  }
  struct Corner {
    std::size_t place;
    Index normal;
  };
  std::vector<Corner> shared;
  for (std::size_t corner = 0; corner < corner_normals.size(); ++corner) {
    if (corner_normals[corner] >= 0 && has_several[place_of(corner)] != 0)
      shared.push_back({place_of(corner), corner_normals[corner]});
  }
  const auto value = [&](const Corner& corner) -> const Vector3& {
    return before[static_cast<std::size_t>(corner.normal)];
  };
  std::sort(shared.begin(), shared.end(), [&](const Corner& a, const Corner& b) {
    return a.place != b.place ? a.place < b.place : comes_before(value(a), value(b));
  });
  DisjointSets sets(before.size());
  for (std::size_t k = 1; k < shared.size(); ++k) {
    if (shared[k].place == shared[k - 1].place && value(shared[k]) == value(shared[k - 1]))
      (void)sets.join(static_cast<std::size_t>(shared[k].normal), static_cast<std::size_t>(shared[k - 1].normal));
  }
  return sets;
}

}  // namespace

Vector3 unit_or_zero(const Vector3& vector) {
  const double length = vector.stableNorm();
  if (!(length > 0) || !std::isfinite(length)) return Vector3::Zero();
  const Vector3 unit = vector / length;
  return unit.allFinite() ? unit : Vector3::Zero();
}

NewNormals compute_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                           std::span<const Vector3> before, std::span<const Vector3> old_positions,
                           std::span<const Vector3> positions, std::span<const std::uint8_t> moved) {
  NewNormals result;
  result.due.assign(before.size(), 0);
  result.normals.assign(before.size(), Vector3::Zero());
  const auto each_corner = [&](const auto& action) {
    for (Index f = 0; f < mesh.face_count(); ++f) {
      for (std::size_t k = 0; k < mesh.face(f).size(); ++k) {
        const Index normal = corner_normals[mesh.face_begin(f) + k];
        if (normal >= 0) action(f, k, normal);
      }
    }
  };
  bool any = false;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    bool face_moved = false;
    for (const Index node : mesh.face(f)) face_moved = face_moved || moved[node] != 0;
    if (!face_moved) continue;
    for (Index corner = mesh.face_begin(f); corner < mesh.face_begin(f + 1); ++corner) {
      if (corner_normals[corner] < 0) continue;
      result.due[corner_normals[corner]] = 1;
      any = true;
    }
  }
  if (!any) return result;

  DisjointSets sets = equal_normals(mesh, corner_normals, before, numbers_of_places(old_positions, positions));
  const auto set_of = [&](std::size_t normal) { return sets.find(normal); };
  for (std::size_t n = 0; n < before.size(); ++n) result.due[set_of(n)] |= result.due[n];
  for (std::size_t n = 0; n < before.size(); ++n) result.due[n] = result.due[set_of(n)];
  CornerSums old_sums(old_positions, before.size());
  CornerSums new_sums(positions, before.size());
  each_corner([&](Index f, std::size_t corner, Index normal) {
    if (result.due[normal] == 0 || mesh.face(f).size() < 3) return;
    const auto set = static_cast<Index>(set_of(static_cast<std::size_t>(normal)));
    old_sums.add(mesh.face(f), corner, set);
    new_sums.add(mesh.face(f), corner, set);
  });
  double agreement = 0;
  for (std::size_t n = 0; n < before.size(); ++n) {
    if (result.due[n] == 0) continue;
    agreement += unit_or_zero(before[n]).dot(old_sums.unit(set_of(n)));
    result.normals[n] = new_sums.unit(set_of(n));
    result.due[n] = result.normals[n].isZero(0) ? 0 : 1;
  }
  if (agreement < 0) {
    for (Vector3& normal : result.normals) normal = -normal;
  }
  return result;
}

std::vector<Vector3> node_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                                  std::span<const Vector3> normals) {
  std::vector<Vector3> sums(mesh.positions().size(), Vector3::Zero());
  for (std::size_t corner = 0; corner < mesh.corners().size(); ++corner) {
    if (corner_normals[corner] >= 0) sums[mesh.corners()[corner]] += normals[corner_normals[corner]];
  }
  for (Vector3& sum : sums) sum = unit_or_zero(sum);
  return sums;
}

}  // namespace vspring
