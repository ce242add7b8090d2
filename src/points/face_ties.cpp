#include "points/face_ties.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "base/cancellation.hpp"
#include "shape/triangle_place.hpp"
#include "shape/triangles.hpp"

namespace vspring {

namespace {

constexpr std::uint32_t nowhere = UINT32_MAX;
// At nodes of more faces those of neighbours are left out: a hub is the neighbour of too many.
constexpr std::size_t most_faces_around = 100;

}  // namespace

FaceTies::FaceTies(const PolygonMesh& mesh, const Net& net) : net_(&net), places_(net.points.positions) {
  std::vector<std::uint32_t> local(static_cast<std::size_t>(mesh.node_count()), nowhere);
  for (std::size_t i = net.node.size(); i-- > 0;)
    local[static_cast<std::size_t>(net.node[i])] = static_cast<std::uint32_t>(i);
  std::vector<Index> face;
  for (const Triangle& triangle : cut_into_triangles(mesh)) {
    std::array<std::uint32_t, 3> nodes{};
    for (std::size_t k = 0; k < 3; ++k) nodes[k] = local[static_cast<std::size_t>(triangle.nodes[k])];
    if (std::find(nodes.begin(), nodes.end(), nowhere) != nodes.end()) continue;
    triangles_.push_back(nodes);
    face.push_back(triangle.face);
  }
  // The faces at each node, and then those at the nodes of these.
  const std::size_t nodes = net.node.size();
  std::vector<std::vector<std::uint32_t>> at(nodes);
  for (std::size_t t = 0; t < triangles_.size(); ++t) {
    end_if_cancelled_at(t);
    for (const Index node : mesh.face(face[t])) {
      const std::uint32_t i = local[static_cast<std::size_t>(node)];
      if (i != nowhere) at[i].push_back(static_cast<std::uint32_t>(t));
    }
  }
  begin_.assign(1, 0);
  std::vector<std::uint32_t> around;
  for (std::size_t i = 0; i < net.moving; ++i) {
    end_if_cancelled_at(i);
    around.clear();
    for (const std::uint32_t t : at[i]) {
      if (at[i].size() > most_faces_around)
        around.push_back(t);
      else
        for (const std::uint32_t j : triangles_[t]) around.insert(around.end(), at[j].begin(), at[j].end());
    }
    std::sort(around.begin(), around.end());
    around.erase(std::unique(around.begin(), around.end()), around.end());
    around_.insert(around_.end(), around.begin(), around.end());
    begin_.push_back(static_cast<std::uint32_t>(around_.size()));
  }
}

HeightOverFace FaceTies::of(std::size_t node, std::uint32_t point) const {
  const Vector3& place = places_[point];
  const Vector3& normal = net_->normals[node];
  // Of nodes without faces: over the tangent plane.
  HeightOverFace nearest{.nodes = {static_cast<std::uint32_t>(node), static_cast<std::uint32_t>(node), 0},
                         .rise = {1, 0, 0},
                         .height = (net_->positions[node] - place).dot(normal)};
  double least = std::numeric_limits<double>::infinity();
  for (std::uint32_t t = begin_[node]; t < begin_[node + 1]; ++t) {
    const auto& nodes = triangles_[around_[t]];
    const std::array<Vector3, 3> corners = {net_->positions[nodes[0]], net_->positions[nodes[1]],
                                            net_->positions[nodes[2]]};
    const std::array<double, 3> shares = nearest_shares(place, corners);
    const Vector3 way = shares[0] * corners[0] + shares[1] * corners[1] + shares[2] * corners[2] - place;
    const double distance = way.norm();
    if (!(distance < least)) continue;
    least = distance;
    Vector3 up = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalized();
    if (distance > net_->tiny) up = way / distance;
    if (up.dot(normal) < 0) up = -up;
    nearest = {.nodes = nodes, .height = way.dot(up)};
    for (std::size_t k = 0; k < 3; ++k) {
      const bool moves = nodes[k] < net_->moving;
      nearest.rise[k] = moves ? shares[k] * up.dot(net_->normals[nodes[k]]) : 0;
    }
  }
  nearest.height -= (net_->points.positions[point] - place).dot(normal);
  return nearest;
}

}  // namespace vspring
