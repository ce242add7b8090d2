// The module _vspring, on which the package vspring is built: the library with NumPy's arrays in and out.

#include "bindings.hpp"

PYBIND11_MODULE(_vspring, module) {
  using namespace vspring::python;
  module.def("version", &vspring::version);
  add_errors(module);
  add_shapes(module);
  add_sharp_edges(module);
  add_symmetry(module);
  add_constraints(module);
  add_files(module);
  add_fairing(module);
  add_filling(module);
  add_spanning(module);
  add_refining(module);
  add_session(module);
}
