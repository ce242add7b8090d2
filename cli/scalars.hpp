#pragma once

#include <string>
#include <vector>

#include "figures.hpp"
#include "vspring/context.hpp"
#include "vspring/scalar_file.hpp"

namespace vspring::cli {

/// Throws Error(invalid_argument) where --scalars names a file of no format that holds them. Nothing without it.
void refuse_scalars(const std::string& path, bool curve);

/// What --scalars writes at nodes: curvatures, 1/length, and with `before`, which may be null, the deviation from it,
/// in units of the input: of the same nodes where there are as many (and along the normal there where they have the
/// same faces), else from the nearest place on it. Once cancelled, what they return is of no use.
[[nodiscard]] std::vector<NodeScalar> scalars_of(const MeasuredShape<PolygonMesh>& mesh,
                                                 const MeasuredShape<PolygonMesh>* before, const Context& context);
[[nodiscard]] std::vector<NodeScalar> scalars_of(const MeasuredShape<PolygonCurve>& curve,
                                                 const MeasuredShape<PolygonCurve>* before, const Context& context);

}  // namespace vspring::cli
