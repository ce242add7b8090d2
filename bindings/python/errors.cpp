// Turns errors of the library into vspring.Error, which is written in Python.

#include <exception>
#include <string>
#include <string_view>
#include <utility>

#include "bindings.hpp"

namespace vspring::python {

namespace {

const char* name(ErrorCode code) {
  switch (code) {
    case ErrorCode::invalid_argument:
      return "invalid-argument";
    case ErrorCode::unusable_file:
      return "unusable-file";
    case ErrorCode::unusable_shape:
      return "unusable-shape";
    case ErrorCode::unusable_constraint:
      return "unusable-constraint";
  }
  return "";
}

/// A message of the library that begins with its name of an option, with Python's.
std::string in_python(std::string message) {
  constexpr std::pair<std::string_view, std::string_view> names[] = {
      {"most_length", "max_size"}, {"most_edges", "max_edges"}, {"edge_length", "length"}};
  for (const auto& [of_library, of_python] : names) {
    if (message.starts_with(of_library)) return message.replace(0, of_library.size(), of_python);
  }
  return message;
}

}  // namespace

void add_errors(py::module_& module) {
  // Not by the name "vspring", as another package may contain this one.
  static const py::handle self = module.inc_ref();
  py::register_local_exception_translator([](std::exception_ptr thrown) {
    try {
      std::rethrow_exception(std::move(thrown));
    } catch (const Error& error) {
      const std::string package = self.attr("__spec__").attr("parent").cast<std::string>();
      const py::object type = py::module_::import((package + "._errors").c_str()).attr("Error");
      const py::object made = type(name(error.code()), in_python(error.what()));
      PyErr_SetObject(type.ptr(), made.ptr());
    }
  });
}

}  // namespace vspring::python
