#pragma once

// Surfaces to fair, of every kind of face and disorder, for the benchmark of that name and, small ones, for tests.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "support/surfaces.hpp"

namespace vspring::support {

struct Specimen {
  std::string name;
  PolygonMesh start;
  Constraints constraints;
  /// None: the default.
  std::optional<Distribution> distribution = std::nullopt;
  /// Distance of a point from the equilibrium's surface, if that has a closed form; else null.
  std::function<double(const Vector3&)> distance = nullptr;
  /// Known to end at another shape or not to converge.
  bool hard = false;
};

inline std::string name_of(generate::Faces faces) {
  switch (faces) {
    case generate::Faces::triangles:
      return "triangles";
    case generate::Faces::quads:
      return "quads";
    case generate::Faces::mixed:
      return "mixed";
    case generate::Faces::hexagons:
      return "hexagons";
  }
  return "";
}

/// Maps 0 to 0 and 1 to 1; of equal steps the last becomes about `ratio` times as long as the first.
inline double graded(double s, double ratio) { return ratio == 1 ? s : std::expm1(s * std::log(ratio)) / (ratio - 1); }

/// A point of a surface over a strip: along and around 0 to 1, `lift` above it.
using Chart = std::function<Vector3(double along, double around, double lift)>;

/// The funnel from radius 1 at z = 0 to 0.35 at z = 0.5, straight; it closes after one turn.
inline Vector3 funnel_chart(double along, double around, double lift) {
  const double radius = 1 - 0.65 * along;
  const double angle = 2 * std::numbers::pi * around;
  return {radius * std::cos(angle), radius * std::sin(angle), 0.5 * along + lift};
}

/// A square part of the unit sphere about its pole, by stereographic projection.
inline Vector3 sphere_chart(double along, double around, double lift) {
  const Vector3 flat(0.8 * along - 0.4, 0.8 * around - 0.4, 0);
  const double square = flat.squaredNorm();
  return (1 + lift) / (1 + square) * Vector3(2 * flat.x(), 2 * flat.y(), 1 - square);
}

/// 120° of a cylinder of radius 1 and height 2.
inline Vector3 cylinder_chart(double along, double around, double lift) {
  const double angle = 120 * degree * (along - 0.5);
  return {(1 + lift) * std::cos(angle), (1 + lift) * std::sin(angle), 2 * around};
}

/// The band of the unit sphere from 35° to 70° off its pole; it closes after one turn.
inline Vector3 band_chart(double along, double around, double lift) {
  const double off_pole = (35 + 35 * along) * degree;
  const double angle = 2 * std::numbers::pi * around;
  return (1 + lift) *
         Vector3(std::sin(off_pole) * std::cos(angle), std::sin(off_pole) * std::sin(angle), std::cos(off_pole));
}

/// A flat ring of radii 0.5 and 1.5.
inline Vector3 ring_chart(double along, double around, double lift) {
  const double angle = 2 * std::numbers::pi * around;
  return {(0.5 + along) * std::cos(angle), (0.5 + along) * std::sin(angle), lift};
}

/// A shape of revolution, as a lathe makes them: radius and height along its profile; it closes after one turn.
inline Vector3 turned(double radius, double height, double around) {
  const double angle = 2 * std::numbers::pi * around;
  return {radius * std::cos(angle), radius * std::sin(angle), height};
}

inline Vector3 cone_chart(double along, double around, double lift) {
  return turned(0.3 + 0.7 * along + lift, 1.5 * along, around);
}

inline Vector3 bell_chart(double along, double around, double lift) {
  return turned(0.3 + 0.7 * along * along + lift, 1 - along, around);
}

inline Vector3 vase_chart(double along, double around, double lift) {
  return turned(0.6 + 0.3 * std::sin(2 * std::numbers::pi * along) + lift, 2 * along, around);
}

/// Normals of a shape of revolution, from its profile's normals: their parts away from the axis and along it at a
/// height.
inline Normal turned_normal(const std::function<std::pair<double, double>(double)>& of_profile) {
  return [=](const Vector3& p) {
    const auto [outwards, up] = of_profile(p.z());
    return Vector3(outwards * p.x() / p.head<2>().norm(), outwards * p.y() / p.head<2>().norm(), up);
  };
}

struct Disorder {
  double jitter = 0;  ///< of a cell
  double noise = 0;   ///< a length
  double ratio = 1;   ///< of the longest cell along the surface to the shortest
};

/// A grid on a chart, lifted in its middle: a start, with its boundary held.
inline Specimen on_chart(const std::string& name, const Chart& chart, bool closes, generate::Grid grid,
                         const Disorder& disorder, const Normal& normal) {
  grid.jitter = disorder.jitter;
  // Columns run around.
  const PolygonMesh flat = closes ? generate::tube(grid, 1, 1) : generate::plane(grid);
  std::vector<Vector3> exact;
  std::vector<Vector3> lifted;
  for (const Vector3& p : flat.positions()) {
    const double place = closes ? p.z() : p.y();
    const double around = closes ? std::atan2(p.y(), p.x()) / (2 * std::numbers::pi) : p.x();
    const double along = graded(place, disorder.ratio);
    const double middle = std::sin(std::numbers::pi * along) * (closes ? 1 : std::sin(std::numbers::pi * around));
    exact.push_back(chart(along, around, 0));
    lifted.push_back(chart(along, around, 0.2 * middle));
  }
  return {name, generate::add_noise(with_positions(flat, std::move(lifted)), disorder.noise, 3),
          held_boundary(with_positions(flat, std::move(exact)), normal)};
}

/// Holds every step-th node in its place.
inline Constraints every_so_many(const PolygonMesh& mesh, Index step) {
  Constraints constraints(mesh.node_count());
  for (Index i = 0; i < mesh.node_count(); i += step) constraints.fix_position(i, mesh.position(i));
  return constraints;
}

/// The middle of a jittered saddle, the rest held.
inline Specimen region_of_saddle(generate::Faces faces, int cells) {
  const PolygonMesh mesh = generate::saddle({.columns = cells, .rows = cells, .faces = faces, .jitter = 0.5}, 2);
  std::vector<Index> region;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (mesh.position(i).head<2>().norm() < 0.6) region.push_back(i);
  }
  Constraints constraints(mesh.node_count());
  restrict_to_region(constraints, mesh, region);
  return {fmt::format("region of a saddle of {}", name_of(faces)), mesh, constraints};
}

