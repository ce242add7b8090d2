#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "vspring/local_plane.hpp"

namespace vspring::cli {

/// What units are where a file gives degrees, a line for people; empty without a plane.
[[nodiscard]] std::string note_of(const std::optional<LocalPlane>& plane);

/// The same for the report: the origin, or an empty object.
[[nodiscard]] nlohmann::ordered_json figures_of(const std::optional<LocalPlane>& plane);

/// Throws Error(unusable_file) where one of two files that belong together gives degrees and the other does not.
void require_same_units(const std::string& path, const std::optional<LocalPlane>& plane, const std::string& other_path,
                        const std::optional<LocalPlane>& other);

}  // namespace vspring::cli
