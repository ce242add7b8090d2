#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// What a user can change to be rid of an error or a warning.
enum class Remedy : std::uint8_t {
  input,             ///< the file or the shape itself
  rules,             ///< what rules hold
  fix_boundary,      ///< boundary nodes, and ends of curves, are held
  fair_boundary,     ///< the boundary is made fair first, and then held
  region,            ///< which nodes may move
  noise,             ///< noise is taken off, and nothing else
  within,            ///< the tolerance that points are fitted within
  weight,            ///< how strongly points pull
  smoothing_length,  ///< up to which length fits to points are smoothed
  moving_axes,       ///< which coordinates may move
  outliers,          ///< which share of the points is left out
  method,            ///< how the equilibrium is found
  iterations,        ///< how many iterations are allowed
  time,              ///< how much time is allowed
  format,            ///< the format of a file
  columns,           ///< which columns of a file are coordinates
  order,             ///< whether nodes are put in order along the curve
  weld,              ///< within which distance nodes become one
  join               ///< within which distance curves meet
};

/// A remedy, and the words of a message that say what to do with it.
struct Advice {
  Remedy remedy;      ///< for programs
  std::string words;  ///< such as "fix the boundary"

  /// Whether remedy and words are the same.
  bool operator==(const Advice&) const = default;
};

/// "FAULT; WORDS, WORDS, or WORDS": the text of an error or a warning; the fault alone without advice.
[[nodiscard]] std::string with_advice(const std::string& fault, std::span<const Advice> advice);

}  // namespace vspring