/// The shape of polygon_patch() as a cap of 60° of the unit sphere.
inline PolygonMesh polygon_cap(int sides, int rings) {
  PolygonMesh patch = generate::polygon_patch({.sides = sides, .rings = rings, .half_angle = 60});
  std::vector<Vector3> about_origin = patch.positions();
  for (Vector3& p : about_origin) p = std::sin(60 * degree) * p + Vector3(0, 0, std::cos(60 * degree));
  return with_positions(std::move(patch), std::move(about_origin));
}

/// Shapes of about cells² nodes. cells: a multiple of 4.
inline std::vector<Specimen> specimens(int cells) {
  using generate::Faces;
  const Index nodes = cells * cells;
  const double spacing = 1.0 / cells;
  const Normal up = [](const Vector3&) { return Vector3::UnitZ(); };
  const Normal from_axis = [](const Vector3& p) { return Vector3(p.x(), p.y(), 0); };
  const auto off_sphere = [](const Vector3& p) { return std::abs(p.norm() - 1); };
  const auto off_cylinder = [](const Vector3& p) { return std::abs(p.head<2>().norm() - 1); };
  const std::pair<std::string, Disorder> disorders[] = {
      {"", {}}, {", jittered", {.jitter = 0.4}}, {", noisy", {.noise = spacing}}, {", graded 100 : 1", {.ratio = 100}}};
  const std::tuple<const char*, Chart, std::function<std::pair<double, double>(double)>> lathe_shapes[] = {
      {"cone", cone_chart, [](double) { return std::pair(1.5, -0.7); }},
      {"bell", bell_chart, [](double z) { return std::pair(1.0, 1.4 * (1 - z)); }},
      {"vase", vase_chart,
       [](double z) { return std::pair(2.0, -0.6 * std::numbers::pi * std::cos(std::numbers::pi * z)); }}};
  std::vector<Specimen> all;
  const auto add = [&](const std::string& name, const PolygonMesh& start, const Constraints& constraints) {
    all.push_back({name, start, constraints});
  };
  for (const Faces faces : every_kind) {
    for (const auto& [words, disorder] : disorders) {
      // Not every compiler lets a lambda capture a structured binding.
      const auto name = [&, &suffix = words](const char* shape) {
        return fmt::format("{} of {}{}", shape, name_of(faces), suffix);
      };
      const generate::Grid grid{.columns = cells, .rows = cells, .faces = faces};
      all.push_back(on_chart(name("sphere"), sphere_chart, false, grid, disorder, radial));
      all.back().distance = off_sphere;
      // Bricks are hardly held across their rows, the less the longer they are.
      all.back().hard = faces == Faces::hexagons && disorder.ratio > 1;
      all.push_back(on_chart(name("cylinder"), cylinder_chart, false, grid, disorder, from_axis));
      all.back().distance = off_cylinder;
      all.back().hard = faces == Faces::hexagons && disorder.ratio > 1;
      const generate::Grid rings{.columns = 2 * cells, .rows = cells / 2, .faces = faces};
      all.push_back(on_chart(name("funnel"), funnel_chart, true, rings, disorder, up));
    }
    Specimen kept = on_chart(fmt::format("sphere of {}, graded 100 : 1, kept", name_of(faces)), sphere_chart, false,
                             {.columns = cells, .rows = cells, .faces = faces}, {.ratio = 100}, radial);
    kept.distribution = Distribution::keep;
    kept.distance = off_sphere;
    // Nodes of bricks lie on a line with two of their three neighbours, so they are hardly held across it.
    kept.hard = faces == Faces::mixed || faces == Faces::hexagons;
    all.push_back(std::move(kept));
    all.push_back(region_of_saddle(faces, cells));
  }
  for (const Faces faces : {Faces::triangles, Faces::quads}) {
    // Cells up to six times as wide as high: with evenly spread nodes the shape would sink towards the axis.
    const generate::Grid rings{.columns = 3 * cells / 2, .rows = cells, .faces = faces};
    for (const auto& [words, disorder] : {std::pair<const char*, Disorder>("", {}),
                                          {", noisy", {.noise = 0.3 * spacing}},
                                          {", graded 10 : 1", {.ratio = 10}}}) {
      all.push_back(on_chart(fmt::format("band in rings of {}{}", name_of(faces), words), band_chart, true, rings,
                             disorder, radial));
      all.back().distance = off_sphere;
      all.push_back(
          on_chart(fmt::format("flat rings of {}{}", name_of(faces), words), ring_chart, true, rings, disorder, up));
      all.back().distance = [](const Vector3& p) { return std::abs(p.z()); };
      for (const auto& [shape, chart, normal] : lathe_shapes)
        all.push_back(on_chart(fmt::format("{} in rings of {}{}", shape, name_of(faces), words), chart, true, rings,
                               disorder, turned_normal(normal)));
    }
  }
  for (const int sides : {5, 12}) {
    const PolygonMesh polygon = polygon_cap(sides, cells / 4);
    add(fmt::format("polygon of {} sides amid {} rings", sides, cells / 4), pressed(polygon, 0.5),
        held_boundary(polygon, radial));
    all.back().distance = off_sphere;
    // Its quads shrink towards the middle by a factor for each ring.
    all.back().hard = sides == 12;
  }
  const PolygonMesh cap = generate::cap({.nodes = nodes, .jitter = 0.3});
  for (const double noise : {0.0, 0.02}) {
    const std::string words = noise > 0 ? ", noisy" : "";
    add("cap of 60° from flat" + words, flattened(cap, 60, noise), held_boundary(cap, radial));
    all.back().distance = off_sphere;
    const PolygonMesh polygons = projected(dual(cap));
    add("cap of n-gons from flat" + words, flattened(polygons, 60, noise), held_boundary(polygons, radial));
    all.back().distance = off_sphere;
    const PolygonMesh annulus = generate::annulus({.nodes = nodes});
    add("annulus with corners" + words, generate::add_noise(annulus, noise, 3), clamped_boundary(annulus));
    for (const Faces faces : {Faces::quads, Faces::triangles}) {
      const PolygonMesh pipes = generate::pipe_blend({.cells = std::max(4, cells / 5), .faces = faces});
      add(fmt::format("blend of pipes of {}{}", name_of(faces), words), generate::add_noise(pipes, noise, 3),
          clamped_boundary(pipes));
    }
    const PolygonMesh block = generate::genus({.holes = 3, .cells = std::max(3, cells / 8)});
    add("genus 3, every 5th node held" + words, generate::add_noise(block, noise, 3), every_so_many(block, 5));
    add("genus 3, every 20th node held" + words, generate::add_noise(block, noise, 3), every_so_many(block, 20));
    add("genus 3, every 80th node held" + words, generate::add_noise(block, noise, 3), every_so_many(block, 80));
    all.back().hard = true;
    add("cap of 60° from flat, kept" + words, flattened(cap, 60, noise), held_boundary(cap, radial));
    all.back().distance = off_sphere;
    all.back().distribution = Distribution::keep;
    all.back().hard = noise > 0;
  }
  return all;
}

}  // namespace vspring::support
