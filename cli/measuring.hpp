#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "figures.hpp"
#include "terminal.hpp"
#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/distance.hpp"
#include "vspring/noise.hpp"

namespace vspring::cli {

/// How far two shapes lie apart.
struct Apart {
  std::optional<Distance> nodes;  ///< set if both have equally many nodes
  Distance to_other;
  Distance from_other;
};

/// Distances from the nodes of the first to the second, and back.
template <typename Shape>
Apart distances_between(const Shape& first, const Shape& second, const Context& context) {
  Apart apart;
  if (first.node_count() == second.node_count()) apart.nodes = node_distance(second.positions(), first.positions());
  apart.to_other = distance(first, second, context);
  apart.from_other = distance(second, first, context);
  return apart;
}

/// The figures of measure_surface() or measure_curve(), and the estimated noise. held: ignored if of another node
/// count. shown: see figures_of().
template <typename Shape>
[[nodiscard]] std::vector<Figure> figures_with_noise(const MeasuredShape<Shape>& shape,
                                                     const std::optional<Constraints>& held, const NoiseEstimate& noise,
                                                     bool shown, const Context& context);

/// The report on a shape, and on another one and their distances. names: of their files.
template <typename Shape>
[[nodiscard]] nlohmann::ordered_json report_of(const std::array<std::string, 2>& names,
                                               std::span<const ShownShape<Shape>> shapes,
                                               const std::optional<Apart>& apart);

/// The distances for people, in lines.
[[nodiscard]] std::string distance_lines(const Apart& apart, const Terminal& terminal);

}  // namespace vspring::cli
