// How a call ended, for the classes of the package that tell it.

#pragma once

#include "arrays.hpp"

namespace vspring::python {

/// The fields of vspring.Report.
py::dict report_of(const FairReport& report);

/// Those of vspring.FitReport, but for `distances`.
py::dict report_of(const FitReport& report);

}  // namespace vspring::python
