#pragma once

#include "fit/fit_run.hpp"
#include "fit/warm_started_fit.hpp"

namespace vspring {

/// Takes FitOptions::noise off a surface whose own nodes are the points: without_noise(), and where normals are given,
/// the equilibrium next to its result that has them. Throws Error(invalid_argument) for other points.
void fit_without_noise(FitRun<FitSurface>& run, UntiedPoints points, ProgressReporter& progress);

/// The same for FitOptions::rms: takes that much noise off, and where nodes are then further away, goes so far back to
/// them that they are not. False, with a result of no use, where that does not apply: points that are not the nodes,
/// normals that are given, and distances of far more than the noise, which filters do not lead to.
bool fit_to_rms_by_filters(FitRun<FitSurface>& run, const UntiedPoints& points, ProgressReporter& progress);

}  // namespace vspring
