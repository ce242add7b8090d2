#include "fill/rim.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

#include "shape/boundary.hpp"
#include "shape/face_geometry.hpp"
#include "shape/fan.hpp"

namespace vspring {

namespace {

/// Splits a closed walk into loops where it comes back to a node.
std::vector<std::vector<Index>> simple_loops(const std::vector<Index>& walk, std::vector<std::uint8_t>& on_path) {
  std::vector<std::vector<Index>> loops;
  std::vector<Index> path;
  for (const Index node : walk) {
    if (on_path[static_cast<std::size_t>(node)] != 0) {
      const auto first = std::find(path.begin(), path.end(), node);
      loops.emplace_back(first, path.end());
      for (auto k = first; k != path.end(); ++k) on_path[static_cast<std::size_t>(*k)] = 0;
      path.erase(first, path.end());
    }
    path.push_back(node);
    on_path[static_cast<std::size_t>(node)] = 1;
  }
  for (const Index node : path) on_path[static_cast<std::size_t>(node)] = 0;
  loops.push_back(std::move(path));
  return loops;
}

class HoleFinder {
 public:
  HoleFinder(const PolygonMesh& mesh, const Incidence& incidence)
      : mesh_(mesh), incidence_(incidence), walker_(mesh, incidence) {}

  /// loop: in the direction of the face at its first edge.
  Hole hole(std::vector<Index> loop) {
    Hole hole;
    std::reverse(loop.begin(), loop.end());
    std::rotate(loop.begin(), std::min_element(loop.begin(), loop.end()), loop.end());
    hole.rim = std::move(loop);
    for (std::size_t k = 0; k < hole.rim.size(); ++k) {
      const Index node = hole.rim[k];
      const Index next = hole.rim[(k + 1) % hole.rim.size()];
      hole.length += (mesh_.position(next) - mesh_.position(node)).norm();
      look_for_faults(hole, node, next);
    }
    if (hole.fault != HoleFault::none) hole.state = HoleState::unfillable;
    if (!std::isfinite(hole.length)) hole.length = 0;
    hole.facing = facing_of(hole.rim);
    return hole;
  }

 private:
  double facing_of(const std::vector<Index>& rim) const {
    // In the direction of the faces along it.
    const Vector3 area = -twice_vector_area(std::span(rim), mesh_.positions());
    Vector3 sum = Vector3::Zero();
    double total = 0;
    for (const Index node : rim) {
      for (const Corner corner : incidence_.corners(node)) {
        const Vector3 face = twice_vector_area(mesh_.face(corner.face), mesh_.positions());
        sum += face;
        total += face.norm();
      }
    }
    const double scale = area.norm() * total;
    return scale > 0 && std::isfinite(scale) ? area.dot(sum) / scale : 0;
  }

  void look_for_faults(Hole& hole, Index node, Index next) {
    const auto fault = [&](HoleFault what) {
      if (hole.fault != HoleFault::none) return;
      hole.fault = what;
      hole.fault_node = node;
    };
    if (!mesh_.position(node).allFinite()) fault(HoleFault::not_finite);
    const Fan& fan = walker_.walk(node);
    if (fan.crowded_neighbour >= 0 || fan.repeating_face >= 0) fault(HoleFault::non_manifold);
    if (face_beside(mesh_, incidence_, node, next) < 0) fault(HoleFault::orientation);
  }

  const PolygonMesh& mesh_;
  const Incidence& incidence_;
  FanWalker walker_;
};

}  // namespace

Index face_beside(const PolygonMesh& mesh, const Incidence& incidence, Index from, Index to) {
  for (const Corner corner : incidence.corners(to)) {
    const auto face = mesh.face(corner.face);
    if (face[static_cast<std::size_t>(corner.place + 1) % face.size()] == from) return corner.face;
  }
  return -1;
}

std::vector<Hole> find_holes(const PolygonMesh& mesh, const Incidence& incidence) {
  std::vector<Hole> holes;
  HoleFinder finder(mesh, incidence);
  std::vector<std::uint8_t> on_path(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const std::vector<Index>& walk : Boundary(mesh, incidence).loops()) {
    for (std::vector<Index>& loop : simple_loops(walk, on_path)) holes.push_back(finder.hole(std::move(loop)));
  }
  std::sort(holes.begin(), holes.end(), [](const Hole& a, const Hole& b) { return a.rim < b.rim; });
  return holes;
}

std::string called(const Hole& hole) { return fmt::format("the hole at node {}", hole.rim.front()); }

bool Hole::is_outer_rim() const noexcept { return facing > 0.5; }

const char* name(HoleState state) noexcept {
  switch (state) {
    case HoleState::open:
      return "open";
    case HoleState::filled:
      return "filled";
    case HoleState::outer_rim:
      return "outer-rim";
    case HoleState::too_large:
      return "too-large";
    case HoleState::elsewhere:
      return "elsewhere";
    case HoleState::unfillable:
      return "unfillable";
    case HoleState::cancelled:
      return "cancelled";
  }
  return "";
}

std::string fault_message(const Hole& hole) {
  const auto with = [&](const char* what) {
    return fmt::format("{} stays open: {}", called(hole), fmt::format(fmt::runtime(what), hole.fault_node));
  };
  switch (hole.fault) {
    case HoleFault::none:
      return {};
    case HoleFault::not_finite:
      return with("node {} of its rim has a coordinate that is not finite; correct it");
    case HoleFault::non_manifold:
      return with(
          "at node {} of its rim more than two faces share an edge, or a face has the node twice; delete faces there");
    case HoleFault::orientation:
      return with(
          "at node {} of its rim the faces on both sides run in different directions, or the rim ends; turn faces "
          "over so that all run alike");
    case HoleFault::no_triangulation:
      return with(
          "edges outside already join its nodes where each triangulation needs some; delete the faces around it "
          "as well");
    case HoleFault::folded:
      return with(
          "each triangulation folds back onto itself or onto the faces around, or has no area; delete the faces "
          "around it as well, or weld the nodes of its rim where it is a slit");
  }
  return {};
}

std::vector<Hole> find_holes(const PolygonMesh& mesh) { return find_holes(mesh, Incidence(mesh)); }

}  // namespace vspring
