#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "terminal.hpp"
#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"
#include "vspring/fairness.hpp"
#include "vspring/figures.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// The fairness of a shape before and after.
struct BeforeAndAfter {
  Fairness before;
  Fairness after;
};

/// Measures where the shape moves under these constraints.
[[nodiscard]] BeforeAndAfter fairness_of(const PolygonMesh& before, const PolygonMesh& after,
                                         const Constraints& constraints, const Context& context);
[[nodiscard]] BeforeAndAfter fairness_of(const PolygonCurve& before, const PolygonCurve& after,
                                         const Constraints& constraints, const Context& context);

/// Picks the fairness from measured figures.
[[nodiscard]] BeforeAndAfter fairness_of(const std::vector<Figure>& before, const std::vector<Figure>& after);

/// Measures the boundary of a surface, faired as a curve under the given positions and tangents.
[[nodiscard]] BeforeAndAfter fairness_of_boundary(const PolygonMesh& before, const PolygonMesh& after,
                                                  const Constraints& constraints);

/// The report of a run for scripts, with the keys that docs/command-line.md promises, without figures of fairness.
[[nodiscard]] nlohmann::ordered_json to_json(const FairReport& report);
[[nodiscard]] nlohmann::ordered_json to_json(const BeforeAndAfter& fairness);

/// The summary of a run for people, some lines. size: of the moving part, to which moves are relative. options: as
/// given. fairness: none if not measured.
[[nodiscard]] std::string summary(const FairReport& report, const std::optional<BeforeAndAfter>& fairness, double size,
                                  const FairOptions& options, const Terminal& terminal);

}  // namespace vspring::cli
