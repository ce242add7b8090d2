#pragma once

#include <optional>
#include <utility>

#include "vspring/context.hpp"
#include "vspring/curvature.hpp"

namespace vspring::cli {

/// A shape with its curvatures at nodes: computed when they are asked for first, once for all that show them. The shape
/// must outlive it. Once cancelled, curvatures are of no use.
template <typename Shape>
class MeasuredShape {
 public:
  explicit MeasuredShape(const Shape& shape) : shape_(&shape) {}

  [[nodiscard]] const Shape& shape() const noexcept { return *shape_; }
  [[nodiscard]] const auto& curvatures(const Context& context) {
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
  std::optional<decltype(curvatures_of(std::declval<const Shape&>(), std::declval<const Context&>()))> curvatures_;
};

}  // namespace vspring::cli
