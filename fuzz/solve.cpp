// Fairs and fits small shapes under any constraints and options.
#include <optional>
#include <type_traits>
#include <variant>

#include "shapes.hpp"

using namespace vspring;
using namespace vspring::fuzz;

namespace {

FairOptions options_of(FuzzedDataProvider& data) {
  FairOptions options;
  EquilibriumMethod equilibrium;
  constexpr std::array methods = {Method::equilibrium, Method::multigrid, Method::sweep};
  constexpr std::array distributions = {Distribution::smooth, Distribution::even, Distribution::keep};
  // Where none is named, others may stand for what is not found.
  std::optional<Method> method;
  if (data.ConsumeIntegralInRange(0, 3) == 0) method = data.PickValueInArray(methods);
  if (method) equilibrium.fallbacks = false;
  if (data.ConsumeIntegralInRange(0, 3) == 0) options.distribution = data.PickValueInArray(distributions);
  options.springs = data.ConsumeBool() ? Springs::sphere : Springs::edge;
  options.fair_by = data.ConsumeIntegralInRange(0, 3) == 0 ? FairBy::bending : FairBy::curvature;
  const bool boundary_first = data.ConsumeIntegralInRange(0, 7) == 0;
  options.strength = data.ConsumeIntegralInRange(0, 3) == 0 ? 0.5 : 1;
  equilibrium.tolerance = data.ConsumeBool() ? 1e-5 : 1e-3;
  // The paper's methods take as long as they are let, and most inputs are to take little time.
  constexpr int most_iterations = 100;
  if (method && *method != Method::equilibrium)
    equilibrium.max_iterations = most_iterations;
  else if (data.ConsumeIntegralInRange(0, 7) > 0)
    equilibrium.max_iterations = data.ConsumeIntegralInRange(1, 60);
  options.method = equilibrium;
  if (method == Method::multigrid) options.method = MultigridMethod{.max_iterations = most_iterations};
  if (method == Method::sweep) options.method = SweepMethod{.max_iterations = most_iterations};
  if (boundary_first) options.fair_boundary = equilibrium;
  return options;
}

template <typename Shape>
void solve(FuzzedDataProvider& data, const Shape& shape) {
  Context context;
  context.threads = data.ConsumeIntegralInRange(1, 2);
  FairOptions options = options_of(data);
  const auto* const equilibrium = std::get_if<EquilibriumMethod>(&options.method);
  const double tolerance = equilibrium ? equilibrium->tolerance : 0;
  const bool fits = data.ConsumeIntegralInRange(0, 2) == 0;
  const int pull = data.ConsumeIntegralInRange(0, 4);
  const bool own_nodes = data.ConsumeBool();
  ScatteredPoints points;
  for (int k = fits && !own_nodes ? data.ConsumeIntegralInRange(1, 8) : 0; k > 0; --k)
    points.positions.push_back(vector(data));
  const Constraints held = constraints(data, shape);
  if (!fits) {
    attempt([&] {
      const FairResult result = fair(shape, held, options, context);
      if (options.strength == 1) check(shape, held, result.report, tolerance, result.positions);
    });
    return;
  }
  if (own_nodes) {
    points.positions = shape.positions();
    options.distribution = Distribution::keep;
  }
  FitOptions how;
  how.fair = options;
  if (pull == 1) how.criterion = Within{0.1};
  if (pull == 2) how.criterion = RootMeanSquare{0.05};
  if (pull == 3) how.criterion = SmoothingLength{0.5};
  if (pull == 4) how.criterion = Noise{0.05};
  attempt([&] {
    const FitResult result = fit(shape, held, points, how, context);
    if (options.strength == 1) check(shape, held, result.report.fair, tolerance, result.positions);
  });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider data(bytes, size);
  if (data.ConsumeBool())
    solve(data, curve(data));
  else
    solve(data, mesh(data));
  return 0;
}
