#pragma once

#include <string>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Gives nodes the positions that a file in single precision holds, so that figures are of these, and warns where they
/// are more than a hundredth of the mean edge off.
void round_to_single(PolygonMesh& shape, std::vector<std::string>& warnings);

}  // namespace vspring::cli
