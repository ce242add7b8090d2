#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "fairing_arguments.hpp"
#include "figures.hpp"
#include "vspring/context.hpp"
#include "vspring/scalar_file.hpp"
#include "welding.hpp"

namespace vspring::cli {

/// Throws Error(invalid_argument) where page, picture, scalars or deviations would take the place of an input or of
/// another output, and Error(unusable_file) where an output cannot be written. others: more options with the files they
/// were given.
void check_outputs(const FairingArguments& arguments,
                   const std::vector<std::pair<std::string, std::string>>& others = {});

/// Throws Error where picture or scalars cannot be made, see refuse_picture() and refuse_scalars().
void refuse_views(const FairingArguments& arguments, bool curve);

/// Writes a file that Ctrl-C does not interrupt.
void write_uninterrupted(const std::string& path, const std::string& bytes);

/// The warning of an output that an interrupted run leaves out.
[[nodiscard]] std::string not_written(const std::string& path);

/// A warning for each of the losses that a file was written with.
[[nodiscard]] std::vector<std::string> written_without(const std::string& path, const std::vector<std::string>& losses);

/// The shapes that page, picture and scalars show.
template <typename Shape>
struct Shown {
  std::span<const ShownShape<Shape>> shapes;
  int leading = 0;                                        ///< the one that is seen first, and whose numbers are scalars
  std::optional<int> reference = std::nullopt;            ///< the one that deviations are from
  std::span<const Vector3> points = {};                   ///< shown with surfaces in page and picture
  std::function<std::string()> picture = {};              ///< curves: the picture as SVG
  std::function<std::vector<NodeScalar>()> scalars = {};  ///< more numbers at the nodes of the leading shape
  const Welding* welding = nullptr;  ///< of surfaces: what the leading shape has become of the file's
};

/// Writes page, picture and scalars, as far as they are asked for. report: what the page carries. Returns the first of
/// them that is not written, as the context was cancelled; empty where all are.
[[nodiscard]] std::string write_views(const FairingArguments& arguments, const Shown<PolygonMesh>& shown,
                                      const nlohmann::ordered_json& report, const Context& context);
[[nodiscard]] std::string write_views(const FairingArguments& arguments, const Shown<PolygonCurve>& shown,
                                      const nlohmann::ordered_json& report, const Context& context);

}  // namespace vspring::cli
