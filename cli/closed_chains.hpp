#pragma once

#include <string>
#include <vector>

#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring::cli {

/// A node that repeats the position of another one and goes where that goes.
struct DuplicateEnd {
  Index node;
  Index of;
};

/// Joins the last node of every open chain to its first. A last node at the very place of the first is left out, and
/// follows it.
std::vector<DuplicateEnd> close_chains(PolygonCurve& curve);

/// What is said of a node that repeats another one holds that one. Throws Error(unusable_constraint) where they are
/// held at different places.
void hold_repeated(Constraints& constraints, const std::vector<DuplicateEnd>& repeats);

/// What a person should know of open chains that end at the very place where they begin, a line; empty without.
std::string note_of_repeats(const PolygonCurve& curve);

}  // namespace vspring::cli
