#pragma once

#include <string>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Moves nodes to the positions as written, so that figures are of these, and warns if they differ by more than a
/// hundredth of the mean edge. Positions that are not finite are refused on writing.
void take_written(PolygonMesh& shape, std::vector<Vector3> written, std::vector<std::string>& warnings);

/// A line if positions that were read are rounded by a considerable part of the edges; else empty. rounding: its
/// standard deviation in each coordinate.
[[nodiscard]] std::string warning_of_rounding(const PolygonMesh& shape, double rounding);

/// Throws Error(unusable_shape) if positions are rounded to multiples of more than the mean edge, as removing noise
/// cannot mend that. option: the one that is "auto"; empty: none.
void refuse_auto_of_rounded(const std::string& option, const PolygonMesh& shape, double rounding);

}  // namespace vspring::cli
