#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace vspring::cli {

/// A page to look at offline, without anything from outside. report: what --report writes, which the page carries too.
/// scene: see scene_of().
[[nodiscard]] std::string html_page(const std::string& title, const nlohmann::ordered_json& report,
                                    const nlohmann::ordered_json& scene);

/// A page that leaves a picture where a browser prints it: "picture:" or "error:", base64 and ";", see
/// page/picture/main.js. wanted: `format` ("png" or "svg"), `width` in pixels, and either `svg`, the picture itself, or
/// `styles` and `title` of one of the scene, see scene_of().
[[nodiscard]] std::string picture_page(const nlohmann::ordered_json& wanted, const nlohmann::ordered_json& scene);

}  // namespace vspring::cli
