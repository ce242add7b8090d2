// Sessions: one shape, faired again and again while its constraints move.

#include <optional>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "reports.hpp"
#include "run.hpp"

namespace vspring::python {

namespace {

/// Returns the new positions, the fields of the report, and the exception that ended the call early.
template <typename Solve>
py::tuple solve(int threads, py::object progress, const Solve& with) {
  Run run(threads, std::move(progress));
  FairResult result = run(with);
  return py::make_tuple(array_of(std::move(result.positions)), report_of(result.report), run.stopped_by());
}

}  // namespace

void add_session(py::module_& module) {
  py::class_<FairingSession>(module, "FairingSession", py::module_local())
      .def(py::init([](const PolygonMesh& mesh, const py::dict& given) {
        const Settings settings(given);
        return FairingSession(mesh, fair_options(settings, {}), threads_of(settings));
      }))
      .def(py::init([](const PolygonCurve& curve, const py::dict& given) {
        return FairingSession(curve, fair_options(Settings(given), {.is_curve = true}));
      }))
      .def("fair",
           [](FairingSession& self, const Constraints& constraints, int threads, py::object progress) {
             return solve(threads, std::move(progress),
                          [&](Context& context) { return self.fair(constraints, context); });
           })
      .def(
          "update",
          [](FairingSession& self, const Constraints& constraints, double tolerance, int threads, py::object progress) {
            return solve(threads, std::move(progress),
                         [&](Context& context) { return self.update(constraints, tolerance, context); });
          })
      .def("predict", [](FairingSession& self, const Constraints& constraints, double tolerance) {
        std::optional<std::vector<Vector3>> positions = [&] {
          const py::gil_scoped_release unlocked;
          return self.predict(constraints, tolerance);
        }();
        return positions ? py::object(array_of(std::move(*positions))) : py::none();
      });
}

}  // namespace vspring::python
