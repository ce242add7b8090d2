#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vspring::cli {

/// A page to view offline, in one file. report: as --report writes it; the page contains it. scene: see scene_of().
[[nodiscard]] std::string html_page(const std::string& title, const nlohmann::ordered_json& report,
                                    const nlohmann::ordered_json& scene);

/// A page whose document, after loading, is "picture:" or "error:", base64 and ";", see page/picture/main.js. wanted:
/// `format` ("png" or "svg"), `width` in pixels, and either `svg`, the picture itself, or `styles` and `title` of a
/// picture of the scene, see scene_of().
[[nodiscard]] std::string picture_page(const nlohmann::ordered_json& wanted, const nlohmann::ordered_json& scene);

}  // namespace vspring::cli
