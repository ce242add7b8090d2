#include "outputs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <nlohmann/json.hpp>
#include <system_error>
#include <type_traits>

#include "html_page.hpp"
#include "interruption.hpp"
#include "page_scene.hpp"
#include "picture.hpp"
#include "scalars.hpp"
#include "terminal.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"

namespace vspring::cli {

namespace {

/// The scene of the page and the picture of a surface; nothing if neither is asked for.
template <typename Shape>
nlohmann::ordered_json shown_scene(const FairingArguments& arguments, const Shown<Shape>& shown,
                                   const Context& context) {
  constexpr bool surface = std::is_same_v<Shape, PolygonMesh>;
  const bool drawn = surface && !arguments.picture.path.empty();
  if (context.cancelled() || (arguments.html.empty() && !drawn)) return {};
  const PageRoles roles = {.leading = shown.leading,
                           .reference = shown.reference,
                           .deviation = !arguments.html.empty() || arguments.picture.shows("deviation"),
                           .view = arguments.picture.view,
                           .points = shown.points};
  return scene_of(shown.shapes, roles, context);
}

/// Returns false, and writes nothing, if the context was cancelled.
template <typename Shape>
bool write_shown_scalars(const std::string& path, const Shown<Shape>& shown, const Context& context) {
  if (context.cancelled()) return false;
  const auto& leading = shown.shapes[static_cast<std::size_t>(shown.leading)].measured;
  const auto* const before =
      shown.reference ? &shown.shapes[static_cast<std::size_t>(*shown.reference)].measured : nullptr;
  std::vector<NodeScalar> scalars = scalars_of(leading, before, context);
  if (shown.scalars) std::ranges::move(shown.scalars(), std::back_inserter(scalars));
  if (context.cancelled()) return false;
  const UninterruptedWhileWriting guard;
  if (shown.welding != nullptr)
    shown.welding->write_scalars(path, leading.shape(), std::move(scalars));
  else
    write_scalars(path, leading.shape(), scalars);
  return true;
}

template <typename Shape>
std::string write_shown(const FairingArguments& arguments, const Shown<Shape>& shown,
                        const nlohmann::ordered_json& report, const Context& context) {
  const std::string title = "vspring: " + input_name(arguments.input);
  const PictureArguments& picture = arguments.picture;
  const nlohmann::ordered_json scene = shown_scene(arguments, shown, context);
  // The result of an interrupted call is useless.
  const auto write = [&](const std::string& path, const auto& bytes_of) {
    if (path.empty()) return true;
    if (context.cancelled()) return false;
    const std::string bytes = bytes_of();
    if (context.cancelled()) return false;
    write_uninterrupted(path, bytes);
    return true;
  };
  const auto drawn = [&] {
    if constexpr (std::is_same_v<Shape, PolygonMesh>)
      return surface_picture(picture, title, scene, context);
    else
      return curve_picture(picture, shown.picture(), context);
  };
  if (!write(arguments.html, [&] { return html_page(title, report, scene); })) return arguments.html;
  if (!write(picture.path, drawn)) return picture.path;
  if (arguments.scalars.empty() || write_shown_scalars(arguments.scalars, shown, context)) return {};
  return arguments.scalars;
}

/// Whether two paths lead to the same file, which need not exist. Devices such as /dev/null lose nothing.
bool are_one_file(const std::string& path, const std::string& other) {
  std::error_code fault;
  if (other.empty() || std::filesystem::is_other(path, fault)) return false;
  if (path == other || path == "-" || other == "-") return path == other;
  const auto resolved = [&](const std::string& name) {
    return std::filesystem::weakly_canonical(std::filesystem::absolute(name, fault), fault);
  };
  return resolved(path) == resolved(other);
}

}  // namespace

void check_outputs(const FairingArguments& arguments, const std::vector<std::pair<std::string, std::string>>& others) {
  std::vector<std::pair<std::string, std::string>> read = others;
  read.insert(read.end(), {{"--constraints", arguments.rules}, {"--region", arguments.region}});
  // A shape may be written in place of the input.
  std::vector<std::pair<std::string, std::string>> written;
  const std::pair<std::string, std::string> outputs[] = {
      {"--output", arguments.output},        {"--report", arguments.report}, {"--scalars", arguments.scalars},
      {"--picture", arguments.picture.path}, {"--html", arguments.html},     {"--deviation", arguments.deviation}};
  for (const auto& output : outputs) {
    const std::string& option = output.first;
    const std::string& path = output.second;
    if (path.empty()) continue;
    const auto refuse = [&](const std::string& other) {
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("{}: {} is {} already; give it a file of its own", option, output_name(path), other));
    };
    for (const auto& [other, file] : written) {
      if (are_one_file(path, file)) refuse(other);
    }
    written.push_back(output);
    // Standard input is no file that is written.
    if (path == "-") continue;
    if (option != "--output" && are_one_file(path, arguments.input)) refuse("the input");
    for (const auto& [other, file] : read) {
      if (are_one_file(path, file)) refuse(other);
    }
  }
  // Testing whether a file can be written creates one.
  const UninterruptedWhileWriting guard;
  for (const auto& output : outputs) {
    if (!output.second.empty()) check_writable(output.second);
  }
}

void refuse_views(const FairingArguments& arguments, bool curve) {
  refuse_picture(arguments.picture, curve);
  refuse_scalars(arguments.scalars, curve);
}

void write_uninterrupted(const std::string& path, const std::string& bytes) {
  const UninterruptedWhileWriting guard;
  write_file(path, bytes);
}

std::string not_written(const std::string& path) {
  return output_name(path) + ": not written, as the run was interrupted";
}

std::vector<std::string> written_without(const std::string& path, const std::vector<std::string>& losses) {
  std::vector<std::string> warnings;
  warnings.reserve(losses.size());
  for (const std::string& lost : losses)
    warnings.push_back(fmt::format("{}: written without {}", output_name(path), lost));
  return warnings;
}

std::string write_views(const FairingArguments& arguments, const Shown<PolygonMesh>& shown,
                        const nlohmann::ordered_json& report, const Context& context) {
  return write_shown(arguments, shown, report, context);
}

std::string write_views(const FairingArguments& arguments, const Shown<PolygonCurve>& shown,
                        const nlohmann::ordered_json& report, const Context& context) {
  return write_shown(arguments, shown, report, context);
}

}  // namespace vspring::cli
