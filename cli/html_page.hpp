#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace vspring::cli {

/// Writes a page to look at offline, one file without anything from outside. report: what --report writes, which the
/// page carries too. scene: see scene_of().
void write_html_page(const std::string& path, const std::string& title, const nlohmann::ordered_json& report,
                     const nlohmann::ordered_json& scene);

}  // namespace vspring::cli
