#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "vspring/figures.hpp"

namespace vspring::cli {

/// What measure_surface() or measure_curve() measure, as a list.
[[nodiscard]] std::vector<Figure> figures_of(const PolygonMesh& mesh, const Constraints* constraints,
                                             const Context& context);
[[nodiscard]] std::vector<Figure> figures_of(const PolygonCurve& curve, const Constraints* constraints,
                                             const Context& context);

/// Values by their keys, and by the same keys name, unit and definition of each.
[[nodiscard]] nlohmann::ordered_json values_of(const std::vector<Figure>& figures);
[[nodiscard]] nlohmann::ordered_json definitions_of(const std::vector<Figure>& figures);

}  // namespace vspring::cli
