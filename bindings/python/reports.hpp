// Reports, for the classes of the package.

#pragma once

#include "arrays.hpp"

namespace vspring::python {

/// The fields of vspring.Report.
py::dict report_of(const FairReport& report);

/// The fields of vspring.FitReport, except `distances`.
py::dict report_of(const FitReport& report);

}  // namespace vspring::python
