#pragma once

#include <functional>

#include "vspring/fit.hpp"

namespace vspring {

/// Boundary first, then the surface: a fit with fair_boundary. Throws Error(invalid_argument) for points that are not
/// the surface's own nodes by another method than equilibrium.
FitResult fit_boundary_first(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                             FitOptions options, Context& context);

/// A fit of a surface as it is fitted sheet by sheet, cut where more than two faces or several fans meet; what it is
/// given has more nodes then, which are held, and points without weight.
using FitOfSheets = std::function<FitResult(const PolygonMesh&, const Constraints&, const ScatteredPoints&)>;

/// Lines along which three faces meet, as between three materials, are curves of their own. In an equilibrium
/// fit of a surface to its own nodes they are fitted first, else they stay; the sheets hold them.
FitResult fit_sheets(const PolygonMesh& mesh, const Constraints& constraints, const ScatteredPoints& points,
                     const FitOptions& options, Context& context, const FitOfSheets& fit);

}  // namespace vspring
