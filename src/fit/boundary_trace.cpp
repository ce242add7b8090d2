#include "fit/boundary_trace.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

#include "base/cancellation.hpp"
#include "base/median.hpp"
#include "base/threads.hpp"
#include "fit/closed_way.hpp"
#include "points/nearest_nodes.hpp"
#include "points/point_sheet.hpp"
#include "shape/boundary.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "shape/incidence.hpp"
#include "shape/point_tree.hpp"
#include "shape/segment.hpp"
#include "vspring/distance.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// The radius of the neighbourhood of a point, as a share of the reach.
constexpr double radius_in_reaches = 0.25;
// In a larger one the nearest plane would leave points on a bend.
constexpr double flat_in_edges = 1;
// Least cosine between the directions in which the points and the surface end; the latter is found from so many edges
// to either side.
constexpr double least_cosine_outwards = 0.3;
constexpr std::size_t edges_about = 2;
// So many times as many are in the loop, as those all around it tell nothing.
constexpr std::size_t least_loop_in_edges = 6;
// In edges: removes waves of two edges, which edges cannot follow.
constexpr double smoothing_in_edges = 1.0 / 3;
// As a share of the loop's length per point at it: between two points nothing is known.
constexpr double smoothing_in_points = 0.5;
// A corner that begins far from its place takes two.
constexpr int turns_of_corners = 2;
// Nodes in a row without points that show where they belong.
constexpr std::size_t fewest_kept = 3;
// In edges, root mean square: a loop that ends further than that from where the points end, and further than before,
// has failed.
constexpr double far_in_edges = 0.25;

/// An edge of the boundary.
struct BoundaryEdge {
  std::size_t loop;
  Vector3 from, to;
  Vector3 out = Vector3::Zero();  ///< away from the surface about there, of unit length; zero where that is not known

  [[nodiscard]] double square_to(const Vector3& place) const {
    return (place - from - nearest_share(place, from, to) * (to - from)).squaredNorm();
  }
};

/// Of edges that are finite.
class EdgeTree {
 public:
  EdgeTree(std::vector<BoundaryEdge> edges, ThreadTeam& team)
      : edges_(std::move(edges)), tree_(boxes_of(edges_), team) {}

  [[nodiscard]] BoxTree::Nearest nearest(const Vector3& place, double within) const {
    return tree_.nearest(
        place, [&](Index k) { return edges_[static_cast<std::size_t>(k)].square_to(place); }, within * within);
  }
  [[nodiscard]] const BoundaryEdge& edge(Index k) const { return edges_[static_cast<std::size_t>(k)]; }

 private:
  static std::vector<Box> boxes_of(const std::vector<BoundaryEdge>& edges) {
    std::vector<Box> boxes(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) boxes[k].extend(edges[k].from).extend(edges[k].to);
    return boxes;
  }

  std::vector<BoundaryEdge> edges_;
  BoxTree tree_;
};

class BoundaryTrace {
 public:
  BoundaryTrace(const PolygonMesh& mesh, const LinesOfSurface& boundary, const ScatteredPoints& points, double reach,
                Context& context)
      : mesh_(mesh),
        boundary_(boundary),
        points_(points),
        reach_(reach),
        context_(context),
        team_(context.thread_count()),
        frame_(box_of(boundary)),
        incidence_(mesh),
        is_free_(mesh.positions().size(), 0) {
    for (const Index i : boundary.free) is_free_[static_cast<std::size_t>(i)] = 1;
    traced_.positions = mesh.positions();
  }

