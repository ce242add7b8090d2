// A call of the library on behalf of Python: other threads of Python go on meanwhile, and Ctrl-C ends it.

#pragma once

#include "settings.hpp"

namespace vspring::python {

class Run {
 public:
  /// progress: called with stage, fraction, iteration and residual; or None. What it raises ends the call. Throws
  /// Error(invalid_argument) for a number of threads out of range; 0: all cores.
  Run(int threads, py::object progress);

  /// call(context), without Python's lock.
  template <typename Call>
  auto operator()(const Call& call) {
    const py::gil_scoped_release unlocked;
    return call(context_);
  }

  /// What ended the call before its time, an exception; else None.
  [[nodiscard]] const py::object& stopped_by() const { return stopped_by_; }
  /// Raises it, where there is no result to keep.
  void raise_if_stopped() const;

 private:
  void tell(const Progress& now);

  Context context_;
  py::object progress_;
  py::object stopped_by_ = py::none();
};

}  // namespace vspring::python
