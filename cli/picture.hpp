#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vspring/context.hpp"

namespace vspring::cli {

/// What is told of the picture of a run.
struct PictureArguments {
  std::string path;
  std::vector<std::string> styles;  ///< of surfaces, by the names that the page has for them; empty: the default ones
  std::optional<Eigen::Matrix3d> view;  ///< from where surfaces are seen, see seen_from(); empty: it is not told
  int width = 1600;                     ///< pixels
  bool for_surfaces = false;            ///< whether an option was given that only surfaces have

  [[nodiscard]] bool shows(const std::string& style) const;
};

/// Whether a picture is SVG, or else PNG, by its extension. Throws Error(invalid_argument) for another.
[[nodiscard]] bool named_svg(const std::string& path);

/// Throws Error before anything long begins: invalid_argument where the extension is neither .png nor .svg or an option
/// is for surfaces only, unusable_file where the program that draws is not installed. Nothing without --picture.
void refuse_picture(const PictureArguments& arguments, bool curve);

/// The bytes of the picture. scene: see scene_of(). Throws Error(unusable_file) where it cannot be drawn. Once
/// cancelled, what they return is of no use.
[[nodiscard]] std::string surface_picture(const PictureArguments& arguments, const std::string& title,
                                          const nlohmann::ordered_json& scene, const Context& context);

/// The same of a curve that is drawn as SVG already.
[[nodiscard]] std::string curve_picture(const PictureArguments& arguments, const std::string& svg,
                                        const Context& context);

}  // namespace vspring::cli
