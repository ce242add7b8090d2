#pragma once

#include <vector>

#include "vspring/polygon_curve.hpp"

namespace vspring::cli {

/// A node that repeats the position of another one and goes where that goes.
struct Repeat {
  Index node;
  Index of;
};

/// Joins the last node of every open chain to its first. A last node at the very place of the first is left out, and
/// follows it.
std::vector<Repeat> close_chains(PolygonCurve& curve);

}  // namespace vspring::cli
