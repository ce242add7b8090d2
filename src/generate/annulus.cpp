// Rings of triangles between two circles, with exact numbers of nodes inside and on the boundary.

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "generate/arguments.hpp"
#include "generate/rings.hpp"

namespace vspring::generate {

namespace {

/// A chain of straight pieces, from the inner circle to the outer.
struct Chain {
  std::vector<ProfilePoint> corners;
  std::vector<double> ends = {0};  // length up to each corner
  double area = 0;                 // of the surface of revolution
  double boundary_length = 0;

  explicit Chain(std::vector<ProfilePoint> points) : corners(std::move(points)) {
    for (std::size_t k = 1; k < corners.size(); ++k) {
      const double radii = corners[k].radius + corners[k - 1].radius;
      const double length =
          std::hypot(corners[k].radius - corners[k - 1].radius, corners[k].height - corners[k - 1].height);
      ends.push_back(ends.back() + length);
      area += std::numbers::pi * radii * length;
    }
    boundary_length = 2 * std::numbers::pi * (corners.front().radius + corners.back().radius);
  }

  /// Exact at the corners.
  [[nodiscard]] ProfilePoint at(double length) const {
    const auto end = std::upper_bound(ends.begin() + 1, ends.end() - 1, length);
    const auto k = static_cast<std::size_t>(end - ends.begin());
    const double share = (length - ends[k - 1]) / (ends[k] - ends[k - 1]);
    return {std::lerp(corners[k - 1].radius, corners[k].radius, share),
            std::lerp(corners[k - 1].height, corners[k].height, share)};
  }
};

Chain chain_of(const AnnulusOptions& options) {
  const double inner = options.inner_radius;
  const double outer = options.outer_radius;
  const double height = options.height;
  switch (options.profile) {
    case Profile::flat:
      return Chain({{inner, 0}, {outer, 0}});
    case Profile::cone:
      return Chain({{inner, height}, {outer, 0}});
    case Profile::steps: {
      // The wall stands on the middle fifth of the width.
      const double width = outer - inner;
      return Chain({{inner, height}, {inner + 0.4 * width, height}, {inner + 0.6 * width, 0}, {outer, 0}});
    }
  }
  return Chain({});
}

/// Nodes inside that the corners of a profile need.
Index least_inside(Profile profile) { return profile == Profile::steps ? 6 : 0; }

void check_annulus(const AnnulusOptions& options) {
  const int profile = static_cast<int>(options.profile);
  require(profile >= 0 && profile <= static_cast<int>(Profile::flat), "profile", "one of the profiles", profile);
  const Index corner_nodes = least_inside(options.profile);
  require(options.nodes >= 6 + corner_nodes, "nodes", corner_nodes > 0 ? "12 or more, for steps" : "6 or more",
          options.nodes);
  require_node_count(options.nodes);
  require(options.boundary_nodes == 0 || options.boundary_nodes >= 6, "boundary nodes", "0, or 6 or more",
          options.boundary_nodes);
  if (options.boundary_nodes > 0) {
    const Index inside = options.nodes - options.boundary_nodes;
    require(inside >= corner_nodes && (inside == 0 || inside >= 3), "nodes inside (nodes less boundary nodes)",
            corner_nodes > 0 ? "6 or more, for steps" : "0, or 3 or more", inside);
  }
  require_length("inner radius", options.inner_radius);
  require_length("outer radius", options.outer_radius);
  require(options.inner_radius < options.outer_radius, "inner radius", "less than the outer radius",
          options.inner_radius);
  require_length_or_zero("height", options.height);
  const double width = options.outer_radius - options.inner_radius;
  require(options.height <= 1e6 * width, "height", "at most a million times the width of the ring", options.height);
  require_jitter(options.jitter);
}

Index even_boundary(const AnnulusOptions& options, const Chain& chain) {
  const double edge = even_edge(options.nodes, chain.area, chain.boundary_length);
  const Index most = options.nodes - least_inside(options.profile);
  const auto wanted = static_cast<Index>(std::lround(std::min<double>(chain.boundary_length / edge, most)));
  const Index boundary = std::max<Index>(wanted, 6);
  const Index inside = options.nodes - boundary;
  return inside < 3 ? options.nodes : boundary;
}

/// Rows of each piece of the chain, for triangles as equilateral as the number of inner nodes allows.
std::vector<Index> rows_of(const Chain& chain, double edge, Index inside) {
  const Index most = inside / 3 + 1;
  std::vector<Index> rows;
  Index sum = 0;
  for (std::size_t k = 1; k < chain.corners.size(); ++k) {
    rows.push_back(even_rows(chain.ends[k] - chain.ends[k - 1], edge, most));
    sum += rows.back();
  }
  for (; sum > most; --sum) --*std::max_element(rows.begin(), rows.end());
  if (sum == 1 && inside > 0) rows.front() = 2;
  return rows;
}

RingLayout layout_annulus(const AnnulusOptions& options, const Chain& chain) {
  const Index boundary = options.boundary_nodes > 0 ? options.boundary_nodes : even_boundary(options, chain);
  const Index inside = options.nodes - boundary;
  const double triangles = 2.0 * options.nodes - boundary;
  const double edge = std::sqrt(chain.area / triangles * 4 / std::numbers::sqrt3);
  RingLayout layout;
  const std::vector<Index> rows = rows_of(chain, edge, inside);
  for (std::size_t k = 0; k < rows.size(); ++k) {
    for (Index row = 0; row < rows[k]; ++row)
      layout.at.push_back(std::lerp(chain.ends[k], chain.ends[k + 1], static_cast<double>(row) / rows[k]));
  }
  layout.at.push_back(chain.ends.back());

  const auto circles = share_out(boundary, {chain.corners.front().radius, chain.corners.back().radius}, 3);
  layout.counts.push_back(circles[0]);
  if (inside > 0) {
    std::vector<double> radii;
    for (std::size_t k = 1; k + 1 < layout.at.size(); ++k) radii.push_back(chain.at(layout.at[k]).radius);
    const auto counts = share_out(inside, radii, 3);
    layout.counts.insert(layout.counts.end(), counts.begin(), counts.end());
  }
  layout.counts.push_back(circles[1]);
  return layout;
}

}  // namespace

PolygonMesh annulus(const AnnulusOptions& options) {
  check_annulus(options);
  const Chain chain = chain_of(options);
  return revolve([&](double length) { return chain.at(length); }, layout_annulus(options, chain),
                 {options.jitter, options.seed});
}

PolygonMesh funnel(Index nodes, Index boundary_nodes) {
  return annulus({.nodes = nodes, .boundary_nodes = boundary_nodes, .profile = Profile::cone});
}

}  // namespace vspring::generate
