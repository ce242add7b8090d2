#pragma once

#include "io/input_file.hpp"
#include "vspring/curve_file.hpp"

namespace vspring {

/// The format that the content of a file shows. Throws Error(unusable_file) for a file of a surface. Cost: linear.
CurveFormat detect_curve_format(const InputFile& file);

}  // namespace vspring
