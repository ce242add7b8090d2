// Checks that a curve can be faired under its constraints, and whether these determine one result.

#include <fmt/format.h>

#include <algorithm>

#include "constraints/holding.hpp"
#include "constraints/sides.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// A circle in space has six unknowns, as many as three points determine; a point with a tangent counts as two.
constexpr int data_for_a_circle = 3;

class CurveHolding {
 public:
  CurveHolding(const PolygonCurve& curve, const Constraints& constraints, std::span<const std::uint8_t> pulled)
      : curve_(curve), constraints_(constraints), pulled_(pulled) {}

  std::vector<Warning> check() {
    std::vector<Index> bare;
    refuse_sliding(constraints_, "it is of a curve, and nodes of surfaces slide");
    refuse_meetings();
    for (const auto& chain : curve_.chains()) {
      const auto moving = std::find_if(chain.nodes.begin(), chain.nodes.end(), [&](Index i) { return moves(i); });
      if (moving == chain.nodes.end()) continue;
      refuse_defects(chain);
      if (chain.closed) {
        check_loop(chain, *moving);
      } else {
        for (const Index end : {chain.nodes.front(), chain.nodes.back()}) {
          if (!held(end)) refuse_free_end(end);
        }
        if (loses_its_shape(chain)) bare.push_back(*moving);
      }
    }
    if (!bare.empty())
      warnings_.push_back(
          {WarningCode::only_ends_held,
           fmt::format("nothing but its ends holds the curve through node {}{}: what is fairest between them is "
                       "straight",
                       bare.front(), bare.size() > 1 ? fmt::format(", and {} more", bare.size() - 1) : ""),
           {{Remedy::rules, "hold more nodes or directions by a rule"},
            {Remedy::within, "give a tolerance to stay within"}}});
    return std::move(warnings_);
  }

 private:
  [[nodiscard]] bool moves(Index node) const { return !constraints_.position_fixed(node); }
  [[nodiscard]] bool held(Index node) const {
    return !moves(node) || (!pulled_.empty() && pulled_[static_cast<std::size_t>(node)] != 0);
  }

  void refuse_meetings() const {
    std::vector<std::uint8_t> seen(static_cast<std::size_t>(curve_.node_count()), 0);
    for (const auto& chain : curve_.chains()) {
      for (const Index node : chain.nodes) {
        std::uint8_t& before = seen[static_cast<std::size_t>(node)];
        if (before != 0 && moves(node))
          throw Error(ErrorCode::unusable_shape, fmt::format("node {}: chains meet there, so it cannot move", node),
                      {{Remedy::rules,
                        fmt::format("hold it by a rule such as {{\"nodes\": [{}], \"position\": \"fixed\"}}", node)}});
        before = 1;
      }
    }
  }

  void refuse_defects(const PolygonCurve::Chain& chain) const {
    if (chain.closed && chain.nodes.size() < 3)
      throw Error(ErrorCode::unusable_shape,
                  fmt::format("node {}: a closed curve needs three nodes or more, this has {}", chain.nodes.front(),
                              chain.nodes.size()));
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      const Index node = chain.nodes[k];
      const Vector3& position = moves(node) ? curve_.position(node) : constraints_.position(node);
      if (position.allFinite()) continue;
      for (std::size_t step = 0; step <= 4; ++step) {
        const std::size_t other = (k + count + step - 2) % count;
        if ((chain.closed || (k + step >= 2 && k + step - 2 < count)) && moves(chain.nodes[other]))
          throw Error(ErrorCode::unusable_shape, fmt::format("node {}: a coordinate is not finite", node),
                      {{Remedy::rules, "give it a position by a rule"},
                       {Remedy::region, "let only a region move, one away from it"}});
      }
    }
  }

  [[noreturn]] static void refuse_free_end(Index end) {
    throw Error(ErrorCode::unusable_constraint, fmt::format("the end node {} is free, and the curve would shrink", end),
                {{Remedy::fix_boundary, "fix the ends"},
                 {Remedy::rules, "hold it by a rule"},
                 {Remedy::region, "let only a region move"}});
  }

  /// Whether only its ends hold it, and it leaves the line between them by more than the length of its edges; less is
  /// noise.
  [[nodiscard]] bool loses_its_shape(const PolygonCurve::Chain& chain) const {
    const auto is_given = [&](Index node) {
      return constraints_.tangent_fixed(node) || constraints_.normal_fixed(node);
    };
    if (std::any_of(chain.nodes.begin(), chain.nodes.end(), is_given)) return false;
    if (std::count_if(chain.nodes.begin(), chain.nodes.end(), [&](Index node) { return held(node); }) != 2)
      return false;
    const auto place = [&](Index node) { return moves(node) ? curve_.position(node) : constraints_.position(node); };
    const Vector3 first = place(chain.nodes.front());
    const Vector3 chord = place(chain.nodes.back()) - first;
    double length = 0;
    double furthest = 0;
    Vector3 last = first;
    for (const Index node : chain.nodes) {
      const Vector3 here = place(node);
      length += (here - last).norm();
      last = here;
      const double along = chord.squaredNorm() > 0 ? (here - first).dot(chord) / chord.squaredNorm() : 0;
      furthest = std::max(furthest, (here - first - std::clamp(along, 0.0, 1.0) * chord).norm());
    }
    return furthest * static_cast<double>(chain.nodes.size() - 1) > length;
  }

  void check_loop(const PolygonCurve::Chain& chain, Index moving) {
    int holding = 0;
    int data = 0;
    for (const Index node : chain.nodes) {
      holding += held(node) ? 1 : 0;
      data += (held(node) ? 1 : 0) + (constraints_.tangent_fixed(node) || constraints_.normal_fixed(node) ? 1 : 0);
    }
    if (holding == 0)
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("nothing holds the closed curve through node {} ({} nodes): it would become a circle or "
                              "shrink",
                              moving, chain.nodes.size()),
                  {{Remedy::rules, "hold some of its nodes by a rule"},
                   {Remedy::region, "let only a region move"},
                   {Remedy::within, "give a tolerance to stay within"}});
    if (data < data_for_a_circle)
      warnings_.push_back(
          {WarningCode::family_of_shapes,
           fmt::format(
               "what holds the closed curve through node {} leaves a family of shapes, and the result is one of "
               "them",
               moving),
           {{Remedy::rules, "hold more nodes, or tangents, to choose"}}});
  }

  const PolygonCurve& curve_;
  const Constraints& constraints_;
  std::span<const std::uint8_t> pulled_;
  std::vector<Warning> warnings_;
};

}  // namespace

std::vector<Warning> check_constraints(const PolygonCurve& curve, const Constraints& constraints) {
  check_corners(curve, constraints);
  if (constraints.corner_count() == 0) return check_sides(curve, constraints);
  const Sides sides = cut_into_sides(curve, constraints);
  return check_sides(sides.curve, sides.held);
}

std::vector<Warning> check_constraints(const PolygonCurve& curve, const Constraints& constraints,
                                       std::span<const std::uint8_t> pulled) {
  check_corners(curve, constraints);
  return CurveHolding(curve, constraints, pulled).check();
}

std::vector<Warning> check_sides(const PolygonCurve& sides, const Constraints& held) {
  return CurveHolding(sides, held, {}).check();
}

}  // namespace vspring
