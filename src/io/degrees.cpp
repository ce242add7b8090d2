// Latitudes and longitudes in files of curves and points.
#include "io/degrees.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace vspring {

void require_place(const InputFile& file, std::size_t offset, const LocalPlane::Place& place) {
  if (!(std::abs(place.latitude) <= 90))
    file.refuse_line(offset, fmt::format("the latitude is {}; give degrees from -90 to 90", place.latitude));
  if (!(place.longitude >= -180 && place.longitude <= 360))
    file.refuse_line(offset, fmt::format("the longitude is {}; give degrees from -180 to 180", place.longitude));
}

LocalPlane take_to_plane(std::vector<Vector3>& positions, const std::optional<LocalPlane>& plane) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double south = infinity;
  double north = -infinity;
  double west = infinity;
  double east = -infinity;
  // Longitudes are taken relative to the first, as they may lie on both sides of the date line.
  const double first = positions.front().x();
  for (const Vector3& position : positions) {
    const double eastward = std::remainder(position.x() - first, 360);
    south = std::min(south, position.y());
    north = std::max(north, position.y());
    west = std::min(west, eastward);
    east = std::max(east, eastward);
  }
  const LocalPlane taken =
      plane ? *plane : LocalPlane({(south + north) / 2, std::remainder(first + (west + east) / 2, 360)});
  for (Vector3& position : positions) {
    const double z = position.z();
    position = taken.position({position.y(), position.x()});
    position.z() = z;
  }
  return taken;
}

std::string stretch_warning(const InputFile& file, const LocalPlane& plane, const std::vector<Vector3>& positions) {
  double most = 0;
  double furthest = 0;
  for (const Vector3& position : positions) {
    most = std::max(most, plane.stretch(position));
    furthest = std::max(furthest, position.head<2>().norm());
  }
  if (!(most > 1e-3)) return {};
  return fmt::format("{}: reaches {:.0f} km from {}, and lengths there come out up to {:.2g} % too long", file.name,
                     furthest / 1000, origin_of(plane), 100 * most);
}

std::string origin_of(const LocalPlane& plane) {
  return fmt::format("{:.6f}, {:.6f}", plane.origin().latitude, plane.origin().longitude);
}

void append_degrees(std::string& text, double degrees) {
  const std::size_t begin = text.size();
  fmt::format_to(std::back_inserter(text), "{:.12f}", degrees);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  if (text.substr(begin) == "-0") text.erase(begin, 1);
}

}  // namespace vspring
