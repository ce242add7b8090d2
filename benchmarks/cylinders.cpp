// How far the equilibrium is from a cylinder whose boundary it is held by, positions and normals, on meshes of many
// kinds, refined: 120° of radius 1, 2 high, lifted by a fifth in the middle. Prints a table; docs/notes/springs.md has
// a part.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "support/specimens.hpp"

namespace {

using namespace vspring;
using namespace support;
using generate::Faces;

constexpr double tolerance = 1e-9;

struct Kind {
  std::string name;
  std::function<Specimen(int cells)> make;
};

Vector3 from_axis(const Vector3& p) { return {p.x(), p.y(), 0}; }

Kind grid(const std::string& name, Faces faces, const Disorder& disorder = {},
          std::optional<Distribution> distribution = {}) {
  return {name, [=](int cells) {
            Specimen specimen = on_chart("", cylinder_chart, false, {.columns = cells, .rows = cells, .faces = faces},
                                         disorder, from_axis);
            specimen.distribution = distribution;
            return specimen;
          }};
}

/// A disc rolled up, of about cells² nodes.
Kind disc(const std::string& name, double jitter, bool polygons, std::optional<Distribution> distribution = {}) {
  return {name, [=](int cells) {
            PolygonMesh flat = generate::flat_disc({.nodes = cells * cells, .jitter = jitter});
            if (polygons) flat = dual(flat);
            std::vector<Vector3> exact;
            std::vector<Vector3> lifted;
            for (const Vector3& p : flat.positions()) {
              const Vector3 place = cylinder_chart(0.5 + 0.5 * p.x(), 0.5 + 0.5 * p.y(), 0);
              const double lift = 0.2 * std::max(0.0, 1 - p.squaredNorm());
              exact.push_back(place);
              lifted.push_back(cylinder_chart(0.5 + 0.5 * p.x(), 0.5 + 0.5 * p.y(), lift));
            }
            Specimen specimen{"", with_positions(flat, std::move(lifted)),
                              held_boundary(with_positions(flat, std::move(exact)), from_axis)};
            specimen.distribution = distribution;
            return specimen;
          }};
}

/// The greatest distance of a node from the cylinder; or the outcome where it is no equilibrium of such springs.
std::string error_of(const Specimen& specimen, Springs springs) {
  FairOptions options;
  options.springs = springs;
  options.method = EquilibriumMethod{.tolerance = tolerance};
  options.distribution = specimen.distribution;
  const FairResult result = fair(specimen.start, specimen.constraints, options);
  double greatest = 0;
  for (const Vector3& p : result.positions) greatest = std::max(greatest, std::abs(p.head<2>().norm() - 1));
  if (result.report.outcome != Outcome::converged) return fmt::format("{}", name(result.report.outcome));
  return fmt::format("{:.1e}{}", greatest, result.report.springs == springs ? "" : " by edge springs");
}

}  // namespace

int main() {
  const std::vector<Kind> kinds = {
      grid("triangles", Faces::triangles, {}, Distribution::even),
      grid("quads", Faces::quads, {}, Distribution::even),
      grid("mixed", Faces::mixed),
      grid("bricks", Faces::hexagons),
      disc("n-gons around the nodes of a disc", 0, true),
      disc("triangles of a disc", 0, false),
      disc("triangles of a disc, jittered, kept", 0.3, false, Distribution::keep),
      grid("triangles, jittered, kept", Faces::triangles, {.jitter = 0.3}, Distribution::keep),
      grid("quads, jittered, kept", Faces::quads, {.jitter = 0.3}, Distribution::keep),
      grid("triangles, graded 10 : 1, kept", Faces::triangles, {.ratio = 10}, Distribution::keep),
      grid("quads, graded 10 : 1, kept", Faces::quads, {.ratio = 10}, Distribution::keep)};
  fmt::print("| mesh | edge springs: 12, 24, 48 cells | sphere springs: 12, 24, 48 cells |\n|---|---|---|\n");
  for (const Kind& kind : kinds) {
    fmt::print("| {} |", kind.name);
    for (const Springs springs : {Springs::edge, Springs::sphere}) {
      std::string errors;
      for (const int cells : {12, 24, 48}) errors += (errors.empty() ? "" : ", ") + error_of(kind.make(cells), springs);
      fmt::print(" {} |", errors);
    }
    fmt::print("\n");
    std::fflush(stdout);
  }
  return 0;
}
