#include "closed_chains.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

namespace vspring::cli {

namespace {

/// The turn of a polygon at b, degrees.
double turn_at(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 before = b - a;
  const Vector3 behind = c - b;
  return std::atan2(before.cross(behind).norm(), before.dot(behind)) * 180 / std::numbers::pi;
}

/// The neighbour of a chain's ends at which it turns sharply, if it turns nowhere else nearly so much: one corner of a
/// blunt trailing edge whose other corner is at the ends. −1 if there is none.
Index blunt_corner(const PolygonCurve& curve, const PolygonCurve::Chain& chain) {
  constexpr double least_turn = 45;
  constexpr double times_others = 5;
  const auto place = [&](std::size_t k) { return curve.position(chain.nodes[k]); };
  const std::size_t last = chain.nodes.size() - 1;
  std::vector<double> turns;
  for (std::size_t k = 1; k < last; ++k) turns.push_back(turn_at(place(k - 1), place(k), place(k + 1)));
  const double behind = turns.back();
  const double ahead = turns.front();
  const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle, turns.end());
  const double least = std::max(least_turn, times_others * *middle);
  if (behind > least) return chain.nodes[last - 1];
  if (ahead > least) return chain.nodes[1];
  return -1;
}

/// Whether a chain returns to its start as a smooth ring does, by its way a little before and after.
bool ends_smoothly(const PolygonCurve& curve, const PolygonCurve::Chain& chain) {
  constexpr double greatest_turn = 90;
  constexpr double share_of_way = 0.02;
  const std::size_t count = chain.nodes.size();
  const auto place = [&](std::size_t k) { return curve.position(chain.nodes[k]); };
  double length = 0;
  for (std::size_t k = 1; k < count; ++k) length += (place(k) - place(k - 1)).stableNorm();
  std::size_t behind = count - 1;
  std::size_t ahead = 0;
  for (double way = 0; behind > 1 && way < share_of_way * length; --behind)
    way += (place(behind) - place(behind - 1)).stableNorm();
  for (double way = 0; ahead + 2 < count && way < share_of_way * length; ++ahead)
    way += (place(ahead + 1) - place(ahead)).stableNorm();
  return turn_at(place(behind), place(0), place(ahead)) < greatest_turn;
}

std::string note_of_repeats(const PolygonCurve& curve) {
  constexpr std::size_t fewest = 4;
  const auto repeats = [&](const PolygonCurve::Chain& chain) {
    return !chain.closed && chain.nodes.size() >= fewest && chain.nodes.front() != chain.nodes.back() &&
           curve.position(chain.nodes.front()) == curve.position(chain.nodes.back());
  };
  const auto& chains = curve.chains();
  const auto first = std::find_if(chains.begin(), chains.end(), repeats);
  if (first == chains.end()) return {};
  const auto others = std::count_if(first + 1, chains.end(), repeats);
  const std::string where =
      fmt::format("note: node {} is where node {} is{}", first->nodes.back(), first->nodes.front(),
                  others > 0 ? fmt::format(" (and so in {} more chains)", others) : "");
  if (const Index corner = blunt_corner(curve, *first); corner >= 0)
    return fmt::format(
        "{}, and node {} beside them is a corner, as of a blunt trailing edge, which is rounded off: to keep it, leave "
        "the row out that closes the curve, or part the sides by empty rows\n",
        where, corner);
  if (!ends_smoothly(curve, *first))
    return fmt::format("{}, and the curve stays open there, with its corner; --closed would round that off\n", where);
  return fmt::format(
      "{}, and the curve stays open there; --closed makes the two one node of a smooth closed curve, which rules or a "
      "tolerance then have to hold\n",
      where);
}

}  // namespace

ClosedChains::ClosedChains(PolygonCurve& curve, bool closed) {
  if (closed)
    ends_ = JoinedEnds(curve);
  else
    note_ = note_of_repeats(curve);
}

}  // namespace vspring::cli
