#pragma once

#include <string>
#include <vector>

#include "figures.hpp"
#include "vspring/context.hpp"
#include "vspring/scalar_file.hpp"

namespace vspring::cli {

/// Throws Error(invalid_argument) if the format of --scalars cannot hold them. Does nothing without it.
void refuse_scalars(const std::string& path, bool curve);

/// The numbers that --scalars writes at nodes: curvatures, 1/length, and with `before`, which may be null, the
/// deviation from it, in units of the input. With equally many nodes that is the distance of the same node (with the
/// same faces along the normal), else that from the nearest place. When cancelled, the result is useless.
[[nodiscard]] std::vector<NodeScalar> scalars_of(const MeasuredShape<PolygonMesh>& mesh,
                                                 const MeasuredShape<PolygonMesh>* before, const Context& context);
[[nodiscard]] std::vector<NodeScalar> scalars_of(const MeasuredShape<PolygonCurve>& curve,
                                                 const MeasuredShape<PolygonCurve>* before, const Context& context);

}  // namespace vspring::cli
