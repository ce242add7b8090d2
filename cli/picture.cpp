#include "picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "browser.hpp"
#include "html_page.hpp"
#include "page_bytes.hpp"
#include "terminal.hpp"
#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

std::string needed_browser(const PictureArguments& arguments, bool curve) {
  if (const auto browser = find_browser()) return *browser;
  throw Error(ErrorCode::unusable_file,
              fmt::format("{}: Chromium draws it and is not found; install it (Debian: apt install chromium){}",
                          arguments.path, curve ? ", or name the picture .svg, which needs nothing" : ""));
}

std::string drawn(const PictureArguments& arguments, bool curve, nlohmann::ordered_json wanted,
                  const nlohmann::ordered_json& scene, const Context& context) {
  wanted["format"] = named_svg(arguments.path) ? "svg" : "png";
  wanted["width"] = arguments.width;
  const std::string browser = needed_browser(arguments, curve);
  const std::string document = loaded_document(browser, picture_page(wanted, scene), context);
  if (context.cancelled()) return {};
  const auto said = [&](std::string_view kind) -> std::optional<std::string> {
    const std::size_t begin = document.find(kind);
    const std::size_t end = document.find(';', begin);
    if (begin == std::string::npos || end == std::string::npos) return std::nullopt;
    return from_base64(std::string_view(document).substr(begin + kind.size(), end - begin - kind.size()));
  };
  if (auto picture = said("picture:")) return *picture;
  throw Error(ErrorCode::unusable_file,
              fmt::format("{}: {} has not drawn it: {}", arguments.path, browser,
                          said("error:").value_or("it ended without a message, perhaps for lack of memory")));
}

}  // namespace

bool named_svg(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (extension != ".png" && extension != ".svg")
    throw Error(ErrorCode::invalid_argument, output_name(path) + ": pictures are PNG or SVG; name a file .png or .svg");
  return extension == ".svg";
}

bool PictureArguments::shows(const std::string& style) const {
  return !path.empty() && std::find(styles.begin(), styles.end(), style) != styles.end();
}

void refuse_picture(const PictureArguments& arguments, bool curve) {
  if (arguments.path.empty()) return;
  const bool svg = named_svg(arguments.path);
  if (curve && arguments.for_surfaces)
    throw Error(ErrorCode::invalid_argument, "--picture-style and --view are for surfaces; leave them out");
  if (!curve || !svg) (void)needed_browser(arguments, curve);
}

std::string surface_picture(const PictureArguments& arguments, const std::string& title,
                            const nlohmann::ordered_json& scene, const Context& context) {
  const std::vector<std::string> usual = {"shaded", "zebra"};
  return drawn(arguments, false, {{"title", title}, {"styles", arguments.styles.empty() ? usual : arguments.styles}},
               scene, context);
}

std::string curve_picture(const PictureArguments& arguments, const std::string& svg, const Context& context) {
  if (named_svg(arguments.path)) return svg;
  return drawn(arguments, true, {{"svg", svg}}, nullptr, context);
}

}  // namespace vspring::cli
