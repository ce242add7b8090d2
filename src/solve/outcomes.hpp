#pragma once

#include "vspring/fair.hpp"

namespace vspring {

/// Takes the worse of two outcomes: that of a whole from those of its parts.
void worsen(Outcome& outcome, Outcome other);

}  // namespace vspring
