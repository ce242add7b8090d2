#pragma once

#include <string>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Gives nodes the positions that are written, so that figures are of these, and warns where they are more than a
/// hundredth of the mean edge off. What is not finite then is refused where it is written.
void take_written(PolygonMesh& shape, std::vector<Vector3> written, std::vector<std::string>& warnings);

}  // namespace vspring::cli
