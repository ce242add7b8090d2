#include "vspring/sharp_edges.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <utility>

#include "base/degrees.hpp"
#include "shape/edges.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"
#include "shape/places.hpp"
#include "shape/sharp_edges.hpp"
#include "vspring/error.hpp"

namespace vspring {

SharpEdges chains_of(const PolygonMesh& mesh, MeshEdges edges) {
  // Chains have a copy of all positions.
  if (edges.empty()) return {};
  SharpEdges sharp;
  std::vector<std::uint8_t> count(mesh.positions().size(), 0);
  for (const auto& [a, b] : edges) {
    for (const Index node : {a, b}) {
      std::uint8_t& own = count[static_cast<std::size_t>(node)];
      own = static_cast<std::uint8_t>(std::min(own + 1, 3));
      if (own == 3) sharp.corners.push_back(node);
    }
  }
  std::sort(sharp.corners.begin(), sharp.corners.end());
  sharp.corners.erase(std::unique(sharp.corners.begin(), sharp.corners.end()), sharp.corners.end());
  sharp.chains = PolygonCurve(mesh.positions(), chains_of_segments(edges, mesh.node_count()));
  sharp.edges = std::move(edges);
  return sharp;
}

std::vector<TurningEdge> turning_edges(const PolygonMesh& mesh) {
  std::vector<Vector3> normals;
  normals.reserve(static_cast<std::size_t>(mesh.face_count()));
  for (Index f = 0; f < mesh.face_count(); ++f) normals.push_back(unit_normal(mesh.face(f), mesh.positions()));
  const Incidence incidence(mesh);
  EdgeFinder finder(mesh, incidence);
  std::vector<TurningEdge> turning;
  for (Index node = 0; node < mesh.node_count(); ++node) {
    finder.at_node(node, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour <= node || uses.size() != 2) return;
      const Vector3& a = normals[static_cast<std::size_t>(uses[0].face)];
      Vector3 b = normals[static_cast<std::size_t>(uses[1].face)];
      if (a.isZero(0) || b.isZero(0)) return;
      // Faces that run along it in one direction are oriented in opposite ways.
      if (uses[0].forward == uses[1].forward) b = -b;
      turning.push_back({node, neighbour, uses[0].face, uses[1].face, degrees_between(a, b)});
    });
  }
  return turning;
}

std::vector<Index> nodes_of(const MeshEdges& edges) {
  std::vector<Index> nodes;
  nodes.reserve(2 * edges.size());
  for (const auto& [a, b] : edges) {
    nodes.push_back(a);
    nodes.push_back(b);
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

void check_sharp_angle(double angle) {
  if (!(angle > 0 && angle < 180))
    throw Error(
        ErrorCode::invalid_argument,
        fmt::format("sharp edges turn by more than an angle of more than 0 and less than 180 degrees, not {}", angle));
}

SharpEdges find_sharp_edges(const PolygonMesh& mesh, double angle) {
  check_sharp_angle(angle);
  // The turn of a face without a place is unknown, and the edge may well be sharp.
  for (Index f = 0; f < mesh.face_count(); ++f) require_places(mesh.face(f), mesh.positions());
  MeshEdges edges;
  for (const TurningEdge& edge : turning_edges(mesh)) {
    if (edge.turn > angle) edges.emplace_back(edge.first, edge.second);
  }
  return chains_of(mesh, std::move(edges));
}

SharpEdges as_sharp_edges(const PolygonMesh& mesh, const MeshEdges& given) {
  std::vector<LeftOutEdge> left_out;
  SharpEdges sharp = as_sharp_edges(mesh, given, left_out);
  if (left_out.empty()) return sharp;
  const LeftOutEdge& edge = left_out.front();
  throw Error(ErrorCode::unusable_constraint,
              fmt::format("sharp edge from node {} to node {}: {}", edge.first, edge.second, edge.why));
}

SharpEdges as_sharp_edges(const PolygonMesh& mesh, const MeshEdges& given, std::vector<LeftOutEdge>& left_out) {
  if (given.empty()) return {};
  MeshEdges edges;
  edges.reserve(given.size());
  const Incidence incidence(mesh);
  EdgeFinder finder(mesh, incidence);
  const auto fault_of = [&](Index a, Index b) -> std::string {
    for (const Index node : {a, b}) {
      if (node < 0 || node >= mesh.node_count())
        return fmt::format("there is no node {}, there are {}", node, mesh.node_count());
    }
    std::size_t faces = 0;
    finder.at_node(a, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (neighbour == b && neighbour != a) faces = uses.size();
    });
    if (faces == 0) return "no face has this edge";
    if (faces == 1) return "it is part of the boundary, where no other face meets it";
    return faces == 2 ? "" : fmt::format("{} faces meet there, which are parted without that", faces);
  };
  for (const auto& [a, b] : given) {
    std::string fault = fault_of(a, b);
    if (fault.empty())
      edges.emplace_back(std::minmax(a, b));
    else
      left_out.push_back({a, b, std::move(fault)});
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return chains_of(mesh, std::move(edges));
}

std::vector<double> chain_lengths(const PolygonCurve& curve) {
  std::vector<double> lengths;
  lengths.reserve(curve.chains().size());
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    double length = 0;
    for (std::size_t k = chain.closed ? 0 : 1; k < count; ++k)
      length += (curve.position(chain.nodes[k]) - curve.position(chain.nodes[(k + count - 1) % count])).stableNorm();
    lengths.push_back(length);
  }
  return lengths;
}

}  // namespace vspring
