#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>

#include "figures.hpp"
#include "vspring/context.hpp"
#include "vspring/figures.hpp"

namespace vspring::cli {

/// Which shape is seen first, and from which deviations are measured.
struct PageRoles {
  int leading = 0;
  std::optional<int> reference = std::nullopt;
  bool deviation = true;                               ///< whether deviations are shown
  std::optional<Eigen::Matrix3d> view = std::nullopt;  ///< the view of surfaces
  std::span<const Vector3> points = {};                ///< shown with surfaces; thinned if very many
};

/// The shapes for page/data.js. All are moved and scaled together into a box of side 1 about the origin; faces and
/// chains leave out nodes without finite coordinates. For the view see framing.hpp. When cancelled, the result is
/// useless.
[[nodiscard]] nlohmann::ordered_json scene_of(std::span<const ShownShape<PolygonMesh>> shapes, const PageRoles& roles,
                                              const Context& context);
[[nodiscard]] nlohmann::ordered_json scene_of(std::span<const ShownShape<PolygonCurve>> shapes, const PageRoles& roles,
                                              const Context& context);

}  // namespace vspring::cli
