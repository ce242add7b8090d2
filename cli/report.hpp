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

/// How fair a shape was, and is.
struct BeforeAndAfter {
  Fairness before;
  Fairness after;
};

/// Where it moves under these constraints.
[[nodiscard]] BeforeAndAfter fairness_of(const PolygonMesh& before, const PolygonMesh& after,
                                         const Constraints& constraints, const Context& context);
[[nodiscard]] BeforeAndAfter fairness_of(const PolygonCurve& before, const PolygonCurve& after,
                                         const Constraints& constraints, const Context& context);

/// Of figures that were measured.
[[nodiscard]] BeforeAndAfter fairness_of(const std::vector<Figure>& before, const std::vector<Figure>& after);

/// Of the boundary of a surface, which was faired by itself under the positions and tangents given.
[[nodiscard]] BeforeAndAfter fairness_of_boundary(const PolygonMesh& before, const PolygonMesh& after,
                                                  const Constraints& constraints);

/// The report of a run for scripts, with the keys that docs/command-line.md promises, but for figures of fairness.
[[nodiscard]] nlohmann::ordered_json to_json(const FairReport& report);
[[nodiscard]] nlohmann::ordered_json to_json(const BeforeAndAfter& fairness);

/// What a person wants to know of a run, some lines. size: of what moves, for moves relative to it.
/// options: that it was given. fairness: none where nobody has looked.
[[nodiscard]] std::string summary(const FairReport& report, const std::optional<BeforeAndAfter>& fairness, double size,
                                  const FairOptions& options, const Terminal& terminal);

}  // namespace vspring::cli
