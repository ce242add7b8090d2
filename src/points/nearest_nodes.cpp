#include "points/nearest_nodes.hpp"

#include <fmt/format.h>

#include <cmath>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"
#include "shape/box_tree.hpp"
#include "shape/frame.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

/// frame: coordinates in which squares neither overflow nor vanish.
std::vector<Index> nearest_in(const Frame& frame, std::span<const Vector3> points, std::span<const Vector3> nodes,
                              std::span<const std::uint8_t> usable, ThreadTeam& team, const Preference& preference) {
  constexpr std::size_t points_per_task = 512;
  std::vector<Index> number;
  std::vector<Vector3> places;
  std::vector<Box> boxes;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    end_if_cancelled_at(i);
    if (usable[i] == 0 || !nodes[i].allFinite()) continue;
    number.push_back(static_cast<Index>(i));
    boxes.emplace_back(places.emplace_back(frame.to_local(nodes[i])));
  }
  const BoxTree tree(std::move(boxes), team);
  std::vector<Index> nearest(points.size(), -1);
  if (number.empty()) return nearest;
  parallel_ranges(team, points.size(), points_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t j = begin; j < end; ++j) {
      const Vector3 point = frame.to_local(points[j]);
      const auto square = [&](Index k) { return (places[static_cast<std::size_t>(k)] - point).squaredNorm(); };
      const auto found = tree.nearest(point, square);
      if (found.item < 0) continue;  // squares overflowed
      nearest[j] = number[static_cast<std::size_t>(found.item)];
      const auto content = [&](Index k) {
        return preference.content(j, static_cast<std::size_t>(number[static_cast<std::size_t>(k)]));
      };
      if (!preference.content || content(found.item)) continue;
      const double furthest = 2 * std::sqrt(found.square) + frame.scale() * preference.reach;
      const auto preferred = tree.nearest(
          point, [&](Index k) { return content(k) ? square(k) : std::numeric_limits<double>::infinity(); },
          furthest * furthest);
      if (preferred.item >= 0) nearest[j] = number[static_cast<std::size_t>(preferred.item)];
    }
  });
  return nearest;
}

}  // namespace

std::vector<Index> nearest_nodes(std::span<const Vector3> points, std::span<const Vector3> nodes,
                                 std::span<const std::uint8_t> usable, ThreadTeam& team, const Preference& preference) {
  Box around;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (usable[i] != 0) around.extend(nodes[i]);
  }
  const Frame frame(around);
  for (std::size_t j = 0; j < points.size(); ++j) {
    end_if_cancelled_at(j);
    if (!(frame.to_local(points[j]).cwiseAbs().maxCoeff() <= furthest_point))
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("point {} lies more than {:g} times the size of the shape away from it; leave it out, or "
                              "look at its units",
                              j, furthest_point));
  }
  return nearest_in(frame, points, nodes, usable, team, preference);
}

std::vector<Index> nearest_places(std::span<const Vector3> points, std::span<const Vector3> nodes,
                                  std::span<const std::uint8_t> usable, ThreadTeam& team,
                                  const Preference& preference) {
  return nearest_in(Frame(), points, nodes, usable, team, preference);
}

}  // namespace vspring
