#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "vspring/local_plane.hpp"

namespace vspring::cli {

/// A line for people about units if a file gives degrees; empty without a plane.
[[nodiscard]] std::string note_of(const std::optional<LocalPlane>& plane);

/// The origin of the plane for the report, or an empty object.
[[nodiscard]] nlohmann::ordered_json figures_of(const std::optional<LocalPlane>& plane);

/// Throws Error(unusable_file) if one of two files that belong together gives degrees and the other does not.
void require_same_units(const std::string& path, const std::optional<LocalPlane>& plane, const std::string& other_path,
                        const std::optional<LocalPlane>& other);

}  // namespace vspring::cli
