#pragma once

#include <string>

#include "vspring/error.hpp"
#include "vspring/warning.hpp"

namespace vspring::cli {

// Messages of the library, with the options that do what they advise.

[[nodiscard]] std::string with_options(const Error& error);
[[nodiscard]] std::string with_options(const Warning& warning);

}  // namespace vspring::cli
