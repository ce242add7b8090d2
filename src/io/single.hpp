#pragma once

#include <fmt/format.h>

#include <cmath>

#include "vspring/error.hpp"

namespace vspring {

/// A coordinate of a node in single precision. Throws Error(invalid_argument) for one that is beyond its range.
inline float single(double value, std::size_t node) {
  const auto narrow = static_cast<float>(value);
  if (std::isfinite(value) && !std::isfinite(narrow))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("node {}: {} does not fit single precision; write another format", node, value));
  return narrow;
}

}  // namespace vspring
