// Removes the steps of a mask: finds the fairest surface near its nodes, each of which lies anywhere within half a
// voxel of its true place.

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "base/threads.hpp"
#include "checks/new_crossings.hpp"
#include "constraints/holding.hpp"
#include "fit/flat_ends.hpp"
#include "fit/kinds_of_fit.hpp"
#include "fit/measure_again.hpp"
#include "shape/edges.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"
#include "shape/turned_edges.hpp"
#include "vspring/distance.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// In cube roots of a voxel's volume: shorter lengths leave steps, longer ones remove details.
constexpr double smoothing_in_voxels = 2;
constexpr int most_turns = 6;
// How far nodes inside flat ends may move, in half voxels; and their weight at first.
constexpr double share_of_flat = 0.1;
constexpr double weight_of_flat = 30;
// Nodes that go back to half a voxel change the volume, too.
constexpr int turns_of_volume = 4;
// Where the other nodes cannot restore all of the volume, flat ends move by some hundredths of a voxel.
constexpr int turns_with_flat_ends = 2;
// Nodes whose edges would turn too far go back and change the volume, too; then others may have to go back.
constexpr int most_rounds_of_volume = 4;
// As a share of the area: the sum of the area vectors of a closed surface is below it.
constexpr double closed_share = 1e-9;
// The least share of the area that moves where the volume is restored.
constexpr double least_share_of_area = 0.05;
// Difference of cosines.
constexpr double unseen = 1e-9;

/// For surfaces that marching cubes and tetrahedra make of a mask: per node a bit for each axis along which it is half
/// way between middles of voxels.
std::vector<std::uint8_t> axes_halfway(const PolygonMesh& mesh, const Vector3& size) {
  std::vector<std::uint8_t> halfway(mesh.positions().size(), 0);
  if (mesh.corners().empty()) return halfway;
  const Vector3& origin = mesh.position(mesh.corners().front());
  for (const Index node : mesh.corners()) {
    const Vector3 steps = (mesh.position(node) - origin).cwiseQuotient(size / 2);
    unsigned bits = 0;
    for (int axis = 0; axis < 3; ++axis) bits |= static_cast<unsigned>(std::llround(steps[axis]) & 1) << axis;
    halfway[static_cast<std::size_t>(node)] = static_cast<std::uint8_t>(bits);
  }
  // Finds the origin. No node is at a middle of a voxel; of several such grids, the right one has the shortest edges:
  // the others have diagonals where marching cubes have none.
  const double at_middle = 4 * static_cast<double>(mesh.corners().size());
  std::array<double, 8> sums{};
  for (const Index node : mesh.corners()) {
    for (unsigned base = 0; base < sums.size(); ++base) {
      const int axes = std::popcount(halfway[static_cast<std::size_t>(node)] ^ base);
      sums[base] += axes > 0 ? axes : at_middle;
    }
  }
  const auto base = static_cast<unsigned>(std::min_element(sums.begin(), sums.end()) - sums.begin());
  for (std::uint8_t& bits : halfway) bits = static_cast<std::uint8_t>(bits ^ base);
  return halfway;
}

class VoxelFit {
 public:
  VoxelFit(const PolygonMesh& mesh, const Constraints& constraints, Vector3 size, bool of_sides)
      : mesh_(mesh),
        constraints_(constraints),
        size_(std::move(size)),
        of_sides_(of_sides),
        halfway_(of_sides ? std::vector<std::uint8_t>() : axes_halfway(mesh, size_)),
        flat_(nodes_of_flat_ends(mesh, size_)),
        stays_(mesh.positions().size(), 0) {
    for (Index f = 0; f < mesh.face_count(); ++f) {
      const auto face = mesh.face(f);
      if (std::none_of(face.begin(), face.end(), [&](Index node) { return constraints.position_fixed(node); }))
        continue;
      for (const Index node : face) stays_[static_cast<std::size_t>(node)] = 1;
    }
  }

  void weigh_flat_ends(std::vector<double>& weights) const {
    for (std::size_t i = 0; i < weights.size(); ++i) weights[i] *= flat_[i] != 0 ? weight_of_flat : 1;
  }

