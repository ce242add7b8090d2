#pragma once

// Shared by tests and benchmarks of surfaces: constraints of boundaries, starts, and distances from spheres.

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <utility>
#include <vector>

#include "support/positions.hpp"
#include "vspring/vspring.hpp"

namespace vspring::support {

constexpr generate::Faces every_kind[] = {generate::Faces::triangles, generate::Faces::quads, generate::Faces::mixed,
                                          generate::Faces::hexagons};

using Normal = std::function<Vector3(const Vector3&)>;

/// The normal of the unit sphere.
inline Vector3 radial(const Vector3& p) { return p.normalized(); }

/// The nodes of the boundary, ascending.
inline std::vector<Index> boundary_of(const PolygonMesh& mesh) {
  std::vector<Index> nodes;
  const std::vector<std::uint8_t> is_of_boundary = boundary_nodes(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (is_of_boundary[static_cast<std::size_t>(i)] != 0) nodes.push_back(i);
  }
  return nodes;
}

/// Holds boundary positions, and normals if a rule is given.
inline Constraints held_boundary(const PolygonMesh& mesh, const Normal& normal = nullptr) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  for (Index i = 0; i < mesh.node_count() && normal; ++i) {
    if (constraints.position_fixed(i)) constraints.fix_normal(i, normal(mesh.position(i)));
  }
  return constraints;
}

/// Holds boundary positions and the normals of the mesh there.
inline Constraints clamped_boundary(const PolygonMesh& mesh) {
  Constraints constraints = held_boundary(mesh);
  fix_boundary_normals(constraints, mesh);
  return constraints;
}

/// Of triangles: part of a torus of radius 1 about the axis along z.
inline PolygonMesh bent_tube(int columns, int rows, double thickness, double angle) {
  PolygonMesh tube =
      generate::tube({.columns = columns, .rows = rows, .faces = generate::Faces::triangles}, thickness, angle);
  std::vector<Vector3> bent;
  for (const Vector3& p : tube.positions())
    bent.emplace_back((1 + p.x()) * std::cos(p.z()), (1 + p.x()) * std::sin(p.z()), p.y());
  tube.set_positions(std::move(bent));
  return tube;
}

inline double diagonal(const PolygonMesh& mesh) { return diagonal(mesh.positions()); }

/// The diagonal of the box around the faces with a moving node: the unit of expected errors.
inline double diagonal(const PolygonMesh& mesh, const Constraints& constraints) {
  std::vector<Vector3> around;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::all_of(face.begin(), face.end(), [&](Index node) { return constraints.position_fixed(node); })) continue;
    for (const Index node : face) around.push_back(mesh.position(node));
  }
  return diagonal(around);
}

inline double distance_from_unit_sphere(const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& position : positions) greatest = std::max(greatest, std::abs(position.norm() - 1));
  return greatest;
}

inline PolygonMesh with_positions(PolygonMesh mesh, std::vector<Vector3> positions) {
  mesh.set_positions(std::move(positions));
  return mesh;
}

/// Moves every node onto the unit sphere.
inline PolygonMesh projected(PolygonMesh mesh) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position.normalize();
  return with_positions(std::move(mesh), std::move(positions));
}

/// A closed unit sphere of quads: a block of three cubes, with `cells` of them along each edge of a cube, projected.
inline PolygonMesh closed_sphere(Index cells) { return projected(generate::genus({.holes = 0, .cells = cells})); }

/// The mesh with every face cut into triangles from its first node.
inline PolygonMesh in_triangles(const PolygonMesh& mesh) {
  MeshBuilder builder;
  for (const Vector3& p : mesh.positions()) builder.add_node(p);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 2; k < face.size(); ++k) builder.add_face({face[0], face[k - 1], face[k]});
  }
  return builder.take();
}

/// Moves all nodes to one height.
inline PolygonMesh pressed(PolygonMesh mesh, double height) {
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position.z() = height;
  return with_positions(std::move(mesh), std::move(positions));
}

/// A cap of the unit sphere pressed flat at the height of its rim, with noise of that length inside. Angles along
/// meridians become radii, so nothing folds.
inline PolygonMesh flattened(PolygonMesh cap, double half_angle, double noise) {
  const double rim = half_angle * degree;
  std::vector<Vector3> flat = cap.positions();
  for (Vector3& p : flat) {
    const double radius = std::hypot(p.x(), p.y());
    const double scale = radius > 0 ? std::atan2(radius, p.z()) / rim * std::sin(rim) / radius : 0;
    p = Vector3(scale * p.x(), scale * p.y(), std::cos(rim));
  }
  return generate::add_noise(with_positions(std::move(cap), std::move(flat)), noise, 5);
}

/// The polygons around the inner nodes of a mesh of triangles: n-gons of as many sides as nodes have neighbours, with a
/// node for every triangle that has a node inside.
inline PolygonMesh dual(const PolygonMesh& triangles) {
  const std::vector<std::uint8_t> boundary = boundary_nodes(triangles);
  std::map<std::pair<Index, Index>, Index> face_left_of;
  MeshBuilder builder;
  std::vector<Index> number(static_cast<std::size_t>(triangles.face_count()), -1);
  for (Index f = 0; f < triangles.face_count(); ++f) {
    const auto face = triangles.face(f);
    Vector3 centre = Vector3::Zero();
    bool inner = false;
    for (std::size_t k = 0; k < 3; ++k) {
      face_left_of[{face[k], face[(k + 1) % 3]}] = f;
      centre += triangles.position(face[k]) / 3;
      inner = inner || boundary[static_cast<std::size_t>(face[k])] == 0;
    }
    if (inner) number[static_cast<std::size_t>(f)] = builder.add_node(centre);
  }
  std::vector<std::uint8_t> done = boundary;
  for (Index f = 0; f < triangles.face_count(); ++f) {
    for (const Index node : triangles.face(f)) {
      if (done[static_cast<std::size_t>(node)]++ != 0) continue;
      std::vector<Index> around;
      Index at = f;
      do {
        around.push_back(number[static_cast<std::size_t>(at)]);
        const auto face = triangles.face(at);
        const auto k = static_cast<std::size_t>(std::find(face.begin(), face.end(), node) - face.begin());
        at = face_left_of.at({node, face[(k + 2) % 3]});
      } while (at != f);
      builder.add_face(around);
    }
  }
  return builder.take();
}

}  // namespace vspring::support
