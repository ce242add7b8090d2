#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <Eigen/Geometry>
#include <cmath>
#include <map>
#include <sstream>

#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "framing.hpp"
#include "picture.hpp"

namespace vspring::cli {

namespace {

/// Words of --picture-style, and their names in the page.
const std::map<std::string, std::string> style_names = {{"shaded", "shaded"},
                                                        {"wire", "wire"},
                                                        {"zebra", "zebra"},
                                                        {"mean-curvature", "mean"},
                                                        {"gaussian-curvature", "gaussian"},
                                                        {"deviation", "deviation"}};
const std::map<std::string, Vector3> view_names = {{"front", -Vector3::UnitY()}, {"back", Vector3::UnitY()},
                                                   {"left", -Vector3::UnitX()},  {"right", Vector3::UnitX()},
                                                   {"top", Vector3::UnitZ()},    {"bottom", -Vector3::UnitZ()}};

/// The parts between commas.
std::vector<std::string> parts_of(const std::string& text) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, ',');) parts.push_back(part);
  return parts;
}

Eigen::Matrix3d parse_view(const std::string& text) {
  const auto refuse = [&](const char* why) {
    return CLI::ValidationError("--view", fmt::format("\"{}\": {}", text, why));
  };
  Vector3 direction;
  Vector3 up = Vector3::UnitZ();
  const auto named = view_names.find(text);
  if (named != view_names.end()) {
    direction = named->second;
  } else {
    std::vector<double> numbers;
    for (const std::string& part : parts_of(text)) {
      double number = 0;
      if (!CLI::detail::lexical_cast(part, number) || !std::isfinite(number)) throw refuse("not numbers with commas");
      numbers.push_back(number);
    }
    if (numbers.size() != 3 && numbers.size() != 6)
      throw refuse("front, back, left, right, top, bottom, three numbers or six");
    direction = Vector3(numbers[0], numbers[1], numbers[2]);
    if (numbers.size() == 6) up = Vector3(numbers[3], numbers[4], numbers[5]);
  }
  constexpr double parallel = 1e-6;
  const auto along = [&] { return up.stableNormalized().cross(direction.stableNormalized()).norm() < parallel; };
  if (direction.isZero(0) || up.isZero(0)) throw refuse("a direction has a length");
  if (along() && up == Vector3::UnitZ()) up = Vector3::UnitY();
  if (along()) throw refuse("what is up may not point to the eye");
  return seen_from(direction.stableNormalized(), up.stableNormalized());
}

}  // namespace

void add_picture_options(CLI::App& command, PictureArguments& arguments, bool surfaces) {
  const std::string group = "The picture";
  command
      .add_option("--picture", arguments.path,
                  surfaces ? "Draw the shape, before and after side by side; curves with curvature comb and curvature "
                             "against arc length. Needs Chromium, but not for .svg of curves"
                           : "Draw the curve with its curvature comb and its curvature against arc length, before and "
                             "after; .png needs Chromium")
      ->type_name("OUT.png|OUT.svg")
      ->group(group);
  command
      .add_option("--picture-size", arguments.width,
                  "Width of the picture, pixels; the height follows (default: 1600; .svg of curves scale anyway)")
      ->type_name("PIXELS")
      ->check(whole_number(100, 4000))
      ->group(group);
  if (!surfaces) return;
  command
      .add_option_function<std::string>(
          "--picture-style",
          [&arguments](const std::string& words) {
            arguments.for_surfaces = true;
            arguments.styles.clear();
            for (const std::string& word : parts_of(words)) {
              const auto style = style_names.find(word);
              if (style == style_names.end())
                throw CLI::ValidationError("--picture-style", "\"" + word +
                                                                  "\" is not one of shaded, wire, zebra, "
                                                                  "mean-curvature, gaussian-curvature, deviation");
              arguments.styles.push_back(style->second);
            }
          },
          "What the picture shows, a row for each: shaded, wire, zebra (reflection lines), mean-curvature, "
          "gaussian-curvature, "
          "deviation from the shape before (default: shaded,zebra)")
      ->type_name("STYLE,...")
      ->group(group);
  command
      .add_option_function<std::string>(
          "--view",
          [&arguments](const std::string& text) {
            arguments.for_surfaces = true;
            arguments.view = parse_view(text);
          },
          "The view of surfaces, also the first one in the page of --html: front, back, left, right, top, bottom, "
          "or "
          "x,y,z towards the eye, followed by the direction up (default: 1,-2,1.5,0,0,1; if only a small part moved, "
          "along its mean normal)")
      ->type_name("SIDE|X,Y,Z[,X,Y,Z]")
      ->group(group);
}

}  // namespace vspring::cli
