#pragma once

#include <string>

namespace vspring::cli {

/// Adds to a message of the library the options of the command line that do what it advises.
[[nodiscard]] std::string with_options(std::string message);

}  // namespace vspring::cli
