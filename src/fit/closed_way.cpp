#include "fit/closed_way.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace vspring {

namespace {

// Corners turn by so much more, within three nodes, than the way beside them; in a way of few nodes they turn by so
// much.
constexpr double least_turn = 40 * std::numbers::pi / 180;
constexpr double turn_of_few = std::numbers::pi / 3;
// Edges whose directions differ by less do not meet.
constexpr double least_sine2 = 0.1;
// Edges become as long as those beside them on average, so many times.
constexpr int turns_of_spacing = 8;
// How many places on either side are moved for each place by which a corner moves; a corner moves by at most one of so
// many places.
constexpr std::ptrdiff_t places_of_room = 3;
constexpr std::size_t least_share_of_way = 32;

/// By how many places a corner moves on, backwards if negative: to the next place, if that has fewer faces, or to one
/// up to `furthest` places away with a single face, which would be flat on a straight side. 0 if it stays.
std::ptrdiff_t way_to_fewer_faces(std::size_t from, std::size_t count, std::size_t furthest,
                                  const FacesAtPlace& faces) {
  for (std::size_t by = 1; by <= furthest; ++by) {
    const std::size_t least = by > 1 ? std::min(faces(from), std::size_t{2}) : faces(from);
    const std::size_t before = faces((from + count - by) % count);
    const std::size_t after = faces((from + by) % count);
    if (std::min(before, after) >= least) continue;
    return after < before ? static_cast<std::ptrdiff_t>(by) : -static_cast<std::ptrdiff_t>(by);
  }
  return 0;
}

/// Moves a node of a way a few places on; those beside it are shifted.
void pass_on(std::vector<Vector3>& way, std::size_t from, std::ptrdiff_t by) {
  const std::vector<Vector3> old = way;
  const auto count = static_cast<std::ptrdiff_t>(way.size());
  const std::ptrdiff_t room = places_of_room * std::abs(by);
  const auto wrapped = [&](std::ptrdiff_t k) { return static_cast<std::size_t>((k % count + count) % count); };
  const auto first = static_cast<std::ptrdiff_t>(from);
  for (std::ptrdiff_t k = std::min(by, std::ptrdiff_t{0}) - room; k <= std::max(by, std::ptrdiff_t{0}) + room; ++k) {
    // Between the places that stay and the one that is passed on.
    const std::ptrdiff_t end = k < by ? std::min(by, std::ptrdiff_t{0}) - room : std::max(by, std::ptrdiff_t{0}) + room;
    const double source = static_cast<double>(end) * static_cast<double>(k - by) / static_cast<double>(end - by);
    const auto lower = static_cast<std::ptrdiff_t>(std::floor(source));
    const double share = source - static_cast<double>(lower);
    way[wrapped(first + k)] = (1 - share) * old[wrapped(first + lower)] + share * old[wrapped(first + lower + 1)];
  }
}

/// Finds where the edges about three places of a way would meet. The nearest of these places goes there, or one near it
/// with fewer faces, as others would have straight angles in their faces.
std::size_t put_at_corner(std::vector<Vector3>& way, std::size_t about, std::size_t furthest,
                          const FacesAtPlace& faces) {
  const std::size_t count = way.size();
  const auto step = [&](std::size_t k, std::size_t by) { return (k + by) % count; };
  const Vector3& before = way[step(about, count - 1)];
  const Vector3& after = way[step(about, 1)];
  const Vector3 in = (before - way[step(about, count - 2)]).normalized();
  const Vector3 out = (after - way[step(about, 2)]).normalized();
  std::size_t nearest = about;
  const double cosine = in.dot(out);
  const double sine2 = 1 - cosine * cosine;
  if (sine2 > least_sine2) {
    // The middle between two lines, where these are nearest to each other.
    const Vector3 gap = after - before;
    const double way_in = (gap.dot(in) - cosine * gap.dot(out)) / sine2;
    const double way_out = (cosine * gap.dot(in) - gap.dot(out)) / sine2;
    const Vector3 corner = (before + way_in * in + after + way_out * out) / 2;
    const auto distance = [&](std::size_t k) { return (way[k] - corner).squaredNorm(); };
    if (4 * distance(about) < gap.squaredNorm()) {
      for (const std::size_t by : {count - 1, std::size_t{1}}) {
        if (distance(step(about, by)) < distance(nearest)) nearest = step(about, by);
      }
      way[nearest] = corner;
    }
  }
  const std::ptrdiff_t by = way_to_fewer_faces(
      nearest, count, std::min(furthest, std::max(std::size_t{1}, count / least_share_of_way)), faces);
  if (by == 0) return nearest;
  pass_on(way, nearest, by);
  return (nearest + count + static_cast<std::size_t>(by)) % count;
}

void space_out_between(const std::vector<Vector3>& before, std::size_t begin, std::size_t end,
                       std::vector<Vector3>& way) {
  const auto at = [&](std::size_t k) { return before[k % before.size()]; };
  std::vector<double> lengths;
  for (std::size_t k = begin; k < end; ++k) lengths.push_back((at(k + 1) - at(k)).norm());
  std::vector<double> even = lengths;
  for (int turn = 0; turn < turns_of_spacing; ++turn) {
    const std::vector<double> last = even;
    for (std::size_t k = 0; k < even.size(); ++k)
      even[k] = (last[k > 0 ? k - 1 : k] + last[k] + last[std::min(k + 1, even.size() - 1)]) / 3;
  }
  // The sum stays.
  double wanted = 0;
  double passed = 0;
  std::size_t edge = 0;
  for (std::size_t k = 0; k + 1 < even.size(); ++k) {
    wanted += even[k];
    while (edge + 1 < lengths.size() && passed + lengths[edge] < wanted) passed += lengths[edge++];
    const double share = lengths[edge] > 0 ? std::clamp((wanted - passed) / lengths[edge], 0.0, 1.0) : 0;
    way[(begin + k + 1) % way.size()] = at(begin + edge) + share * (at(begin + edge + 1) - at(begin + edge));
  }
}

}  // namespace

