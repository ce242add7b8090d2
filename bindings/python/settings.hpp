// Keyword arguments of Python as options of the library.

#pragma once

#include <optional>
#include <string>

#include "arrays.hpp"

namespace vspring::python {

/// Keyword arguments that were given, under the names of the command line.
class Settings {
 public:
  explicit Settings(py::dict given) : given_(std::move(given)) {}

  /// Empty where it was not given, or as None. Throws TypeError naming the argument where it is no such value.
  template <typename Value>
  [[nodiscard]] std::optional<Value> get(const char* name) const {
    if (!given_.contains(name)) return std::nullopt;
    const py::object value = given_[name];
    if (value.is_none()) return std::nullopt;
    try {
      return value.cast<Value>();
    } catch (const py::cast_error&) {
      throw py::type_error(std::string(name) + ": not " + py::repr(value).cast<std::string>());
    }
  }

 private:
  py::dict given_;
};

/// What is faired: a curve or a surface, and whether its own nodes are points that draw it.
struct Subject {
  bool is_curve = false;
  bool own_nodes_pull = false;
};

/// Throws Error(invalid_argument) for a word that is none of the choices.
FairOptions fair_options(const Settings& settings, const Subject& subject);

/// How points pull: as one of `weight`, `smoothing_length`, `within`, `rms`, `noise` and `voxels` says, and others.
/// Throws Error(invalid_argument) unless one of these is given.
FitOptions fit_options(const Settings& settings, const Subject& subject);

/// Whether all is to be as the paper has it, for comparison.
bool is_papers(const Settings& settings);

/// How many new nodes a curve gets, and where; empty where it keeps its own.
std::optional<Resampling> resampling_of(const Settings& settings);

/// The threads asked for; 0 for all cores.
int threads_of(const Settings& settings);

}  // namespace vspring::python