  TracedBoundary run() {
    const CancellationScope cancellation(context_);
    const auto& loops = boundary_.curve.chains();
    std::vector<BoundaryEdge> edges;
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
      const auto of_loop = edges_of(loop);
      edges.insert(edges.end(), of_loop.begin(), of_loop.end());
    }
    const EdgeTree all(std::move(edges), team_);
    for (std::size_t loop = 0; loop < loops.size(); ++loop) {
      const auto& nodes = loops[loop].nodes;
      if (std::any_of(nodes.begin(), nodes.end(), [&](Index i) { return is_free(i); })) trace(loop, all);
    }
    std::sort(traced_.kept.begin(), traced_.kept.end());
    traced_.told.kept = static_cast<Index>(traced_.kept.size());
    return std::move(traced_);
  }

 private:
  static Eigen::AlignedBox<double, 3> box_of(const LinesOfSurface& boundary) {
    Eigen::AlignedBox<double, 3> box;
    for (const auto& loop : boundary.curve.chains()) {
      for (const Index i : loop.nodes) {
        if (boundary.curve.position(i).allFinite()) box.extend(boundary.curve.position(i));
      }
    }
    return box;
  }

  [[nodiscard]] bool is_free(Index node) const { return is_free_[static_cast<std::size_t>(node)] != 0; }

  /// Where a node is as the surface begins.
  [[nodiscard]] Vector3 place(Index node) const {
    return boundary_.of_curve.position_fixed(node) ? boundary_.of_curve.position(node)
                                                   : traced_.positions[static_cast<std::size_t>(node)];
  }

  [[nodiscard]] std::vector<BoundaryEdge> edges_of(std::size_t loop) const {
    const auto& nodes = boundary_.curve.chains()[loop].nodes;
    const std::size_t count = nodes.size();
    std::vector<BoundaryEdge> edges;
    for (std::size_t k = 0; k < count; ++k) {
      BoundaryEdge edge{loop, frame_.to_local(place(nodes[k])), frame_.to_local(place(nodes[(k + 1) % count]))};
      if (!edge.from.allFinite() || !edge.to.allFinite()) continue;
      // Of more edges than one, as noise turns each.
      Vector3 out = Vector3::Zero();
      const std::size_t about = std::min(edges_about, count / least_loop_in_edges);
      const std::size_t first = k + count - about;
      const std::size_t last = k + count + about;
      for (std::size_t other = first; other <= last; ++other)
        out += out_of(nodes[other % count], nodes[(other + 1) % count]);
      const Vector3 along =
          frame_.to_local(place(nodes[(last + 1) % count])) - frame_.to_local(place(nodes[first % count]));
      if (along.squaredNorm() > 0) out -= out.dot(along) / along.squaredNorm() * along;
      if (out.allFinite() && out.squaredNorm() > 0) edge.out = out.normalized();
      edges.push_back(edge);
    }
    return edges;
  }

  /// The direction from the middle of the face at a boundary edge to the middle of the edge.
  [[nodiscard]] Vector3 out_of(Index from, Index to) const {
    for (const Corner corner : incidence_.corners(from)) {
      const auto face = mesh_.face(corner.face);
      const auto at = static_cast<std::size_t>(corner.place);
      if (face[(at + 1) % face.size()] != to && face[(at + face.size() - 1) % face.size()] != to) continue;
      Vector3 middle = Vector3::Zero();
      for (const Index i : face) middle += frame_.to_local(mesh_.position(i));
      return (frame_.to_local(mesh_.position(from)) + frame_.to_local(mesh_.position(to))) / 2 -
             middle / static_cast<double>(face.size());
    }
    return Vector3::Zero();
  }

  void trace(std::size_t loop, const EdgeTree& all) {
    const auto& nodes = boundary_.curve.chains()[loop].nodes;
    std::vector<BoundaryEdge> edges = edges_of(loop);
    std::vector<double> lengths;
    lengths.reserve(edges.size());
    for (const BoundaryEdge& edge : edges) lengths.push_back((edge.to - edge.from).norm());
    const double edge = lengths.empty() ? 0 : median(lengths);
    ScatteredPoints told;
    if (edge > 0) told = listen(loop, edge, EdgeTree(std::move(edges), team_), all);
    if (!told.positions.empty()) {
      const auto free =
          static_cast<double>(std::count_if(nodes.begin(), nodes.end(), [&](Index i) { return is_free(i); }));
      const double apart = edge * free / static_cast<double>(told.positions.size());
      try {
        if (apart <= reach(edge) &&
            draw(nodes, edge / frame_.scale(), told,
                 std::max(smoothing_in_edges * edge, smoothing_in_points * apart) / frame_.scale()))
          return;
      } catch (const Error&) {
        // No curve, as where nodes lie at one place.
      }
      traced_.told.ends -=
          static_cast<Index>(std::count_if(nodes.begin(), nodes.end(), [&](Index i) { return is_free(i); }));
    }
    for (const Index i : nodes) {
      if (is_free(i)) keep(i);
    }
  }

  void keep(Index node) {
    traced_.kept.push_back(node);
    hold(node);
  }

  /// Where it is.
  void hold(Index node) {
    traced_.held.push_back(node);
    is_free_[static_cast<std::size_t>(node)] = 0;
  }

  /// How far from a loop with this median edge points may be.
  [[nodiscard]] double reach(double edge) const {
    return std::max(boundary_reach_in_edges * edge, reach_ * frame_.scale());
  }

  /// Where a loop is by the points, in units of the input.
  ScatteredPoints listen(std::size_t loop, double edge, const EdgeTree& of_loop, const EdgeTree& all) {
    std::vector<Index> number;
    std::vector<Vector3> places;
    std::vector<Vector3> normals;
    std::vector<std::uint8_t> is_near;
    std::vector<Vector3> out;
    // With the points around them, which show whether the points end there.
    const double furthest = 2 * reach(edge);
    for (std::size_t j = 0; j < points_.positions.size(); ++j) {
      end_if_cancelled_at(j);
      if (!points_.weights.empty() && !(points_.weights[j] > 0)) continue;
      const Vector3 local = frame_.to_local(points_.positions[j]);
      const auto nearest = of_loop.nearest(local, furthest);
      if (nearest.item < 0) continue;
      out.push_back(of_loop.edge(nearest.item).out);
      number.push_back(static_cast<Index>(j));
      places.push_back(local);
      if (!points_.normals.empty()) normals.push_back(points_.normals[j]);
      is_near.push_back(std::sqrt(nearest.square) <= reach(edge) &&
                        all.edge(all.nearest(local, furthest).item).loop == loop);
    }
    ScatteredPoints told;
    const PointSheet sheet(places, normals, radius_in_reaches * reach(edge));
    if (places.empty() || sheet.radius() > reach(edge)) return told;
    std::vector<Vector3> border;
    for (std::size_t k = 0; k < places.size(); ++k) {
      end_if_cancelled_at(k);
      if (is_near[k] == 0) continue;
      const auto about = sheet.about(static_cast<Index>(k));
      // Where points have gaps they end as well.
      if (!about || !about->ends || about->out.dot(out[k]) < least_cosine_outwards) continue;
      border.push_back(places[k]);
      const auto j = static_cast<std::size_t>(number[k]);
      const bool is_flat = sheet.radius() <= flat_in_edges * edge;
      told.positions.push_back(is_flat ? with_foot(number[k], places[k], places[k], *about) : points_.positions[j]);
      if (!points_.weights.empty()) told.weights.push_back(points_.weights[j]);
    }
    traced_.told.points += static_cast<Index>(border.size());
    listen_at_nodes(loop, edge, border, places, number, sheet);
    return told;
  }

  void listen_at_nodes(std::size_t loop, double edge, const std::vector<Vector3>& border,
                       const std::vector<Vector3>& places, const std::vector<Index>& number, const PointSheet& sheet) {
    std::vector<Index> free;
    std::vector<Vector3> of_free;
    for (const Index i : boundary_.curve.chains()[loop].nodes) {
      if (!is_free(i)) continue;
      free.push_back(i);
      of_free.push_back(frame_.to_local(mesh_.position(i)));
    }
    const auto nearest_of = [&](const std::vector<Vector3>& those) {
      return nearest_places(of_free, those, std::vector<std::uint8_t>(those.size(), 1), team_);
    };
    const std::vector<Index> at_border = nearest_of(border);
    const std::vector<Index> at_points = nearest_of(places);
    const auto in_reach = [&](std::size_t n, const std::vector<Vector3>& those, Index k) {
      return k >= 0 && (of_free[n] - those[static_cast<std::size_t>(k)]).norm() <= reach(edge);
    };
    std::vector<Index> untold;
    for (std::size_t n = 0; n < free.size(); ++n) {
      if (in_reach(n, border, at_border[n])) {
        ++traced_.told.ends;
        continue;
      }
      const Index k = at_points[n];
      const auto about = in_reach(n, places, k) ? sheet.about(k) : std::nullopt;
      if (!about || about->ends) {
        untold.push_back(free[n]);
        continue;
      }
      ++traced_.told.inside;
      traced_.positions[static_cast<std::size_t>(free[n])] =
          with_foot(number[static_cast<std::size_t>(k)], of_free[n], places[static_cast<std::size_t>(k)], *about);
      hold(free[n]);
    }
    keep_runs(boundary_.curve.chains()[loop].nodes, untold);
  }

  /// Nodes of a loop without points stay; few of these in a row move with those beside them, as they would become
  /// spikes.
  void keep_runs(const std::vector<Index>& nodes, const std::vector<Index>& untold) {
    std::vector<std::uint8_t> is_untold(nodes.size(), 0);
    std::size_t at = 0;
    for (const Index node : untold) {
      while (nodes[at] != node) ++at;
      is_untold[at] = 1;
    }
    const std::size_t count = nodes.size();
    const auto reaches = [&](std::size_t k, std::size_t step) {
      std::size_t steps = 0;
      while (steps < fewest_kept && is_untold[(k + step * (steps + 1)) % count] != 0) ++steps;
      return steps;
    };
    for (std::size_t k = 0; k < count; ++k) {
      if (is_untold[k] == 0) continue;
      if (reaches(k, 1) + reaches(k, count - 1) + 1 >= fewest_kept)
        keep(nodes[k]);
      else
        ++traced_.told.ends;
    }
  }

  /// The distance of a place near a point from the plane about that point; in units of the input.
  [[nodiscard]] Vector3 with_foot(Index point, const Vector3& place, const Vector3& of_point,
                                  const PointSheet::About& about) const {
    return points_.positions[static_cast<std::size_t>(point)] + (about.foot(place) - of_point) / frame_.scale();
  }

  /// Draws a loop to its points. edge, smoothing: in units of the input. False where it ends too far from them.
  bool draw(const std::vector<Index>& nodes, double edge, const ScatteredPoints& told, double smoothing) {
    traced_.smoothing = traced_.smoothing > 0 ? std::min(traced_.smoothing, smoothing) : smoothing;
    Constraints held(static_cast<Index>(nodes.size()));
    std::vector<Vector3> way;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const auto node = static_cast<Index>(k);
      held.hold_as(node, boundary_.of_curve, nodes[k]);
      way.push_back(place(nodes[k]));
      if (!is_free(nodes[k])) held.fix_position(node, way.back());
    }
    const auto fitted = [&] {
      FitOptions options{.criterion = SmoothingLength{smoothing}};
      options.fair.distribution = Distribution::keep;
      FitResult result = fit(PolygonCurve(way, true), held, told, options, context_);
      if (context_.cancelled()) throw Cancelled();
      return std::move(result.positions);
    };
    const std::vector<Vector3> start = way;
    if (way.size() >= fewest_smoothed) way = fitted();
    // So that no square overflows.
    for (Vector3& place : way) place *= frame_.scale();
    const auto faces = [&](std::size_t k) { return incidence_.corners(nodes[k]).size(); };
    // A corner goes to a node with one face up to half of the reach away.
    const double steps = reach(edge * frame_.scale()) / (2 * edge * frame_.scale());
    const auto furthest = static_cast<std::size_t>(std::min(steps, static_cast<double>(nodes.size())));
    for (const std::size_t k : put_at_corners(way, furthest, faces)) {
      const auto node = static_cast<Index>(k);
      if (!held.tangent_fixed(node)) held.make_corner(node);
    }
    space_out(held, way);
    for (Vector3& place : way) place /= frame_.scale();
    for (int turn = 0; turn < turns_of_corners; ++turn) way = fitted();
    const auto off = [&](const std::vector<Vector3>& loop) {
      return distance(told.positions, PolygonCurve(loop, true), context_).rms;
    };
    if (!(off(way) <= std::max(off(start), far_in_edges * edge)) || leaves(nodes, way, told.positions, edge))
      return false;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!is_free(nodes[k])) continue;
      traced_.positions[static_cast<std::size_t>(nodes[k])] = way[k];
      if (held.corner(static_cast<Index>(k))) traced_.corners.push_back(nodes[k]);
    }
    return true;
  }

  /// Whether some free node of a drawn loop is far from all of its points. edge: in units of the input.
  [[nodiscard]] bool leaves(const std::vector<Index>& nodes, const std::vector<Vector3>& way,
                            const std::vector<Vector3>& told, double edge) {
    // So that no square overflows.
    std::vector<Vector3> local;
    local.reserve(told.size());
    for (const Vector3& place : told) local.push_back(frame_.to_local(place));
    const PointTree tree(local);
    std::vector<Index> near;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      if (!is_free(nodes[k])) continue;
      tree.within(frame_.to_local(way[k]), reach(edge * frame_.scale()), near);
      if (near.empty()) return true;
    }
    return false;
  }

  const PolygonMesh& mesh_;
  const LinesOfSurface& boundary_;
  const ScatteredPoints& points_;
  double reach_;
  Context& context_;
  ThreadTeam team_;
  Frame frame_;
  Incidence incidence_;
  std::vector<std::uint8_t> is_free_;
  TracedBoundary traced_;
};

}  // namespace

TracedBoundary trace_boundary(const PolygonMesh& mesh, const LinesOfSurface& boundary, const ScatteredPoints& points,
                              double reach, Context& context) {
  return BoundaryTrace(mesh, boundary, points, reach, context).run();
}

}  // namespace vspring
