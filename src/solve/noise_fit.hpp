#pragma once

#include "solve/fit_run.hpp"
#include "solve/pulled_shape.hpp"

namespace vspring {

/// A fit of a surface to its own nodes that takes FitOptions::noise off: in turns, to the equilibrium and with weights
/// that even_residuals() asks for there. Throws Error(invalid_argument) for other points.
void fit_without_noise(FitRun<FitSurface>& run, LoosePoints points, ProgressReporter& progress);

}  // namespace vspring
