#pragma once

#include "fit/fit_run.hpp"
#include "fit/warm_started_fit.hpp"

namespace vspring {

/// Takes FitOptions::noise off a surface whose own nodes are the points: without_noise(), and where normals are given,
/// the equilibrium next to its result that has them. Throws Error(invalid_argument) for other points.
void fit_without_noise(FitRun<FitSurface>& run, UntiedPoints points, ProgressReporter& progress);

}  // namespace vspring
