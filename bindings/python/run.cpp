#include "run.hpp"

#include <string>
#include <utility>

namespace vspring::python {

namespace {

// The limit of the command line.
constexpr int most_threads = 1024;

}  // namespace

Run::Run(int threads, py::object progress) : progress_(std::move(progress)) {
  if (threads < 0 || threads > most_threads)
    throw Error(ErrorCode::invalid_argument, "threads: 1 to " + std::to_string(most_threads) + ", or 0 for all cores");
  context_.threads = threads;
  context_.on_progress = [this](const Progress& now) { tell(now); };
}

void Run::tell(const Progress& now) {
  if (context_.cancelled()) return;
  const py::gil_scoped_acquire locked;
  try {
    // Python's own handler of Ctrl-C runs here, in the main thread.
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!progress_.is_none()) progress_(std::string(now.stage), now.fraction, now.iteration, now.residual);
  } catch (const py::error_already_set& raised) {
    stopped_by_ = raised.value();
    context_.cancel();
  }
}

void Run::raise_if_stopped() const {
  if (stopped_by_.is_none()) return;
  PyErr_SetObject(py::type::handle_of(stopped_by_).ptr(), stopped_by_.ptr());
  throw py::error_already_set();
}

}  // namespace vspring::python
