#include "io/file_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "shape/coincident_nodes.hpp"

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

/// Per node the first one at the same place. Nodes that are not finite are alone.
std::vector<Index> first_at_place(const PolygonMesh& mesh, std::span<const Vector3> positions) {
  std::vector<std::uint8_t> used(positions.size(), 0);
  for (const Index node : mesh.corners()) used[static_cast<std::size_t>(node)] = 1;
  std::vector<Index> nodes;
  Eigen::AlignedBox<double, 3> box;
  for (std::size_t i = 0; i < used.size(); ++i) {
    if (used[i] == 0 || !positions[i].allFinite()) continue;
    nodes.push_back(static_cast<Index>(i));
    box.extend(positions[i]);
  }
  return coincident_nodes(positions, std::move(nodes), box, 0).first;
}

/// Joins equal normals at one place, if its nodes stay together: along seams, and where each corner has a normal of its
/// own.
DisjointSets equal_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals,
                           std::span<const Vector3> before, std::span<const Vector3> old_positions,
                           std::span<const Vector3> positions) {
  const std::vector<Index> places = first_at_place(mesh, old_positions);
  struct Corner {
    Index place;
    Index node;
    Index normal;
  };
  std::vector<Corner> corners;
  for (std::size_t k = 0; k < corner_normals.size(); ++k) {
    const Index node = mesh.corners()[k];
    const Index normal = corner_normals[k];
    if (normal >= 0 && before[static_cast<std::size_t>(normal)].allFinite())
      corners.push_back({places[static_cast<std::size_t>(node)], node, normal});
  }
  // Most places have a single normal.
  std::vector<Index> first(positions.size(), -1);
  std::vector<std::uint8_t> has_several(positions.size(), 0);
  for (const Corner& corner : corners) {
    Index& one = first[static_cast<std::size_t>(corner.place)];
    if (one >= 0 && one != corner.normal) has_several[static_cast<std::size_t>(corner.place)] = 1;
    one = corner.normal;
  }
  std::erase_if(corners,
                [&](const Corner& corner) { return has_several[static_cast<std::size_t>(corner.place)] == 0; });
  const auto value = [&](const Corner& corner) -> const Vector3& {
    return before[static_cast<std::size_t>(corner.normal)];
  };
  const auto goes_to = [&](const Corner& corner) -> const Vector3& {
    return positions[static_cast<std::size_t>(corner.node)];
  };
  std::erase_if(corners, [&](const Corner& corner) { return !goes_to(corner).allFinite(); });
  std::sort(corners.begin(), corners.end(), [&](const Corner& a, const Corner& b) {
    if (a.place != b.place) return a.place < b.place;
    return value(a) != value(b) ? comes_before(value(a), value(b)) : comes_before(goes_to(a), goes_to(b));
  });
  DisjointSets sets(before.size());
  for (std::size_t k = 1; k < corners.size(); ++k) {
    const Corner& here = corners[k];
    const Corner& last = corners[k - 1];
    if (here.place == last.place && value(here) == value(last) && goes_to(here) == goes_to(last))
      (void)sets.join(static_cast<std::size_t>(here.normal), static_cast<std::size_t>(last.normal));
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

  DisjointSets sets = equal_normals(mesh, corner_normals, before, old_positions, positions);
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

PartedNormals part_normals(const PolygonMesh& mesh, std::span<const Index> corner_normals, std::size_t normal_count) {
  PartedNormals parts = {{corner_normals.begin(), corner_normals.end()}, std::vector<Index>(normal_count)};
  std::iota(parts.of_file.begin(), parts.of_file.end(), 0);
  std::vector<Index> node_of(normal_count, -1);
  std::vector<std::uint8_t> is_shared(normal_count, 0);
  for (std::size_t corner = 0; corner < corner_normals.size(); ++corner) {
    if (corner_normals[corner] < 0) continue;
    const auto normal = static_cast<std::size_t>(corner_normals[corner]);
    if (node_of[normal] >= 0 && node_of[normal] != mesh.corners()[corner]) is_shared[normal] = 1;
    node_of[normal] = mesh.corners()[corner];
  }
  /// A corner whose normal is shared. Its part is that of the node, or of the face if that alone names the normal.
  struct Use {
    Index normal;
    Index node;
    Index face;
    Index corner;
    bool is_joined = false;  ///< with another face, by the normal at this node
  };
  std::vector<Use> uses;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    for (Index corner = mesh.face_begin(f); corner < mesh.face_begin(f + 1); ++corner) {
      const Index normal = corner_normals[static_cast<std::size_t>(corner)];
      if (normal >= 0 && is_shared[static_cast<std::size_t>(normal)] != 0)
        uses.push_back({normal, mesh.corners()[static_cast<std::size_t>(corner)], f, corner});
    }
  }
  const auto sort_by = [&](const auto& key) {
    std::sort(uses.begin(), uses.end(), [&](const Use& a, const Use& b) { return key(a) < key(b); });
  };
  sort_by([](const Use& use) { return std::tie(use.normal, use.node, use.corner); });
  for (std::size_t k = 1; k < uses.size(); ++k) {
    Use& one = uses[k - 1];
    Use& other = uses[k];
    if (one.normal == other.normal && one.node == other.node && one.face != other.face)
      one.is_joined = other.is_joined = true;
  }
  sort_by([](const Use& use) { return std::tie(use.normal, use.face, use.corner); });
  for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
    bool is_joined = false;
    for (; end < uses.size() && uses[end].normal == uses[begin].normal && uses[end].face == uses[begin].face; ++end)
      is_joined = is_joined || uses[end].is_joined;
    for (std::size_t k = begin; k < end; ++k) (is_joined ? uses[k].face : uses[k].node) = -1;
  }
  sort_by([](const Use& use) { return std::tie(use.normal, use.node, use.face, use.corner); });
  Index part = -1;
  for (std::size_t k = 0; k < uses.size(); ++k) {
    const Use& use = uses[k];
    if (k == 0 || use.normal != uses[k - 1].normal) {
      // The first part of a normal has its number.
      part = use.normal;
    } else if (use.node != uses[k - 1].node || use.face != uses[k - 1].face) {
      part = static_cast<Index>(parts.of_file.size());
      parts.of_file.push_back(use.normal);
    }
    parts.of_corner[static_cast<std::size_t>(use.corner)] = part;
  }
  return parts;
}

std::vector<Vector3> normals_of_added(const PolygonMesh& mesh, std::span<const Vector3> before,
                                      const std::vector<Vector3>& positions, std::span<const Index> like) {
  std::vector<Vector3> normals(before.begin(), before.end());
  normals.resize(positions.size(), Vector3::Zero());
  std::vector<std::uint8_t> is_new(positions.size(), 1);
  std::fill_n(is_new.begin(), before.size(), std::uint8_t{0});
  const NewNormals fresh = compute_normals(mesh, mesh.corners(), normals, positions, positions, is_new);
  std::vector<Vector3> result;
  for (std::size_t k = 0; k < like.size(); ++k) {
    const std::size_t node = before.size() + k;
    result.push_back(fresh.due[node] != 0 ? fresh.normals[node] : before[static_cast<std::size_t>(like[k])]);
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
