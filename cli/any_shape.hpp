#pragma once

#include <optional>
#include <string>
#include <variant>

#include "vspring/curve_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::cli {

using AnyShape = std::variant<SurfaceFile, CurveFile>;
using AnyFormat = std::variant<SurfaceFormat, CurveFormat>;

/// Reads a surface or a curve: as `curve` says, else as the format or the extension says; an OBJ file is a curve where
/// it has no faces. Of standard input and of unknown extensions, a surface.
[[nodiscard]] AnyShape read_shape(const std::string& path, std::optional<AnyFormat> format, bool curve);

}  // namespace vspring::cli