  /// How far each node has moved across the shape, as a share of half a voxel in that direction.
  [[nodiscard]] std::vector<double> shares_of_half(const std::vector<Vector3>& positions,
                                                   const std::vector<Vector3>& normals) const {
    std::vector<double> shares(positions.size(), 0);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double half = this->half(i, normals[i]);
      if (half > 0) shares[i] = (positions[i] - mesh_.positions()[i]).dot(normals[i]) / half;
    }
    return shares;
  }

  [[nodiscard]] std::vector<Vector3> normals(const std::vector<Vector3>& positions) const {
    std::vector<Vector3> sums(positions.size(), Vector3::Zero());
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const Vector3 area = twice_vector_area(mesh_.face(f), positions);
      for (const Index node : mesh_.face(f)) sums[static_cast<std::size_t>(node)] += area;
    }
    for (Vector3& sum : sums) sum = sum.squaredNorm() > 0 ? sum.normalized() : Vector3(Vector3::Zero());
    return sums;
  }

  /// The volume of a closed surface is restored; nodes that moved further than half a voxel go back to that, and nodes
  /// whose moves turn edges over go back to where they were.
  void finish(std::vector<Vector3>& positions) {
    const TurnedEdges turned(mesh_);
    for (int round = 0; round < most_rounds_of_volume; ++round) {
      put_volume_back(positions);
      const std::vector<Vector3> before = positions;
      turned.take_back(positions);
      if (positions == before) return;
      for (std::size_t i = 0; i < positions.size(); ++i) {
        if (positions[i] != before[i]) stays_[i] = 1;
      }
    }
  }

 private:
  void put_volume_back(std::vector<Vector3>& positions) const {
    for (int turn = 0; turn < turns_of_volume + turns_with_flat_ends; ++turn) {
      const std::vector<Vector3> across = normals(positions);
      const auto goes = [&](std::size_t i) { return stays_[i] == 0 && (flat_[i] == 0 || turn >= turns_of_volume); };
      const double offset = offset_for_volume(positions, across, goes);
      for (std::size_t i = 0; i < positions.size(); ++i) positions[i] += (goes(i) ? offset : 0) * across[i];
      const std::vector<double> shares = shares_of_half(positions, across);
      for (std::size_t i = 0; i < positions.size(); ++i) {
        if (constraints_.position_fixed(static_cast<Index>(i)) || std::abs(shares[i]) <= 1) continue;
        positions[i] -= (shares[i] - std::copysign(1, shares[i])) * half(i, across[i]) * across[i];
      }
    }
  }

  /// As far as a plane may be from a corner of the voxels that it goes between; from the middle of an edge between two
  /// middles of voxels, where marching cubes have their nodes, or of a diagonal, where marching tetrahedra have others.
  [[nodiscard]] double half(std::size_t node, const Vector3& normal) const {
    const Vector3 halves = normal.cwiseAbs().cwiseProduct(size_) / 2;
    double far = of_sides_ ? halves.sum() : 0;
    if (!of_sides_) {
      for (int axis = 0; axis < 3; ++axis) far += (halfway_[node] >> axis & 1) != 0 ? halves[axis] : 0;
      far = std::max(far, halves.maxCoeff());
    }
    return (flat_[node] != 0 ? share_of_flat : 1) * far;
  }

  /// The move of free nodes along normals that restores the volume; 0 where the surface is open or nearly all of it
  /// stays.
  template <typename Goes>
  [[nodiscard]] double offset_for_volume(const std::vector<Vector3>& positions, const std::vector<Vector3>& across,
                                         const Goes& goes) const {
    double volume = 0;
    double whole = 0;
    double area = 0;
    Vector3 closed = Vector3::Zero();
    const Vector3& origin = positions.front();
    const auto cone = [&](std::span<const Index> face, const std::vector<Vector3>& at, const Vector3& area_vector) {
      Vector3 middle = Vector3::Zero();
      for (const Index node : face) middle += at[static_cast<std::size_t>(node)] - origin;
      return middle.dot(area_vector) / (6 * static_cast<double>(face.size()));
    };
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      const auto face = mesh_.face(f);
      if (face.empty()) continue;
      const Vector3 before = twice_vector_area(face, mesh_.positions());
      const Vector3 now = twice_vector_area(face, positions);
      closed += now;
      volume += cone(face, mesh_.positions(), before) - cone(face, positions, now);
      for (const Index node : face) {
        const double share = across[static_cast<std::size_t>(node)].dot(now) / (2 * static_cast<double>(face.size()));
        whole += share;
        area += goes(static_cast<std::size_t>(node)) ? share : 0;
      }
    }
    const bool is_closed = closed.norm() <= closed_share * whole;
    return is_closed && area > least_share_of_area * whole ? volume / area : 0;
  }

  const PolygonMesh& mesh_;
  const Constraints& constraints_;
  Vector3 size_;
  bool of_sides_;                      // of voxels, rather than what marching cubes make of them
  std::vector<std::uint8_t> halfway_;  // axes along which a node is between middles of voxels, a bit each
  std::vector<std::uint8_t> flat_;
  std::vector<std::uint8_t> stays_;  // where the volume is put back: what is held, next to that, or went back
};

