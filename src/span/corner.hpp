// Corners of polylines.
#pragma once

namespace vspring {

/// Whether a polyline has a corner where it turns by `turn` degrees and at its next nodes by `beside` at most: of a
/// smooth curve with few nodes all turn alike.
constexpr bool is_corner(double turn, double beside) {
  constexpr double always = 65;
  constexpr double maybe = 30;
  return turn > always || (turn > maybe && beside < turn / 2);
}

}  // namespace vspring