std::vector<std::size_t> put_at_corners(std::vector<Vector3>& way, std::size_t furthest, const FacesAtPlace& faces) {
  const std::size_t count = way.size();
  const auto edge = [&](std::size_t k) -> Vector3 { return way[(k + 1) % count] - way[k % count]; };
  const auto turn = [&](std::size_t k, std::size_t l) {
    return std::atan2(edge(k).cross(edge(l)).norm(), edge(k).dot(edge(l)));
  };
  std::vector<std::size_t> corners;
  for (std::size_t k = 0; k < count && count < fewest_smoothed; ++k) {
    if (turn(k + count - 1, k) > turn_of_few) corners.push_back(k);
  }
  if (count < fewest_smoothed) return corners;
  std::vector<double> excess(count);
  for (std::size_t k = 0; k < count; ++k) {
    // Three nodes, and two to either side of them.
    const double beside = turn(k + count - 4, k + count - 2) + turn(k + 1, k + 3);
    excess[k] = turn(k + count - 2, k + 1) - 0.75 * beside;
  }
  for (std::size_t k = 0; k < count; ++k) {
    const auto is_less = [&](std::size_t step) {
      const std::size_t other = (k + step) % count;
      return std::pair(excess[other], other) < std::pair(excess[k], k);
    };
    if (!(excess[k] > least_turn) || !is_less(1) || !is_less(2) || !is_less(count - 1) || !is_less(count - 2)) continue;
    corners.push_back(put_at_corner(way, k, furthest, faces));
  }
  return corners;
}

void space_out(const Constraints& held, std::vector<Vector3>& way) {
  const std::size_t count = way.size();
  const auto stays = [&](std::size_t k) {
    const auto node = static_cast<Index>(k % count);
    return held.position_fixed(node) || held.corner(node);
  };
  std::size_t first = 0;
  while (first < count && !stays(first)) ++first;
  if (first == count) first = 0;
  const std::vector<Vector3> before = way;
  for (std::size_t begin = first; begin < first + count;) {
    std::size_t end = begin + 1;
    while (end < first + count && !stays(end)) ++end;
    space_out_between(before, begin, end, way);
    begin = end;
  }
}

}  // namespace vspring
