// Turns keyword arguments of Python into options of the library.

#pragma once

#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "arrays.hpp"

namespace vspring::python {

/// The given keyword arguments, by the names of the command line.
class Settings {
 public:
  explicit Settings(py::dict given) : given_(std::move(given)) {}

  /// An argument; empty if not given or None. Throws TypeError naming the argument for a value of another type, and for
  /// a truth value as a number, which would be 0 or 1; Error(invalid_argument) for a whole number out of range.
  template <typename Value>
  [[nodiscard]] std::optional<Value> get(const char* name) const {
    if (!given_.contains(name)) return std::nullopt;
    const py::object value = given_[name];
    if (value.is_none()) return std::nullopt;
    constexpr bool is_number = std::is_arithmetic_v<Value> && !std::is_same_v<Value, bool>;
    if (is_number && py::isinstance<py::bool_>(value)) refuse(name, kind_of<Value>(), value);
    try {
      return value.cast<Value>();
    } catch (const py::cast_error&) {
      if (std::is_integral_v<Value> && is_number && py::isinstance<py::int_>(value))
        throw Error(ErrorCode::invalid_argument,
                    std::string(name) + ": " + py::repr(value).cast<std::string>() + " is out of range");
      refuse(name, kind_of<Value>(), value);
    }
  }

 private:
  template <typename Value>
  static constexpr const char* kind_of() {
    if (std::is_same_v<Value, bool>) return "True or False";
    if (std::is_integral_v<Value>) return "a whole number";
    if (std::is_floating_point_v<Value>) return "a number";
    return std::is_same_v<Value, std::string> ? "a word" : "an array";
  }

  [[noreturn]] static void refuse(const char* name, const char* kind, const py::object& value) {
    throw py::type_error(std::string(name) + ": " + kind + " is needed, not " + py::repr(value).cast<std::string>());
  }

  py::dict given_;
};

/// The shape to fair: a curve or a surface, and whether it is fitted to its own nodes.
struct Subject {
  bool is_curve = false;
  bool own_nodes_pull = false;
};

/// Options of fairing. Throws Error(invalid_argument) for a word that is none of the choices.
FairOptions fair_options(const Settings& settings, const Subject& subject);

/// Options of a fit, by one of `weight`, `smoothing_length`, `within`, `rms`, `noise` and `voxels`, and others. Throws
/// Error(invalid_argument) unless exactly one of these is given.
FitOptions fit_options(const Settings& settings, const Subject& subject);

/// Whether `paper` is given: all choices of the paper, for comparison.
bool is_papers(const Settings& settings);

/// The number and spacing of new nodes of a curve; empty if it keeps its own.
std::optional<Resampling> resampling_of(const Settings& settings);

/// The threads asked for; 0 for all cores.
int threads_of(const Settings& settings);

}  // namespace vspring::python
