#include "curve_fit/gentle_curve.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

#include "base/threads.hpp"
#include "curve_fit/curvature_swings.hpp"
#include "curve_fit/planar_polygon.hpp"
#include "linear/band_program.hpp"
#include "shape/box_tree.hpp"

namespace vspring {

namespace {

using Vector2 = Eigen::Vector2d;

// Of the tolerance, so that what is not linear in a step does not go beyond.
constexpr double aimed_share_of_tolerance = 0.995;
constexpr int most_newton_steps = 8;
// Of the variation, in a step: what changes less is there.
constexpr double settled_variation = 0.01;
// Of edges, in a step.
constexpr double greatest_turn_of_step = 0.3;
// Of a bound: what a program may miss that the next step may make good.
constexpr double tolerable_miss = 1e-2;
// Of the tolerance: points that are nearer to a node than that tell nothing of the direction to it.
constexpr double next_to_nothing = 1e-3;
// Swings that are tried to be left out, from the least on, and by how much variation may rise for one.
constexpr std::size_t most_ranks = 4;
constexpr double greatest_rise_of_variation = 4;
constexpr int most_programs_for_swings = 60;
// The spacing by the inverse root of curvature that changes of curvature are weighed by: as of so many nodes, wider by
// no more than so much along a length.
constexpr double nodes_of_spacing = 120;
constexpr double steepest_spacing = 0.25;
constexpr double least_share_of_mean_curvature = 0.5;

class GentleCurve {
 public:
  GentleCurve(PlanarPolygon polygon, std::span<const Vector3> points, double tolerance, LeastVariation least,
              Context& context)
      : polygon_(std::move(polygon)),
        context_(context),
        team_(context.thread_count()),
        bound_(tolerance * polygon_.scale()) {
    for (const Vector3& point : points) points_.push_back(polygon_.flat(point));
    find_spacing();
    if (least == LeastVariation::in_all) {
      for (std::vector<double>& spacing : spacing_) std::fill(spacing.begin(), spacing.end(), 1.0);
    }
    measure();
  }

  [[nodiscard]] const PlanarPolygon& polygon() const { return polygon_; }

  bool run(std::size_t most_extremes) {
    if (!go({})) return false;
    leave_out_swings(most_extremes);
    return !context_.cancelled();
  }

 private:
  /// How a point's distance, with its sign, changes where the nodes of its nearest edge go.
  struct PointRow {
    double distance;
    PlanarPolygon::Edge nodes;
    std::array<double, 2> slopes;
  };

  /// For every station, relative to the mean.
  void find_spacing() {
    for (const CurvatureRun& run : polygon_.runs()) {
      const std::size_t count = run.stations.size();
      double turned = 0;
      double length = 0;
      for (const CurvatureStation& one : run.stations) {
        turned += std::abs(one.curvature) * one.length;
        length += one.length;
      }
      const double floor = turned > 0 ? least_share_of_mean_curvature * turned / length : 1;
      std::vector<double>& spacing = spacing_.emplace_back(count);
      if (count == 0) continue;
      double nodes = 0;
      for (std::size_t k = 0; k < count; ++k) {
        spacing[k] = 1 / std::sqrt(floor + std::abs(run.stations[k].curvature));
        nodes += run.stations[k].length / spacing[k];
      }
      for (double& one : spacing) one *= nodes / nodes_of_spacing;
      // Around a closed run a second time, as it begins anywhere.
      for (int around = 0; around < (run.closed ? 2 : 1); ++around) {
        for (std::size_t k = 0; k < run.link_count(); ++k)
          lower(spacing[(k + 1) % count], spacing[k] + steepest_spacing * run.step(k));
        for (std::size_t k = run.link_count(); k-- > 0;)
          lower(spacing[k], spacing[(k + 1) % count] + steepest_spacing * run.step(k));
      }
      for (double& one : spacing) one *= nodes_of_spacing / length;
    }
  }

  static void lower(double& value, double most) { value = std::min(value, most); }

  /// Calls use(run, k, weight of the change from its station k to the next), in order.
  template <typename Use>
  void for_each_link(const Use& use) const {
    for (std::size_t r = 0; r < polygon_.runs().size(); ++r) {
      const CurvatureRun& run = polygon_.runs()[r];
      for (std::size_t k = 0; k < run.link_count(); ++k) {
        const double spacing = (spacing_[r][k] + spacing_[r][(k + 1) % run.stations.size()]) / 2;
        const double step = run.step(k);
        use(run, k, step > 0 ? spacing * spacing / std::sqrt(step) : 0);
      }
    }
  }

