#pragma once

#include "fit/fit_run.hpp"
#include "fit/warm_started_fit.hpp"
#include "vspring/noise.hpp"

namespace vspring {

/// The noise of the nodes that move, whatever noise there is in what is held. Cost: that of estimate_noise().
NoiseEstimate noise_of_moving_nodes(FitRun<FitSurface>& run);

/// Takes the deviation of Noise off a surface whose own nodes are the points: without_noise(), and where normals are
/// given, the equilibrium next to its result that has them. Throws Error(invalid_argument) for other points.
void fit_without_noise(FitRun<FitSurface>& run, UntiedPoints points, ProgressReporter& progress);

/// The same for RootMeanSquare: takes that much noise off, and where nodes are then further away, goes back towards
/// them until they are not. False, with a result of no use, where that does not apply: points that are not the nodes,
/// normals that are given, and distances of far more than the noise, which filters do not lead to.
bool fit_to_rms_by_filters(FitRun<FitSurface>& run, const UntiedPoints& points, ProgressReporter& progress);

/// The same for Within, where the tolerance is little more than the noise of the nodes: takes a third of the tolerance
/// off as noise, or the noise itself where it is clearly larger; nodes that end further away than the tolerance are
/// taken back, and nodes near them move along. only_smooth: no node is taken back. False, and nothing is done, where
/// that does not apply: no fallbacks, points that are not the nodes, normals that are given, noise of less than a sixth
/// or more than half of the tolerance or of less than a hundredth of the edges.
bool fit_within_by_filters(FitRun<FitSurface>& run, const UntiedPoints& points, bool only_smooth,
                           ProgressReporter& progress);

}  // namespace vspring
