// A fair curve through five points, with its direction given at both ends: nodes between them start on straight lines.
// build/examples/03_curve OUT
#include <cstdio>
#include <string>
#include <vector>
#include <vspring/vspring.hpp>

using namespace vspring;

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  const std::vector<Vector3> points = {{0, 0, 0}, {2, 1.5, 0}, {4, 1, 0}, {6, -1, 0}, {8, 0, 0}};
  constexpr int between = 12;  // edges from point to point

  std::vector<Vector3> nodes;
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    for (int step = 0; step < between; ++step)
      nodes.emplace_back(points[k] + (points[k + 1] - points[k]) * step / between);
  }
  nodes.push_back(points.back());
  CurveFile start;
  start.curve = PolygonCurve(nodes);
  start.planar = true;

  Constraints constraints(start.curve.node_count());
  for (std::size_t k = 0; k < points.size(); ++k) constraints.fix_position(static_cast<Index>(k) * between, points[k]);
  constraints.fix_tangent(0, {0, 1, 0});
  constraints.fix_tangent(start.curve.node_count() - 1, {1, 0, 0});

  const FairResult result = fair(start.curve, constraints);
  write_curve(out + "/03_curve.csv", start, result.positions);
  write_curve(out + "/03_curve.svg", start, result.positions, std::nullopt, {.before = &start.curve});

  const PolygonCurve after(result.positions);
  std::printf("%s: greatest turn at a node %.1f degrees, before %.1f; directions at the ends are met to %.2f degrees\n",
              name(result.report.outcome), measure(after).greatest_turn, measure(start.curve).greatest_turn,
              measure_curve(after, &constraints).normal_error.value_or(0));
  return result.report.usable() ? 0 : 1;
}