  void measure() {
    measure_points();
    variation_ = 0;
    std::size_t links = 0;
    for_each_link([&](const CurvatureRun& run, std::size_t k, double weight) {
      const double change = weight * (run.next(k).curvature - run.stations[k].curvature);
      variation_ += change * change;
      ++links;
    });
    typical_change_ = std::sqrt(variation_ / static_cast<double>(std::max<std::size_t>(links, 1)));
  }

  void measure_points() {
    const std::vector<PlanarPolygon::Edge>& edges = polygon_.edges();
    const auto up = [](const Vector2& place) { return Vector3(place.x(), place.y(), 0); };
    std::vector<Box> boxes(edges.size());
    for (std::size_t k = 0; k < edges.size(); ++k) {
      for (const std::uint32_t node : edges[k]) boxes[k].extend(up(polygon_.place(node)));
    }
    const BoxTree tree(std::move(boxes), team_);
    rows_.clear();
    greatest_ = 0;
    for (const Vector2& point : points_) {
      const auto share_on = [&](const PlanarPolygon::Edge& edge) {
        const Vector2 d = polygon_.place(edge[1]) - polygon_.place(edge[0]);
        return std::clamp((point - polygon_.place(edge[0])).dot(d) / d.squaredNorm(), 0.0, 1.0);
      };
      const auto from_point = [&](const PlanarPolygon::Edge& edge, double share) -> Vector2 {
        return (1 - share) * polygon_.place(edge[0]) + share * polygon_.place(edge[1]) - point;
      };
      const auto nearest = tree.nearest(up(point), [&](Index k) {
        const PlanarPolygon::Edge& edge = edges[static_cast<std::size_t>(k)];
        return from_point(edge, share_on(edge)).squaredNorm();
      });
      const PlanarPolygon::Edge& edge = edges[static_cast<std::size_t>(nearest.item)];
      const double share = share_on(edge);
      add_row(edge, share, from_point(edge, share));
    }
  }

  /// offset: from the point to the place at this share of the edge.
  void add_row(const PlanarPolygon::Edge& edge, double share, const Vector2& offset) {
    const double distance = offset.norm();
    greatest_ = std::max(greatest_, distance);
    const Vector2 along = polygon_.place(edge[1]) - polygon_.place(edge[0]);
    Vector2 across = Vector2(-along.y(), along.x()).normalized();
    if ((share == 0 || share == 1) && distance > next_to_nothing * bound_)
      across = offset * ((offset.dot(across) < 0 ? -1 : 1) / distance);
    const PointRow row{
        offset.dot(across),
        edge,
        {(1 - share) * across.dot(polygon_.normal(edge[0])), share * across.dot(polygon_.normal(edge[1]))}};
    // What is held cannot go nearer.
    if (row.slopes[0] != 0 || row.slopes[1] != 0) rows_.push_back(row);
  }

  /// Adds the ways of nodes, each times a number, to a row; false where none of them moves.
  bool fill(BandRow& row, std::span<const std::uint32_t> nodes, std::span<const double> slopes) const {
    std::uint32_t first = PlanarPolygon::held;
    for (const std::uint32_t node : nodes) first = std::min(first, polygon_.column(node));
    if (first == PlanarPolygon::held) return false;
    row.first = first;
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const std::uint32_t column = polygon_.column(nodes[k]);
      if (column != PlanarPolygon::held) row.entries[column - first] += slopes[k];
    }
    return true;
  }

