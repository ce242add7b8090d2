#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "terminal.hpp"
#include "vspring/context.hpp"
#include "vspring/curvature.hpp"
#include "vspring/figures.hpp"

namespace vspring::cli {

/// A shape with its curvatures at nodes, computed once, on first use. The shape must outlive it. When cancelled,
/// curvatures are useless.
template <typename Shape>
class MeasuredShape {
 public:
  explicit MeasuredShape(const Shape& shape) : shape_(&shape) {}

  [[nodiscard]] const Shape& shape() const noexcept { return *shape_; }
  [[nodiscard]] const auto& curvatures(const Context& context) const {
    if (!curvatures_) curvatures_ = curvatures_of(*shape_, context);
    return *curvatures_;
  }

 private:
  static auto curvatures_of(const PolygonMesh& mesh, const Context& context) {
    return vspring::curvatures(mesh, context);
  }
  static auto curvatures_of(const PolygonCurve& curve, const Context& /*context*/) {
    return vspring::curvatures(curve);
  }

  const Shape* shape_;
  mutable std::optional<decltype(curvatures_of(std::declval<const Shape&>(), std::declval<const Context&>()))>
      curvatures_;
};

/// Figures of a shape under its title: a column of a table.
struct FigureColumn {
  std::string title;
  std::vector<Figure> figures;
};

/// Figures with their shape, for pages and pictures. The shape must outlive it.
template <typename Shape>
struct ShownShape : FigureColumn {
  MeasuredShape<Shape> measured;

  [[nodiscard]] const Shape& shape() const noexcept { return measured.shape(); }
};

/// Lists the figures of measure_surface() or measure_curve(). shown: the curvatures of all nodes are needed anyway;
/// else only measured ones are computed. The figures have the same bits either way.
[[nodiscard]] std::vector<Figure> figures_of(const MeasuredShape<PolygonMesh>& mesh, const Constraints* constraints,
                                             bool shown, const Context& context);
[[nodiscard]] std::vector<Figure> figures_of(const MeasuredShape<PolygonCurve>& curve, const Constraints* constraints,
                                             bool shown, const Context& context);

/// Figures of a shape before and after, with the bits of figures_of() for each.
[[nodiscard]] std::array<std::vector<Figure>, 2> figures_of(const PolygonMesh& before, const PolygonMesh& after,
                                                            const Constraints* constraints, const Context& context);

/// The diagonal of the box around the moving nodes and their neighbours: the "size" in reports.
[[nodiscard]] double size_of_moving(const PolygonMesh& mesh, const Constraints& constraints);
[[nodiscard]] double size_of_moving(const PolygonCurve& curve, const Constraints& constraints);

/// Values by key; and name, unit and definition by key.
[[nodiscard]] nlohmann::ordered_json values_of(const std::vector<Figure>& figures);
[[nodiscard]] nlohmann::ordered_json definitions_of(const std::vector<Figure>& figures);

/// Figures for people, a line each: name, a value for every column, unit, definition. The first column determines the
/// figures; others are empty where they lack one.
[[nodiscard]] std::string figure_table(const std::vector<FigureColumn>& columns, const Terminal& terminal);

}  // namespace vspring::cli
