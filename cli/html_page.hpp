#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vspring::cli {

/// A page to look at offline, without anything from outside. report: what --report writes, which the page carries too.
/// scene: see scene_of().
[[nodiscard]] std::string html_page(const std::string& title, const nlohmann::ordered_json& report,
                                    const nlohmann::ordered_json& scene);

}  // namespace vspring::cli
