#pragma once

#include <vector>

#include "symmetry/given_numbers.hpp"
#include "symmetry/pairs.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

/// The positions of the given nodes, from those of the whole, and these themselves made symmetric. held: the symmetric
/// constraints; held nodes come out exactly where they are held.
template <typename Shape>
std::vector<Vector3> given_positions(const Symmetric<Shape>& shape, const Constraints& held,
                                     std::vector<Vector3>& of_whole, Leading leading = Leading::mean);

/// Turns a report of the whole into one of the given shape. positions: of its nodes. accept_worse: see FairOptions;
/// else the report says where a half has gone through the plane, and is not converged.
template <typename Shape>
void report_what_was_given(const Symmetric<Shape>& shape, const Constraints& held, const GivenNumbers& numbers,
                           const std::vector<Vector3>& positions, bool accept_worse, FairReport& report);

/// The number of things of a half, if so many belong to the whole and `on_plane` of them to both halves.
inline Index of_half(Index of_whole, Index on_plane) { return (of_whole + on_plane + 1) / 2; }

/// The options, with the mirror images of their corners and sharp edges.
template <typename Shape>
FairOptions with_marks_of_both(const Symmetric<Shape>& shape, FairOptions options);

}  // namespace vspring
