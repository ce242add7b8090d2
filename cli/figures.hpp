#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "measured_shape.hpp"
#include "vspring/figures.hpp"

namespace vspring::cli {

/// What measure_surface() or measure_curve() measure, as a list. shown: something shows the curvatures of all nodes
/// anyway; else only those are computed that are measured. The figures have the same bits either way.
[[nodiscard]] std::vector<Figure> figures_of(MeasuredShape<PolygonMesh>& mesh, const Constraints* constraints,
                                             bool shown, const Context& context);
[[nodiscard]] std::vector<Figure> figures_of(MeasuredShape<PolygonCurve>& curve, const Constraints* constraints,
                                             bool shown, const Context& context);

/// Values by their keys, and by the same keys name, unit and definition of each.
[[nodiscard]] nlohmann::ordered_json values_of(const std::vector<Figure>& figures);
[[nodiscard]] nlohmann::ordered_json definitions_of(const std::vector<Figure>& figures);

}  // namespace vspring::cli
