// The V-cycle under refinement: how far its results are from the equilibrium with the paper's e = 0.001 at every size,
// and with e lowered as the fourth power of the spacing; and how far the equilibrium is from the closed form.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;
using namespace support;

struct Problem {
  PolygonMesh start;
  Constraints constraints;
};

struct Shape {
  std::string name;
  std::function<Problem(int halvings)> make;
  /// Distance of a point from the closed form; null where there is none.
  std::function<double(const Vector3&)> distance;
};

Problem held(const PolygonMesh& exact, const std::function<Vector3(const Vector3&)>& start) {
  Problem problem{exact, clamped_boundary(exact)};
  std::vector<Vector3> positions = exact.positions();
  for (Vector3& position : positions) position = start(position);
  problem.start.set_positions(std::move(positions));
  return problem;
}

std::vector<Shape> shapes() {
  return {{"cap of 60°, from flat",
           [](int halvings) {
             const Index nodes[] = {127, 469, 1801, 7057};
             return held(generate::cap({.nodes = nodes[halvings], .radius = 1, .half_angle = 60}),
                         [](const Vector3& p) { return Vector3(p.x(), p.y(), 0.5); });
           },
           [](const Vector3& p) { return std::abs(p.norm() - 1); }},
          {"cylinder of 120°, from flat",
           [](int halvings) {
             const Index cells = 10 << halvings;
             return held(
                 generate::cylinder_patch(
                     {.columns = cells, .rows = cells, .faces = generate::Faces::triangles, .jitter = 0.2}, 1, 120, 2),
                 [](const Vector3& p) { return Vector3(0.5, p.y(), p.z()); });
           },
           [](const Vector3& p) { return std::abs(p.head<2>().norm() - 1); }},
          {"funnel",
           [](int halvings) {
             const Index nodes[] = {127, 469, 1801, 7057};
             const PolygonMesh funnel = generate::funnel(nodes[halvings]);
             return Problem{funnel, held_boundary(funnel, [](const Vector3&) { return Vector3::UnitZ(); })};
           },
           nullptr}};
}

}  // namespace

int main() {
  fmt::print(
      "| shape | nodes | e | iterations on the finest level | from the equilibrium | from the closed form | "
      "equilibrium from the closed form |\n|---|---|---|---|---|---|---|\n");
  for (const Shape& shape : shapes()) {
    for (int halvings = 0; halvings < 4; ++halvings) {
      const Problem problem = shape.make(halvings);
      const FairOptions to_equilibrium = {
          .method = equilibrium_alone(1e-8), .springs = Springs::edge, .distribution = Distribution::even};
      const FairResult equilibrium = fair(problem.start, problem.constraints, to_equilibrium);
      const auto from_closed_form = [&](const std::vector<Vector3>& positions) {
        if (!shape.distance) return std::string();
        double greatest = 0;
        for (const Vector3& position : positions) greatest = std::max(greatest, shape.distance(position));
        return fmt::format("{:.1e}", greatest);
      };
      const double lowered = 1e-3 * std::pow(0.5, 4 * halvings);
      for (const double e : {1e-3, lowered}) {
        if (halvings == 0 && e != lowered) continue;
        const FairOptions by_cycle = {
            .method = MultigridMethod{.step_tolerance = e, .max_iterations = 200'000, .levels = 6},
            .springs = Springs::edge,
            .distribution = Distribution::even};
        const FairResult result = fair(problem.start, problem.constraints, by_cycle);
        fmt::print("| {} | {} | {:.1e} | {} | {:.1e} | {} | {} |\n", shape.name, problem.start.node_count(), e,
                   result.report.levels.back().iterations, greatest_distance(result.positions, equilibrium.positions),
                   from_closed_form(result.positions), from_closed_form(equilibrium.positions));
        std::fflush(stdout);
        if (halvings == 0) break;
      }
    }
  }
}