  /// senses: of every link; empty: any.
  [[nodiscard]] BandProgram program(std::span<const int> senses) const {
    BandProgram result;
    result.size = polygon_.column_count();
    result.width = polygon_.column_width();
    std::size_t link = 0;
    for_each_link([&](const CurvatureRun& run, std::size_t k, double weight) {
      const CurvatureStation& a = run.stations[k];
      const CurvatureStation& b = run.next(k);
      const int sense = senses.empty() ? 0 : senses[link++];
      std::array<std::uint32_t, 6> nodes;
      std::array<double, 6> slopes;
      for (std::size_t n = 0; n < 3; ++n) {
        nodes[n] = a.nodes[n];
        nodes[3 + n] = b.nodes[n];
        slopes[n] = -weight * a.slopes[n];
        slopes[3 + n] = weight * b.slopes[n];
      }
      BandRow row{.offset = weight * (b.curvature - a.curvature)};
      if (!fill(row, nodes, slopes)) return;
      result.terms.push_back(row);
      if (sense == 0 || !(typical_change_ > 0)) return;
      for (double& entry : row.entries) entry *= sense / typical_change_;
      row.offset *= sense / typical_change_;
      result.positive.push_back(row);
    });
    const double unit = 1 / (aimed_share_of_tolerance * bound_);
    for (const PointRow& point : rows_) {
      BandRow row{.offset = unit * point.distance};
      if (fill(row, point.nodes, std::array{unit * point.slopes[0], unit * point.slopes[1]}))
        result.between.push_back(row);
    }
    return result;
  }

  void take_step(const std::vector<double>& ways) {
    const auto way = [&](std::uint32_t node) -> Vector2 {
      const std::uint32_t column = polygon_.column(node);
      return column == PlanarPolygon::held ? Vector2::Zero() : Vector2(ways[column] * polygon_.normal(node));
    };
    double share = 1;
    for (const PlanarPolygon::Edge& edge : polygon_.edges()) {
      const double length = (polygon_.place(edge[1]) - polygon_.place(edge[0])).norm();
      const double turn = (way(edge[1]) - way(edge[0])).norm() / length;
      if (turn > greatest_turn_of_step) share = std::min(share, greatest_turn_of_step / turn);
    }
    std::vector<Vector2> places = polygon_.places();
    for (std::size_t i = 0; i < places.size(); ++i) places[i] += share * way(static_cast<std::uint32_t>(i));
    go_to(std::move(places));
  }

  void go_to(std::vector<Vector2> places) {
    polygon_.set_places(std::move(places));
    measure();
  }

  /// To the curve of least variation, by Newton's method; goes there, or back where none is found.
  bool go(std::span<const int> senses) {
    std::vector<Vector2> best = polygon_.places();
    double least = std::numeric_limits<double>::infinity();
    double before = least;
    for (int step = 0; step < most_newton_steps && !context_.cancelled(); ++step) {
      ++programs_;
      const BandSolution solution = solve(program(senses));
      if (!solution.found && !(solution.miss < tolerable_miss)) break;
      take_step(solution.x);
      if (!std::isfinite(variation_)) break;
      if (greatest_ <= bound_) {
        if (variation_ < least) {
          least = variation_;
          best = polygon_.places();
        }
        if (std::abs(variation_ - before) <= settled_variation * variation_) break;
      }
      before = variation_;
    }
    go_to(std::move(best));
    return std::isfinite(least);
  }

  void leave_out_swings(std::size_t most_extremes) {
    std::size_t rank = 0;
    while (rank < most_ranks && programs_ < most_programs_for_swings && !context_.cancelled()) {
      const CurvatureSwings swings(polygon_.runs());
      if (swings.extremes() <= most_extremes) return;
      const auto senses = swings.without(rank);
      if (!senses) return;
      const std::vector<Vector2> places = polygon_.places();
      const double variation = variation_;
      const bool found = go(*senses) && variation_ < greatest_rise_of_variation * variation &&
                         CurvatureSwings(polygon_.runs()).extremes() < swings.extremes();
      rank = found ? 0 : rank + 1;
      if (!found) go_to(places);
    }
  }

  PlanarPolygon polygon_;
  Context& context_;
  ThreadTeam team_;
  double bound_;
  std::vector<Vector2> points_;
  std::vector<std::vector<double>> spacing_;  ///< of every station of each run
  std::vector<PointRow> rows_;
  double greatest_ = 0;  ///< distance of a point
  double variation_ = 0;
  double typical_change_ = 0;
  int programs_ = 0;
};

}  // namespace

std::optional<std::vector<Vector3>> gentle_curve(const PolygonCurve& start, const Constraints& constraints,
                                                 std::span<const Vector3> points, double tolerance,
                                                 std::size_t most_extremes, Context& context, LeastVariation least) {
  auto polygon = PlanarPolygon::of(start, constraints, points);
  if (!polygon) return std::nullopt;
  GentleCurve gentle(std::move(*polygon), points, tolerance, least, context);
  if (!gentle.run(most_extremes)) return std::nullopt;
  return gentle.polygon().lifted(start.positions());
}

}  // namespace vspring
