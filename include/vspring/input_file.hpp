#pragma once

#include <string>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// The bytes of a whole file, such as one of rules. Throws Error(unusable_file) naming the path and what is wrong: the
/// system's reason, a file that is changed meanwhile, or a pipe or device that goes on after 1 GiB. Cost: linear.
[[nodiscard]] std::string read_file(const std::string& path);

}  // namespace vspring
