#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "vspring/generate.hpp"

namespace vspring::zoo {

using generate::Faces;

struct Shape {
  std::string name;
  PolygonMesh mesh;
};

/// Side by side in one mesh.
inline PolygonMesh together(const std::vector<PolygonMesh>& meshes) {
  MeshBuilder builder;
  Index first = 0;
  for (const PolygonMesh& mesh : meshes) {
    for (const Vector3& position : mesh.positions()) builder.add_node(position);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      std::vector<Index> face(mesh.face(f).begin(), mesh.face(f).end());
      for (Index& node : face) node += first;
      builder.add_face(face);
    }
    first += mesh.node_count();
  }
  return builder.take();
}

/// A one-sided band of quads, with one boundary loop.
inline PolygonMesh moebius_strip(int columns, int rows) {
  MeshBuilder builder;
  const double pi = 3.14159265358979323846;
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      const double angle = 2 * pi * c / columns;
      const double across = (2.0 * r / (rows - 1) - 1) * 0.4;
      const double distance = 1 + across * std::cos(angle / 2);
      builder.add_node({distance * std::cos(angle), distance * std::sin(angle), across * std::sin(angle / 2)});
    }
  }
  const auto node = [&](int c, int r) { return c < columns ? c * rows + r : rows - 1 - r; };
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r + 1 < rows; ++r)
      builder.add_face({node(c, r), node(c + 1, r), node(c + 1, r + 1), node(c, r + 1)});
  }
  return builder.take();
}

/// A double cone: two nodes with as many neighbours as the belt between them.
inline PolygonMesh double_cone(int belt) {
  MeshBuilder builder;
  builder.add_node({0, 0, 1});
  builder.add_node({0, 0, -1});
  for (int k = 0; k < belt; ++k)
    builder.add_node({std::cos(6.283185307179586 * k / belt), std::sin(6.283185307179586 * k / belt), 0});
  for (int k = 0; k < belt; ++k) {
    const Index a = 2 + k;
    const Index b = 2 + (k + 1) % belt;
    builder.add_face({0, a, b});
    builder.add_face({1, b, a});
  }
  return builder.take();
}

/// Surfaces without a defect, of every topology and kind of polygon.
inline std::vector<Shape> surfaces() {
  std::vector<Shape> all = {{"cap", generate::cap({.nodes = 2000})},
                            {"disc", generate::flat_disc({.nodes = 1000, .jitter = 0.4})},
                            {"annulus", generate::annulus({.nodes = 1610})},
                            {"genus 3", generate::genus({.holes = 3, .cells = 5})},
                            {"cube", generate::genus({.holes = 0, .cells = 4})},
                            {"pipes", generate::pipe_blend({.cells = 8})},
                            {"pentagon", generate::polygon_patch({.sides = 5, .rings = 12})},
                            {"polygon of 100 sides", generate::polygon_patch({.sides = 100, .rings = 10})},
                            {"Moebius strip", moebius_strip(60, 9)},
                            {"double cone", double_cone(300)},
                            {"small disc", generate::flat_disc({.nodes = 7})}};
  for (const Faces faces : {Faces::triangles, Faces::quads, Faces::mixed, Faces::hexagons}) {
    const std::string kind = ", faces " + std::to_string(static_cast<int>(faces));
    all.push_back({"sphere patch" + kind, generate::sphere_patch({.columns = 40, .rows = 32, .faces = faces})});
    all.push_back({"torus" + kind, generate::torus({.columns = 48, .rows = 20, .faces = faces})});
    all.push_back({"tube" + kind, generate::tube({.columns = 24, .rows = 40, .faces = faces})});
  }
  all.push_back({"several", together({all[0].mesh, all[2].mesh, all[3].mesh, all[10].mesh})});
  return all;
}

}  // namespace vspring::zoo
