#pragma once

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "vspring/context.hpp"

namespace vspring::cli {

/// Arguments of the picture of a run.
struct PictureArguments {
  std::string path;
  std::vector<std::string> styles;      ///< of surfaces, by their names in the page; empty: the default ones
  std::optional<Eigen::Matrix3d> view;  ///< of surfaces, see seen_from(); empty: not given
  int width = 1600;                     ///< pixels
  bool for_surfaces = false;            ///< whether an option for surfaces only was given

  [[nodiscard]] bool shows(const std::string& style) const;
};

/// Whether a picture is SVG or PNG, by its extension. Throws Error(invalid_argument) for any other.
[[nodiscard]] bool named_svg(const std::string& path);

/// Throws Error before any long work: invalid_argument if the extension is neither .png nor .svg or an option is for
/// surfaces only, unusable_file if no browser is installed. Does nothing without --picture.
void refuse_picture(const PictureArguments& arguments, bool curve);

/// The bytes of the picture. scene: see scene_of(). Throws Error(unusable_file) if it cannot be drawn. When cancelled,
/// the result is useless.
[[nodiscard]] std::string surface_picture(const PictureArguments& arguments, const std::string& title,
                                          const nlohmann::ordered_json& scene, const Context& context);

/// The picture of a curve that is drawn as SVG already.
[[nodiscard]] std::string curve_picture(const PictureArguments& arguments, const std::string& svg,
                                        const Context& context);

}  // namespace vspring::cli
