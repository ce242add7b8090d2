// A session with any sequence of calls: held nodes move, other nodes are held, calls are cancelled.
#include "shapes.hpp"

using namespace vspring;
using namespace vspring::fuzz;

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  FuzzedDataProvider data(bytes, size);
  const PolygonMesh shape = mesh(data);
  constexpr double tolerance = 1e-4;
  EquilibriumMethod method = {.tolerance = tolerance};
  // Most inputs are to take little time.
  if (data.ConsumeIntegralInRange(0, 7) > 0) method.max_iterations = data.ConsumeIntegralInRange(1, 60);
  attempt([&] {
    FairingSession session(shape, {.method = method}, 1);
    Constraints held = constraints(data, shape);
    for (int calls = data.ConsumeIntegralInRange(1, 8); calls > 0; --calls) {
      if (data.ConsumeIntegralInRange(0, 7) == 0) held = constraints(data, shape);
      for (int moves = data.ConsumeIntegralInRange(0, 3); moves > 0; --moves) {
        const auto node = data.ConsumeIntegralInRange<Index>(0, shape.node_count() - 1);
        if (held.position_fixed(node)) held.fix_position(node, held.position(node) + 0.1 * vector(data));
      }
      Context context;
      if (data.ConsumeIntegralInRange(0, 7) == 0) context.on_progress = [&](Progress) { context.cancel(); };
      attempt([&] {
        switch (data.ConsumeIntegralInRange(0, 2)) {
          case 0: {
            const FairResult result = session.fair(held, context);
            check(shape, held, result.report, tolerance, result.positions);
            break;
          }
          case 1: {
            const FairResult result = session.update(held, 10 * tolerance, context);
            check(shape, held, result.report, 10 * tolerance, result.positions);
            break;
          }
          default:
            if (const auto places = session.predict(held, 10 * tolerance)) check(shape, held, {}, tolerance, *places);
        }
      });
    }
  });
  return 0;
}
