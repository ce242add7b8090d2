// What the rules of a curve's model cost where the spacing of nodes is kept uneven: largest distance of a node from the
// clothoid between the same end tangents, relative to the chord.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "support/clothoid.hpp"
#include "vspring/vspring.hpp"

namespace {

using namespace vspring;

struct Spacing {
  std::string name;
  /// Length of edge k of `edges`, up to a factor.
  std::function<double(std::size_t k, std::size_t edges)> length;
};

std::vector<Spacing> spacings() {
  return {{"even", [](std::size_t, std::size_t) { return 1.0; }},
          {"random, 0.5 to 1.5",
           [](std::size_t k, std::size_t edges) {
             Random random(1000 * edges + k);
             return 0.5 + random.uniform();
           }},
          {"alternating 1 : 2", [](std::size_t k, std::size_t) { return k % 2 == 0 ? 1.0 : 2.0; }},
          {"graded 100 : 1",
           [](std::size_t k, std::size_t edges) {
             return std::pow(100.0, static_cast<double>(k) / static_cast<double>(edges - 1));
           }},
          {"a jump to a third", [](std::size_t k, std::size_t edges) { return 2 * k < edges ? 3.0 : 1.0; }}};
}

struct Choice {
  std::string name;
  CurveRules rules;
  Forces forces = Forces::steady;
};

/// Largest distance from the clothoid; below 0 where the solver did not converge.
double error(const Spacing& spacing, std::size_t edges, const Choice& choice) {
  std::vector<Vector3> positions = {Vector3::Zero()};
  for (std::size_t k = 0; k < edges; ++k)
    positions.emplace_back(positions.back() + Vector3(spacing.length(k, edges), 0, 0));
  const double length = positions.back().x();
  for (Vector3& position : positions) position /= length;
  const double start = 1.0;
  const double end = 0.2;
  const PolygonCurve curve(positions);
  Constraints constraints(curve.node_count());
  fix_boundary_positions(constraints, curve);
  constraints.fix_tangent(0, Vector3(std::cos(start), std::sin(start), 0));
  constraints.fix_tangent(curve.node_count() - 1, Vector3(std::cos(end), std::sin(end), 0));
  FairOptions options;
  options.curve = choice.rules;
  options.forces = choice.forces;
  options.distribution = Distribution::keep;
  options.method = EquilibriumMethod{.tolerance = 1e-9};
  FairResult result = fair(curve, constraints, options);
  if (result.report.outcome != Outcome::converged) {
    // The preconditioner is made for the rules by default; the plain iteration takes all of them.
    options.method = SweepMethod{.step_tolerance = 1e-8, .max_iterations = 3'000'000};
    result = fair(curve, constraints, options);
  }
  if (result.report.outcome != Outcome::converged) return -1;
  const reference::Clothoid clothoid = reference::hermite_clothoid({0, 0}, start, {1, 0}, end);
  double greatest = 0;
  for (std::size_t k = 0; k < positions.size(); ++k) {
    double s = clothoid.length * positions[k].x();
    const Eigen::Vector2d node = result.positions[k].head<2>();
    for (int step = 0; step < 8; ++step) {
      const double angle = clothoid.angle_at(s);
      s += (node - clothoid.at(s)).dot(Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    greatest = std::max(greatest, (node - clothoid.at(s)).norm());
  }
  return greatest;
}

}  // namespace

int main() {
  const std::vector<Choice> choices = {
      {"mean normal of both edges, 1/ℓ (paper)", CurveRules::paper(), Forces::printed},
      {"chord, 1/ℓ", CurveRules::paper()},
      {"circle, 1/ℓ", {.tangents = CurveTangents::circle, .weights = CurveWeights::inverse}},
      {"circle, 1/ℓ³", {}}};
  fmt::print("| spacing | tangents, weights | 16 edges | 32 | 64 | 128 | order |\n|---|---|---|---|---|---|---|\n");
  for (const Spacing& spacing : spacings()) {
    for (const Choice& choice : choices) {
      std::string row;
      std::vector<double> errors;
      for (const std::size_t edges : {16, 32, 64, 128}) {
        errors.push_back(error(spacing, edges, choice));
        row += errors.back() < 0 ? " none reached |" : fmt::format(" {:.1e} |", errors.back());
      }
      const bool known = errors.front() > 0 && errors.back() > 0;
      fmt::print("| {} | {} |{} {} |\n", spacing.name, choice.name, row,
                 known ? fmt::format("{:.2f}", std::log2(errors.front() / errors.back()) / 3) : "");
    }
  }
}
