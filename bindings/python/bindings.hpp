// Each source adds its part to the module.

#pragma once

#include "arrays.hpp"

namespace vspring::python {

void add_errors(py::module_& module);
void add_shapes(py::module_& module);
void add_constraints(py::module_& module);
void add_files(py::module_& module);
void add_fairing(py::module_& module);
void add_filling(py::module_& module);
void add_refining(py::module_& module);
void add_sharp_edges(py::module_& module);
void add_symmetry(py::module_& module);
void add_spanning(py::module_& module);
void add_session(py::module_& module);

}  // namespace vspring::python
