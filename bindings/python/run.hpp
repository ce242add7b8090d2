// A call of the library from Python: other Python threads run meanwhile, and Ctrl-C ends it.

#pragma once

#include "settings.hpp"

namespace vspring::python {

class Run {
 public:
  /// progress: called with stage, fraction, iteration and residual; or None. An exception from it ends the call. Throws
  /// Error(invalid_argument) for a number of threads out of range; 0: all cores.
  Run(int threads, py::object progress);

  /// Calls call(context) without Python's lock.
  template <typename Call>
  auto operator()(const Call& call) {
    const py::gil_scoped_release unlocked;
    return call(context_);
  }

  /// The exception that ended the call early, or None.
  [[nodiscard]] const py::object& stopped_by() const { return stopped_by_; }
  /// Raises that exception, for calls without a result to keep.
  void raise_if_stopped() const;

 private:
  void tell(const Progress& now);

  Context context_;
  py::object progress_;
  py::object stopped_by_ = py::none();
};

}  // namespace vspring::python
