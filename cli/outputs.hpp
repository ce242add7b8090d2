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

/// Throws Error(invalid_argument) if page, picture, scalars or deviations would replace an input or another output, and
/// Error(unusable_file) if an output cannot be written. others: more options with their files.
void check_outputs(const FairingArguments& arguments,
                   const std::vector<std::pair<std::string, std::string>>& others = {});

/// Throws what refuse_picture() and refuse_scalars() throw.
void refuse_views(const FairingArguments& arguments, bool curve);

/// Writes a file that Ctrl-C does not interrupt.
void write_uninterrupted(const std::string& path, const std::string& bytes);

/// The warning of an output that an interrupted run leaves out.
[[nodiscard]] std::string not_written(const std::string& path);

/// A warning for each loss in a written file.
[[nodiscard]] std::vector<std::string> written_without(const std::string& path, const std::vector<std::string>& losses);

/// The shapes in page, picture and scalars.
template <typename Shape>
struct Shown {
  std::span<const ShownShape<Shape>> shapes;
  int leading = 0;                                        ///< the shape seen first, whose numbers are the scalars
  std::optional<int> reference = std::nullopt;            ///< the shape that deviations are measured from
  std::span<const Vector3> points = {};                   ///< shown with surfaces in page and picture
  std::function<std::string()> picture = {};              ///< curves: the picture as SVG
  std::function<std::vector<NodeScalar>()> scalars = {};  ///< more numbers at the nodes of the leading shape
  const Welding* welding = nullptr;                       ///< surfaces: how the leading shape was welded
};

/// Writes page, picture and scalars, as far as asked for. report: for the page. Returns the first one not written
/// because the context was cancelled; empty if all are written.
[[nodiscard]] std::string write_views(const FairingArguments& arguments, const Shown<PolygonMesh>& shown,
                                      const nlohmann::ordered_json& report, const Context& context);
[[nodiscard]] std::string write_views(const FairingArguments& arguments, const Shown<PolygonCurve>& shown,
                                      const nlohmann::ordered_json& report, const Context& context);

}  // namespace vspring::cli
