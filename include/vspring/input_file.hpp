#pragma once

#include <string>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// Returns the bytes of a whole file, such as one of rules. Throws Error(unusable_file) naming the path and the reason:
/// the system's, a file that changes while it is read, or a pipe or device that gives more than 1 GiB. Cost: linear.
[[nodiscard]] std::string read_file(const std::string& path);

}  // namespace vspring
