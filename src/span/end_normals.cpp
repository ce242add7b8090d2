#include "span/end_normals.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "shape/direction.hpp"

namespace vspring {

namespace {

constexpr std::size_t none = static_cast<std::size_t>(-1);

/// Which loop each half-arc belongs to, and where in it.
struct PlacesInLoops {
  PlacesInLoops(const Arcs& arcs, const std::vector<Loop>& loops)
      : loop(2 * arcs.all().size(), none), place(2 * arcs.all().size(), 0) {
    for (std::size_t l = 0; l < loops.size(); ++l) {
      for (std::size_t k = 0; k < loops[l].halves.size(); ++k) {
        const auto half = static_cast<std::size_t>(loops[l].halves[k]);
        loop[half] = l;
        place[half] = k;
      }
    }
  }
  std::vector<std::size_t> loop;  ///< per half-arc; none: of no spanned loop
  std::vector<std::size_t> place;
};

/// The slope at each of some places of a parabola through three of them.
std::vector<double> slopes(const std::vector<double>& at, const std::vector<double>& values) {
  const std::size_t count = at.size();
  if (count < 2) return std::vector<double>(count, 0);
  std::vector<double> between;
  for (std::size_t k = 0; k + 1 < count; ++k) between.push_back((values[k + 1] - values[k]) / (at[k + 1] - at[k]));
  if (count == 2) return {between[0], between[0]};
  std::vector<double> result(count);
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double before = at[k] - at[k - 1];
    const double after = at[k + 1] - at[k];
    result[k] = (after * between[k - 1] + before * between[k]) / (before + after);
  }
  result[0] = 2 * between[0] - result[1];
  result[count - 1] = 2 * between[count - 2] - result[count - 2];
  return result;
}

/// A cubic through values, with these slopes; constant outside.
double interpolated(const std::vector<double>& at, const std::vector<double>& values, const std::vector<double>& slope,
                    double where) {
  if (at.size() == 1 || where <= at.front()) return values.front();
  if (where >= at.back()) return values.back();
  const auto next = static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), where) - at.begin());
  const double length = at[next] - at[next - 1];
  const double t = (where - at[next - 1]) / length;
  const double u = 1 - t;
  return u * u * (1 + 2 * t) * values[next - 1] + t * t * (3 - 2 * t) * values[next] +
         t * u * length * (u * slope[next - 1] - t * slope[next]);
}

}  // namespace

std::vector<SurfaceEnd> find_ends(const Arcs& arcs, const std::vector<Loop>& loops,
                                  const std::vector<std::uint8_t>& is_sharp) {
  const PlacesInLoops in(arcs, loops);
  const auto is_end = [&](Index half) {
    return in.loop[static_cast<std::size_t>(Arcs::reversed(half))] == none ||
           is_sharp[static_cast<std::size_t>(half / 2)] != 0;
  };
  const auto after = [&](Index half) {
    const auto& halves = loops[in.loop[static_cast<std::size_t>(half)]].halves;
    return halves[(in.place[static_cast<std::size_t>(half)] + 1) % halves.size()];
  };
  // Around the node at which one arrives, over arcs within the surface.
  const std::size_t count = 2 * arcs.all().size();
  std::vector<Index> next(count, -1);
  std::vector<std::vector<Index>> crossed(count);  // where it arrives
  std::vector<std::uint8_t> is_first(count, 0);
  for (std::size_t h = 0; h < count; ++h) {
    const auto half = static_cast<Index>(h);
    if (in.loop[h] == none || !is_end(half)) continue;
    Index here = after(half);
    for (; !is_end(here); here = after(Arcs::reversed(here))) crossed[h].push_back(here);
    next[h] = here;
    const bool goes_on = arcs.goes_on(half, here) && is_sharp[h / 2] == is_sharp[static_cast<std::size_t>(here / 2)];
    is_first[static_cast<std::size_t>(here)] = goes_on ? 0 : 1;
  }
  std::vector<Index> before(count, -1);
  for (std::size_t h = 0; h < count; ++h) {
    if (next[h] >= 0) before[static_cast<std::size_t>(next[h])] = static_cast<Index>(h);
  }
  // At a corner the next run is what meets this one.
  const auto at_start = [&](Index half) {
    const Index last = before[static_cast<std::size_t>(half)];
    std::vector<Index> result = crossed[static_cast<std::size_t>(last)];
    if (is_first[static_cast<std::size_t>(half)] != 0) result.push_back(Arcs::reversed(last));
    return result;
  };
  const auto at_finish = [&](Index half) {
    std::vector<Index> result = crossed[static_cast<std::size_t>(half)];
    const Index then = next[static_cast<std::size_t>(half)];
    if (is_first[static_cast<std::size_t>(then)] != 0) result.push_back(then);
    return result;
  };
  std::vector<SurfaceEnd> ends;
  std::vector<std::uint8_t> is_done(count, 0);
  const auto follow = [&](Index half) {
    SurfaceEnd end;
    Index here = half;
    do {
      is_done[static_cast<std::size_t>(here)] = 1;
      end.halves.push_back(here);
      end.crossing.push_back(at_start(here));
      here = next[static_cast<std::size_t>(here)];
    } while (here != half && is_first[static_cast<std::size_t>(here)] == 0);
    end.is_closed = is_first[static_cast<std::size_t>(half)] == 0;
    end.crossing.push_back(at_finish(end.halves.back()));
    ends.push_back(std::move(end));
  };
  for (const bool first : {true, false}) {
    for (std::size_t h = 0; h < count; ++h) {
      if (next[h] >= 0 && is_done[h] == 0 && (!first || is_first[h] != 0)) follow(static_cast<Index>(h));
    }
  }
  return ends;
}

std::vector<Vector3> normals_along(const std::vector<Vector3>& places, const std::vector<Vector3>& tangents,
                                   const std::vector<Vector3>& known, const std::vector<Vector3>& about) {
  // A frame that does not rotate about the run.
  std::vector<Vector3> frame = {tangents[0].unitOrthogonal()};
  std::vector<double> at = {0};
  for (std::size_t k = 1; k < places.size(); ++k) {
    frame.emplace_back(Eigen::Quaterniond::FromTwoVectors(tangents[k - 1], tangents[k]) * frame.back());
    at.push_back(at.back() + (places[k] - places[k - 1]).norm());
  }
  std::vector<double> where;
  std::vector<double> angles;
  // In either sense, the one nearer to another angle.
  const auto angle_near = [&](double other, const Vector3& normal, std::size_t k) {
    const double angle = std::atan2(normal.dot(tangents[k].cross(frame[k])), normal.dot(frame[k]));
    return angle + std::round((other - angle) / std::numbers::pi) * std::numbers::pi;
  };
  double roughly = 0;
  double turned = 0;  // since the last known one
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double before = roughly;
    if (!about[k].isZero(0)) roughly = angle_near(before, about[k], k);
    turned += k > 0 ? roughly - before : 0;
    if (known[k].isZero(0) || (!where.empty() && !(at[k] > where.back()))) continue;
    angles.push_back(angle_near(angles.empty() ? 0 : angles.back() + turned, known[k], k));
    where.push_back(at[k]);
    turned = 0;
  }
  if (where.empty()) return {};
  const std::vector<double> slope = slopes(where, angles);
  std::vector<Vector3> normals;
  for (std::size_t k = 0; k < places.size(); ++k) {
    const double angle = interpolated(where, angles, slope, at[k]);
    normals.push_back((std::cos(angle) * frame[k] + std::sin(angle) * tangents[k].cross(frame[k])).normalized());
  }
  return normals;
}

}  // namespace vspring
