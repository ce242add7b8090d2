#include "html_page.hpp"

#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

#include "page_template.hpp"

namespace vspring::cli {

namespace {

/// JSON for a script element; "<" is escaped, so no name of a file or group can end the element.
std::string in_script(const nlohmann::ordered_json& json) {
  const std::string text = json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

std::string in_markup(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '<')
      safe += "&lt;";
    else if (c == '&')
      safe += "&amp;";
    else
      safe += c;
  }
  return safe;
}

/// The page with texts in place of names. One pass, so inserted texts are not searched for names.
std::string filled(std::string_view rest, std::initializer_list<std::pair<std::string_view, std::string>> parts) {
  std::string page;
  while (!rest.empty()) {
    const std::size_t at = rest.find('@');
    page += rest.substr(0, at);
    if (at == std::string_view::npos) break;
    rest.remove_prefix(at);
    std::string_view taken = rest.substr(0, 1);
    std::string_view text = taken;
    for (const auto& [place, filling] : parts) {
      if (!rest.starts_with(place)) continue;
      taken = place;
      text = filling;
    }
    page += text;
    rest.remove_prefix(taken.size());
  }
  return page;
}

}  // namespace

std::string html_page(const std::string& title, const nlohmann::ordered_json& report,
                      const nlohmann::ordered_json& scene) {
  return filled(page_template,
                {{"@TITLE@", in_markup(title)}, {"@FIGURES@", in_script(report)}, {"@SCENE@", in_script(scene)}});
}

std::string picture_page(const nlohmann::ordered_json& wanted, const nlohmann::ordered_json& scene) {
  return filled(picture_template, {{"@PICTURE@", in_script(wanted)}, {"@SCENE@", in_script(scene)}});
}

}  // namespace vspring::cli
