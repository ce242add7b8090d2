#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "solve/lines_of_surface.hpp"
#include "vspring/fit.hpp"

namespace vspring {

/// How lines are fitted where a surface is fitted with these options.
FitOptions options_of_lines(FitOptions options);

/// Corners of lines whose nodes are not held in a direction stay corners: they are more than noise.
void keep_corners(LinesOfSurface& lines, const FitOptions& options);

/// Some of the lines, by their numbers, and how they are fitted.
struct LinesAlike {
  std::size_t begin;
  std::size_t end;
  FitOptions options;  ///< of the lines
};

/// Fits lines to their own nodes, with Noise by smooth_curve(); has the surface hold them there. weights: of all nodes,
/// or none.
FitResult fit_lines(const PolygonMesh& mesh, LinesOfSurface& lines, const std::vector<double>& weights,
                    const LinesAlike& which, Context& context);
/// All of them. options: of the lines.
FitResult fit_lines(const PolygonMesh& mesh, LinesOfSurface& lines, const std::vector<double>& weights,
                    const FitOptions& options, Context& context);

/// Ends of open lines that constraints leave free, such as corners where several meet, have noise, too: first every
/// line is fitted by itself, with free ends. Where several meet, their common end is the place nearest to all of them,
/// extended straight, with Within no further away than that; a line that ends alone keeps its own end.
/// EquilibriumMethod only; else ends stay. groups: all lines. Lines are to have their corners. Cost: that of a fit of
/// the lines.
void place_ends(const PolygonMesh& mesh, const Constraints& constraints, LinesOfSurface& lines,
                const std::vector<double>& weights, std::span<const LinesAlike> groups, Context& context);

}  // namespace vspring
