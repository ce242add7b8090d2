#pragma once

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// "major.minor.patch" of the running library.
[[nodiscard]] const char* version() noexcept;

/// Largest resident memory of this process so far, in bytes; 0 if the system does not tell.
[[nodiscard]] long long peak_memory_bytes() noexcept;

}  // namespace vspring
