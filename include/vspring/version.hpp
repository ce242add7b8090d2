#pragma once

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// "major.minor.patch" of the library that runs.
[[nodiscard]] const char* version() noexcept;

/// Largest resident memory of this process so far, bytes; 0 where the system does not tell.
[[nodiscard]] long long peak_memory_bytes() noexcept;

}  // namespace vspring
