#pragma once

#include <functional>

#include "vspring/fit.hpp"

namespace vspring {

/// fit() of a surface, but smoothed as much as is asked, whatever that leads to.
FitResult fit_as_asked(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                       const FitOptions& options, Context& context);

/// fit() of a curve by EquilibriumMethod.
FitResult fit_curve(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                    const FitOptions& options, Context& context);

/// Takes noise off a curve by a smoothing spline alone, which is about as near to the truth as fit_curve() and takes a
/// hundredth of its time. options: with Noise.
FitResult smooth_curve(const PolygonCurve& curve, const Constraints& constraints, const ScatteredPoints& points,
                       const FitOptions& options, Context& context);

/// fit_resampled() of a curve by EquilibriumMethod.
ResampledFit fit_curve_resampled(const PolygonCurve& curve, const Constraints& constraints, const Resampling& how,
                                 const FitOptions& options, Context& context);

/// Boundary first, then the surface: a fit with fair_boundary. Throws Error(invalid_argument) for points that are not
/// the surface's own nodes by another method than equilibrium.
FitResult fit_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                             FitOptions options, Context& context);

/// The fit of a surface that is cut into sheets where more than two faces or several fans meet. Its arguments have more
/// nodes than the surface: these are held, and their points have no weight.
using FitOfSheets = std::function<FitResult(const PolygonMesh&, const Constraints&, const ScatteredPoints&)>;

/// Lines along which three faces meet, as between three materials, are curves of their own. In an equilibrium
/// fit of a surface to its own nodes they are fitted first, else they stay; the sheets hold them.
FitResult fit_sheets(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                     const FitOptions& options, Context& context, const FitOfSheets& fit);

/// fit() with options.fair.sharp_edges: the chains first, then the sides. Throws Error(invalid_argument) for voxels.
FitResult fit_sharp_sides(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                          FitOptions options, Context& context);

/// Takes the steps of Voxels off a surface whose own nodes are the points. Throws Error(invalid_argument) for other
/// points, else what fit() does.
FitResult fit_voxels(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                     const FitOptions& options, Context& context);

}  // namespace vspring
