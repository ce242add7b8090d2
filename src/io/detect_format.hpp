#pragma once

#include <optional>
#include <string_view>

#include "vspring/surface_file.hpp"

namespace vspring {

/// The format that the content of a file shows; nothing where it is open. Cost: the beginning of the file.
std::optional<SurfaceFormat> detect_format(std::string_view bytes);

/// "OBJ", "OFF", "PLY" or "STL".
const char* name_of(SurfaceFormat format);

}  // namespace vspring
