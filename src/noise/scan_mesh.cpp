#include "noise/scan_mesh.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "base/cancellation.hpp"
#include "shape/face_geometry.hpp"
#include "shape/turned_faces.hpp"

namespace vspring {

namespace {

// Around a hub of many faces all faces are neighbours of each other.
constexpr std::size_t most_faces = 64;
constexpr std::uint32_t absent = ~std::uint32_t{0};

void sort_and_close(Lists& lists) {
  const auto first = lists.items.begin() + lists.begin.back();
  std::sort(first, lists.items.end());
  lists.items.erase(std::unique(first, lists.items.end()), lists.items.end());
  lists.close();
}

}  // namespace

ScanMesh scan_mesh(const Net& net, const PolygonMesh& mesh) {
  ScanMesh scan;
  scan.nodes = net.positions.size();
  scan.moving = net.moving;
  for (std::size_t i = 0; i < net.moving; ++i) {
    end_if_cancelled_at(i);
    for (const Link link : net.rings.links(i)) {
      if (link.spoke()) scan.neighbours.items.push_back(static_cast<std::uint32_t>(link.node()));
    }
    sort_and_close(scan.neighbours);
    for (const std::uint32_t j : scan.neighbours.of(i)) {
      if (j < net.moving) scan.moving_neighbours.items.push_back(j);
    }
    scan.moving_neighbours.close();
  }
  std::vector<std::uint32_t> local(static_cast<std::size_t>(mesh.node_count()), absent);
  for (std::size_t i = 0; i < scan.nodes; ++i)
    local[static_cast<std::size_t>(net.node[i])] = static_cast<std::uint32_t>(i);
  const auto moves = [&](Index node) { return local[static_cast<std::size_t>(node)] < net.moving; };
  const std::vector<std::uint8_t> turned = turned_faces(mesh);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    if (std::none_of(face.begin(), face.end(), moves)) continue;
    for (const Index node : face) scan.faces.items.push_back(local[static_cast<std::size_t>(node)]);
    if (turned[static_cast<std::size_t>(f)] != 0)
      std::reverse(scan.faces.items.begin() + scan.faces.begin.back(), scan.faces.items.end());
    scan.faces.close();
  }
  // A counting sort.
  scan.faces_of.begin.assign(net.moving + 1, 0);
  for (const std::uint32_t i : scan.faces.items) {
    if (i < net.moving) ++scan.faces_of.begin[i + 1];
  }
  for (std::size_t i = 0; i < net.moving; ++i) scan.faces_of.begin[i + 1] += scan.faces_of.begin[i];
  scan.faces_of.items.resize(scan.faces_of.begin.back());
  std::vector<std::uint32_t> next(scan.faces_of.begin.begin(), scan.faces_of.begin.end() - 1);
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    end_if_cancelled_at(f);
    for (const std::uint32_t i : scan.faces.of(f)) {
      if (i < net.moving) scan.faces_of.items[next[i]++] = static_cast<std::uint32_t>(f);
    }
  }
  for (std::size_t f = 0; f < scan.faces.size(); ++f) {
    end_if_cancelled_at(f);
    scan.around.items.push_back(static_cast<std::uint32_t>(f));
    for (const std::uint32_t i : scan.faces.of(f)) {
      if (i >= net.moving || scan.faces_of.of(i).size() > most_faces) continue;
      const auto faces = scan.faces_of.of(i);
      scan.around.items.insert(scan.around.items.end(), faces.begin(), faces.end());
    }
    sort_and_close(scan.around);
  }
  return scan;
}

std::vector<Vector3> face_areas(const ScanMesh& mesh, const std::vector<Vector3>& places, ThreadTeam& team) {
  std::vector<Vector3> areas(mesh.faces.size(), Vector3::Zero());
  parallel_ranges(team, areas.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) areas[f] = twice_vector_area(mesh.faces.of(f), places) / 2;
  });
  return areas;
}

std::vector<Vector3> node_normals(const ScanMesh& mesh, const std::vector<Vector3>& places, ThreadTeam& team) {
  const std::vector<Vector3> areas = face_areas(mesh, places, team);
  std::vector<Vector3> normals(mesh.moving, Vector3::Zero());
  parallel_ranges(team, mesh.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      for (const std::uint32_t f : mesh.faces_of.of(i)) normals[i] += areas[f];
      normals[i].stableNormalize();
    }
  });
  return normals;
}

}  // namespace vspring