/// Whether all faces are across an axis, as the sides of voxels are.
bool are_sides(const PolygonMesh& mesh) {
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 area = twice_vector_area(mesh.face(f), mesh.positions()).cwiseAbs();
    if (!(area.maxCoeff() >= (1 - unseen) * area.sum())) return false;
  }
  return true;
}

/// Whether all nodes are within a voxel of where they were.
bool is_near(const PolygonMesh& mesh, const std::vector<Vector3>& positions, const Vector3& size) {
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (!((positions[i] - mesh.positions()[i]).norm() <= size.norm())) return false;
  }
  return true;
}

FitResult take_steps_off(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                         const FitOptions& options, bool of_sides, Context& context) {
  const Vector3 size = std::get<Voxels>(options.criterion).size;
  VoxelFit voxels(mesh, constraints, size, of_sides);
  FitOptions smooth = options;
  smooth.criterion = SmoothingLength{smoothing_in_voxels * std::cbrt(size.prod())};
  // What is within half a voxel is near.
  if (!smooth.fair.distribution) smooth.fair.distribution = Distribution::keep;
  ScatteredPoints weighted = points;
  if (weighted.weights.empty()) weighted.weights.assign(mesh.positions().size(), 1);
  voxels.weigh_flat_ends(weighted.weights);
  bool was_worse = false;
  const auto smoothed = [&] {
    // What is worse may be mended below.
    smooth.fair.accept_worse = true;
    FitResult found = fit_as_asked(mesh, constraints, weighted, smooth, context);
    smooth.fair.accept_worse = options.fair.accept_worse;
    if (found.report.fair.outcome == Outcome::worse_than_input) {
      was_worse = true;
      found.report.fair.outcome = Outcome::converged;
      std::erase_if(found.report.fair.warnings,
                    [](const Warning& warning) { return warning.code == WarningCode::worse_than_input; });
    }
    if (found.report.fair.outcome == Outcome::converged || context.cancelled()) return found;
    return fit_as_asked(mesh, constraints, weighted, smooth, context);
  };
  FitResult found = smoothed();
  for (int turn = 1; turn < most_turns && found.report.fair.outcome == Outcome::converged; ++turn) {
    // Nodes that are too far away, as at edges, get more weight until they are not.
    const std::vector<double> shares = voxels.shares_of_half(found.positions, voxels.normals(found.positions));
    bool is_beyond = false;
    for (std::size_t i = 0; i < shares.size(); ++i) {
      const double share = std::abs(shares[i]);
      if (share <= 1 || constraints.position_fixed(static_cast<Index>(i))) continue;
      is_beyond = true;
      weighted.weights[i] *= std::pow(1 + share, 2);
    }
    if (!is_beyond) break;
    FitResult nearer = smoothed();
    if (nearer.report.fair.outcome != Outcome::converged) break;
    found = std::move(nearer);
  }
  if (found.report.fair.outcome != Outcome::converged) return found;
  std::vector<Vector3> finished = found.positions;
  voxels.finish(finished);
  // fit_as_asked() has checked its own result, but not this shape.
  ThreadTeam team(context.thread_count());
  const std::string crossings = new_crossings(mesh, finished, context, team);
  if (crossings.empty() && (!was_worse || (is_near(mesh, finished, size) && !loses_area(mesh, finished)))) {
    found.positions = std::move(finished);
    measure_again(mesh, constraints, options, found, context.threads);
  } else {
    // What was accepted is worse, and was not mended.
    if (was_worse) found = fit_as_asked(mesh, constraints, weighted, smooth, context);
    if (found.report.fair.outcome != Outcome::converged) return found;
    found.report.fair.outcome = Outcome::stalled;
    found.report.fair.warnings.push_back({WarningCode::outside_tolerance,
                                          "nodes may be further away than half a voxel: brought back to that, " +
                                              (crossings.empty() ? "faces lose their area" : crossings),
                                          {{Remedy::rules, "hold more there"}}});
  }
  return found;
}

}  // namespace

FitResult fit_voxels(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                     const FitOptions& options, Context& context) {
  if (points.positions != mesh.positions())
    throw Error(ErrorCode::invalid_argument,
                "steps of voxels can be taken off only where the points are the nodes of the surface; take a smoothing "
                "length for others");
  const bool of_sides = are_sides(mesh);
  return fit_sheets(mesh, constraints, points, options, context,
                    [&](const PolygonMesh& sheets, const Constraints& held, const ScatteredPoints& of_sheets) {
                      (void)check_constraints(sheets, held, std::vector<std::uint8_t>(sheets.positions().size(), 1));
                      return take_steps_off(sheets, held, of_sheets, options, of_sides, context);
                    });
}

}  // namespace vspring
