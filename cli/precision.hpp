#pragma once

#include <string>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Gives nodes the positions that are written, so that figures are of these, and warns where they are more than a
/// hundredth of the mean edge off. What is not finite then is refused where it is written.
void take_written(PolygonMesh& shape, std::vector<Vector3> written, std::vector<std::string>& warnings);

/// A line where positions that were read are rounded by a good part of the edges: a shape that came so. rounding: their
/// standard deviation in each coordinate. Empty where not.
[[nodiscard]] std::string warning_of_rounding(const PolygonMesh& shape, double rounding);

/// Throws Error(unusable_shape) where positions are rounded to multiples of more than the mean edge, so that noise is
/// not all that is to be taken off. option: that asks for it, empty for none.
void refuse_auto_of_rounded(const std::string& option, const PolygonMesh& shape, double rounding);

}  // namespace vspring::cli
