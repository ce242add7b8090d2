// A program as a user would write it, against the installed library: a paper hat, its rim held with level normals,
// becomes a round one.
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <vector>
#include <vspring/vspring.hpp>

using namespace vspring;

// From a shared library too an error comes as what it is.
bool catches_errors() {
  bool as_own = false;
  try {
    (void)read_surface("no such file.ply");
  } catch (const Error& error) {
    as_own = error.code() == ErrorCode::unusable_file;
  }
  try {
    (void)positions_of(std::vector<double>(4));
  } catch (const std::runtime_error&) {
    return as_own;
  }
  return false;
}

int main() {
  const Index sides = 24;
  MeshBuilder builder;
  builder.add_node({0, 0, 1});
  for (Index ring = 1; ring <= 4; ++ring) {
    for (Index k = 0; k < sides; ++k) {
      const double angle = 2 * 3.14159265358979323846 * k / sides;
      builder.add_node({0.25 * ring * std::cos(angle), 0.25 * ring * std::sin(angle), 1 - 0.25 * ring});
    }
  }
  for (Index k = 0; k < sides; ++k) {
    const Index next = (k + 1) % sides;
    builder.add_face({0, 1 + k, 1 + next});
    for (Index ring = 0; ring < 3; ++ring) {
      const Index inner = 1 + ring * sides;
      const Index outer = inner + sides;
      builder.add_face({inner + k, outer + k, outer + next, inner + next});
    }
  }
  const PolygonMesh hat = builder.take();

  Constraints constraints(hat.node_count());
  fix_boundary_positions(constraints, hat);
  const auto loops = boundary_loops(hat);
  for (const Index node : loops.front()) constraints.fix_normal(node, {0, 0, 1});

  const FairResult result = fair(hat, constraints);
  PolygonMesh faired = hat;
  faired.set_positions(result.positions);
  const Fairness before = measure(hat);
  const Fairness after = measure(faired);
  std::printf("%s: %s after %d iterations, greatest turn %.1f -> %.1f degrees\n", version(),
              name(result.report.outcome), result.report.iterations, before.greatest_turn, after.greatest_turn);
  const bool good = result.report.outcome == Outcome::converged && after.greatest_turn < before.greatest_turn;
  return good && catches_errors() ? 0 : 1;
}
