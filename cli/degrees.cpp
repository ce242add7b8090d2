#include "degrees.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "terminal.hpp"
#include "vspring/error.hpp"

namespace vspring::cli {

std::string note_of(const std::optional<LocalPlane>& plane) {
  if (!plane) return {};
  return fmt::format(
      "note: latitudes and longitudes are projected onto a plane; units are metres, x east and y north of {:.6f}, "
      "{:.6f}\n",
      plane->origin().latitude, plane->origin().longitude);
}

nlohmann::ordered_json figures_of(const std::optional<LocalPlane>& plane) {
  if (!plane) return nlohmann::ordered_json::object();
  return {{"local_plane", {{"latitude", plane->origin().latitude}, {"longitude", plane->origin().longitude}}}};
}

void require_same_units(const std::string& path, const std::optional<LocalPlane>& plane, const std::string& other_path,
                        const std::optional<LocalPlane>& other) {
  if (plane.has_value() == other.has_value()) return;
  const std::string& in_degrees = plane ? path : other_path;
  const std::string& without = plane ? other_path : path;
  throw Error(ErrorCode::unusable_file,
              fmt::format("{}: it gives latitudes and longitudes, and {} does not; give both in degrees, or both not",
                          input_name(in_degrees), input_name(without)));
}

}  // namespace vspring::cli
