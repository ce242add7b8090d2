#include "symmetry/given_numbers.hpp"
#include "symmetry/given_report.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

namespace {

template <typename Shape>
FairResult fair_whole(const Symmetric<Shape>& shape, const Constraints& constraints, const FairOptions& options,
                      Context& context) {
  const Constraints held = symmetric_constraints(shape, constraints);
  const GivenNumbers numbers(shape);
  FairResult result = naming_what_was_given(
      numbers, [&] { return fair(shape.whole, held, with_marks_of_both(shape, options), context); });
  result.positions = given_positions(shape, held, result.positions);
  report_what_was_given(shape, held, numbers, result.positions, options.accept_worse, result.report);
  return result;
}

}  // namespace

FairResult fair(const Symmetric<PolygonMesh>& shape, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  return fair_whole(shape, constraints, options, context);
}

FairResult fair(const Symmetric<PolygonCurve>& shape, const Constraints& constraints, const FairOptions& options,
                Context& context) {
  return fair_whole(shape, constraints, options, context);
}

}  // namespace vspring
