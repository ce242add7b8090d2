// Discs of rings about a pole.

#include <cmath>
#include <numbers>

#include "generate/arguments.hpp"
#include "generate/rings.hpp"

namespace vspring::generate {

namespace {

/// Equally spaced rings on a curve that begins on the axis.
RingLayout layout_disc(Index nodes, const ProfileCurve& curve, double length, double edge) {
  const Index rows = even_rows(length, edge, (nodes - 1) / 3);
  RingLayout layout{{1}, {0.0}};
  std::vector<double> radii;
  for (Index k = 1; k <= rows; ++k) {
    layout.at.push_back(k == rows ? length : length * k / rows);
    radii.push_back(curve(layout.at.back()).radius);
  }
  const auto counts = share_out(nodes - 1, radii, 3);
  layout.counts.insert(layout.counts.end(), counts.begin(), counts.end());
  return layout;
}

}  // namespace

PolygonMesh cap(const CapOptions& options) {
  require(options.nodes >= 4, "nodes", "4 or more", options.nodes);
  require_node_count(options.nodes);
  require_length("radius", options.radius);
  require(options.half_angle > 0 && options.half_angle <= 170, "half angle", "greater than 0, up to 170 degrees",
          options.half_angle);
  require_jitter(options.jitter);
  // Lengths along the unit sphere are angles from the pole.
  const double rim = options.half_angle * std::numbers::pi / 180;
  const double area = 2 * std::numbers::pi * 2 * std::sin(rim / 2) * std::sin(rim / 2);
  const double edge = even_edge(options.nodes - 1, area, 2 * std::numbers::pi * std::sin(rim));
  const ProfileCurve curve = [&](double angle) {
    return ProfilePoint{options.radius * std::sin(angle), options.radius * std::cos(angle)};
  };
  return revolve(curve, layout_disc(options.nodes, curve, rim, edge), {options.jitter, options.seed});
}

PolygonMesh flat_disc(const DiscOptions& options) {
  require(options.nodes >= 4, "nodes", "4 or more", options.nodes);
  require_node_count(options.nodes);
  require_length("radius", options.radius);
  require_jitter(options.jitter);
  const double edge = even_edge(options.nodes - 1, std::numbers::pi, 2 * std::numbers::pi);
  const ProfileCurve curve = [&](double share) { return ProfilePoint{options.radius * share, 0}; };
  return revolve(curve, layout_disc(options.nodes, curve, 1, edge), {options.jitter, options.seed});
}

}  // namespace vspring::generate
