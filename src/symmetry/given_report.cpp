#include "symmetry/given_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

#include "constraints/sides.hpp"
#include "symmetry/reach.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

/// Counts of nodes on the plane, which a half shares with its mirror image.
template <typename Shape, typename Count>
Index count_on_plane(const Symmetric<Shape>& shape, const Count& count) {
  Index sum = 0;
  for (Index i = 0; i < shape.whole.node_count(); ++i)
    sum += shape.partner[static_cast<std::size_t>(i)] == i ? static_cast<Index>(count(i)) : 0;
  return sum;
}

template <typename Shape>
void measure_given_moves(const Symmetric<Shape>& shape, const Constraints& held, const std::vector<Vector3>& positions,
                         FairReport& report) {
  double squares = 0;
  report.greatest_move = 0;
  for (Index i = 0; i < shape.given.node_count(); ++i) {
    if (held.position_fixed(i) || shape.partner[static_cast<std::size_t>(i)] < 0) continue;
    const double move = (positions[static_cast<std::size_t>(i)] - shape.given.position(i)).norm();
    report.greatest_move = std::max(report.greatest_move, move);
    squares += move * move;
  }
  report.rms_move = std::sqrt(squares / std::max<double>(1, report.moving_nodes));
}

/// How many free nodes of the boundary of the whole are on the plane.
Index boundary_on_plane(const Symmetric<PolygonMesh>& shape, const Constraints& held) {
  const auto boundary = boundary_nodes(shape.whole);
  return count_on_plane(shape,
                        [&](Index i) { return boundary[static_cast<std::size_t>(i)] != 0 && !held.position_fixed(i); });
}

/// Where a half goes through the plane it goes through its mirror image. The number of faces that cross does not show
/// that, as the input may have had as many elsewhere.
template <typename Shape>
void warn_if_beyond(const Symmetric<Shape>& shape, const Constraints& held, const std::vector<Vector3>& positions,
                    FairReport& report) {
  Index count = 0;
  Index furthest = -1;
  double most = nearness_on_plane(shape);
  const double near = most;
  for (Index i = 0; i < shape.given.node_count(); ++i) {
    const Index partner = shape.partner[static_cast<std::size_t>(i)];
    if (partner < 0 || partner == i) continue;
    const double side = shape.plane.distance(shape.given.position(i)) > 0 ? 1 : -1;
    const double beyond = -side * shape.plane.distance(positions[static_cast<std::size_t>(i)]);
    if (!(beyond > near)) continue;
    // A constraint wants it there.
    if (held.position_fixed(i)) return;
    ++count;
    if (beyond > most) furthest = i;
    most = std::max(most, beyond);
  }
  if (count == 0) return;
  if (report.outcome == Outcome::converged) report.outcome = Outcome::worse_than_input;
  report.warnings.push_back(
      {WarningCode::worse_than_input,
       fmt::format("the shape goes through {}, and so through its mirror image: {} node{} beyond it, node {} by {:.4g}",
                   in_words(shape.plane), count, count == 1 ? " is" : "s are", furthest, most),
       {{Remedy::rules, "hold more nodes"}, {Remedy::within, "let them stay nearer to the input"}}});
}

}  // namespace

template <typename Shape>
std::vector<Vector3> given_positions(const Symmetric<Shape>& shape, const Constraints& held,
                                     std::vector<Vector3>& of_whole, Leading leading) {
  make_symmetric(shape, of_whole, leading);
  for (Index i = 0; i < held.node_count(); ++i) {
    if (held.position_fixed(i)) of_whole[static_cast<std::size_t>(i)] = held.position(i);
  }
  return {of_whole.begin(), of_whole.begin() + shape.given.node_count()};
}

template <typename Shape>
void report_what_was_given(const Symmetric<Shape>& shape, const Constraints& held, const GivenNumbers& numbers,
                           const std::vector<Vector3>& positions, bool accept_worse, FairReport& report) {
  name_what_was_given(report.warnings, numbers);
  if (shape.is_half) {
    const auto on_plane = [&](const auto& count) { return count_on_plane(shape, count); };
    report.nodes = shape.given.node_count();
    if constexpr (std::is_same_v<Shape, PolygonMesh>) {
      report.faces = shape.given.face_count();
      if (report.boundary) {
        auto boundary = std::make_shared<FairReport>(*report.boundary);
        boundary->moving_nodes = of_half(boundary->moving_nodes, boundary_on_plane(shape, held));
        boundary->nodes = report.nodes;
        name_what_was_given(boundary->warnings, numbers);
        report.boundary = std::move(boundary);
      }
    }
    report.moving_nodes = of_half(report.moving_nodes, on_plane([&](Index i) { return !held.position_fixed(i); }));
    report.fixed_positions = of_half(report.fixed_positions, on_plane([&](Index i) { return held.position_fixed(i); }));
    report.sliding_nodes = of_half(report.sliding_nodes, on_plane([&](Index i) { return held.support(i) != nullptr; }));
    report.fixed_normals = of_half(report.fixed_normals, on_plane([&](Index i) { return held.normal_fixed(i); }));
    report.fixed_tangents = of_half(report.fixed_tangents, on_plane([&](Index i) { return tangents_given(held, i); }));
    report.corners = of_half(report.corners, on_plane([&](Index i) { return held.corner(i); }));
    if (!accept_worse) warn_if_beyond(shape, held, positions, report);
  }
  measure_given_moves(shape, held, positions, report);
}

template <typename Shape>
FairOptions with_marks_of_both(const Symmetric<Shape>& shape, FairOptions options) {
  // −1 for nodes that are refused later.
  const auto image_of = [&](Index node) {
    return node < 0 || node >= shape.whole.node_count() ? -1 : shape.partner[static_cast<std::size_t>(node)];
  };
  std::vector<std::uint8_t> is_corner(shape.whole.positions().size(), 0);
  const std::size_t corners = options.corners.size();
  for (const Index node : options.corners) {
    if (image_of(node) >= 0) is_corner[static_cast<std::size_t>(node)] = 1;
  }
  for (std::size_t k = 0; k < corners; ++k) {
    const Index image = image_of(options.corners[k]);
    if (image >= 0 && is_corner[static_cast<std::size_t>(image)] == 0) options.corners.push_back(image);
  }
  const std::size_t edges = options.sharp_edges.size();
  for (std::size_t k = 0; k < edges; ++k) {
    const Index a = image_of(options.sharp_edges[k].first);
    const Index b = image_of(options.sharp_edges[k].second);
    if (a >= 0 && b >= 0) options.sharp_edges.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(options.sharp_edges.begin(), options.sharp_edges.end());
  options.sharp_edges.erase(std::unique(options.sharp_edges.begin(), options.sharp_edges.end()),
                            options.sharp_edges.end());
  return options;
}

template std::vector<Vector3> given_positions(const Symmetric<PolygonMesh>&, const Constraints&, std::vector<Vector3>&,
                                              Leading);
template std::vector<Vector3> given_positions(const Symmetric<PolygonCurve>&, const Constraints&, std::vector<Vector3>&,
                                              Leading);
template void report_what_was_given(const Symmetric<PolygonMesh>&, const Constraints&, const GivenNumbers&,
                                    const std::vector<Vector3>&, bool, FairReport&);
template void report_what_was_given(const Symmetric<PolygonCurve>&, const Constraints&, const GivenNumbers&,
                                    const std::vector<Vector3>&, bool, FairReport&);
template FairOptions with_marks_of_both(const Symmetric<PolygonMesh>&, FairOptions);
template FairOptions with_marks_of_both(const Symmetric<PolygonCurve>&, FairOptions);

}  // namespace vspring
