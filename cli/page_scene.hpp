#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "figures.hpp"
#include "vspring/context.hpp"
#include "vspring/figures.hpp"

namespace vspring::cli {

/// What of the shapes is seen first, and from which of them deviations are measured.
struct PageRoles {
  int leading = 0;
  std::optional<int> reference = std::nullopt;
  bool deviation = true;                               ///< whether deviations are shown
  std::optional<Eigen::Matrix3d> view = std::nullopt;  ///< from where surfaces are to be seen
  std::span<const Vector3> points = {};                ///< shown with surfaces; of very many every so-manieth
};

/// The shapes as page/data.js reads them. All are moved and scaled together into a box of side 1 about the origin;
/// faces and chains leave out what has no finite coordinates. Where they look: see framing.hpp. Once cancelled, what
/// they return is of no use.
[[nodiscard]] nlohmann::ordered_json scene_of(std::span<const ShownShape<PolygonMesh>> shapes, const PageRoles& roles,
                                              const Context& context);
[[nodiscard]] nlohmann::ordered_json scene_of(std::span<const ShownShape<PolygonCurve>> shapes, const PageRoles& roles,
                                              const Context& context);

}  // namespace vspring::cli
