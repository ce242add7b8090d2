// How far places of a curve may be from the polyline of its points.

#include "curve_fit/polyline_bounds.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace vspring {
namespace {

constexpr std::uint32_t parts_of_edge = 4;

/// The polyline itself, each edge in parts_of_edge.
struct Polyline {
  explicit Polyline(const std::vector<Vector3>& rows) {
    std::vector<DenseCurve::Node> nodes;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      points.push_back({rows[k], 1, {static_cast<std::uint32_t>(k) * parts_of_edge, 0}, static_cast<Index>(k), 0});
      const Vector3 edge = rows[(k + 1) % rows.size()] - rows[k];
      for (std::uint32_t part = 0; part < parts_of_edge; ++part)
        nodes.emplace_back().place = rows[k] + static_cast<double>(part) / parts_of_edge * edge;
    }
    curve.add_chain(nodes, true);
  }

  DenseCurve curve;
  std::vector<CurvePoint> points;
};

TEST(PolylineBounds, OfALoopOfFewUnevenRowsAreThoseOfTheNearestPiece) {
  for (const int count : {4, 5, 7, 9, 17}) {
    // Three times as far apart on one side.
    std::vector<Vector3> rows;
    double angle = 0;
    for (int k = 0; k < count; ++k) {
      rows.emplace_back(2 * std::cos(angle), std::sin(angle), 0);
      angle += 2 * M_PI / count * (1 + 0.5 * std::cos(2 * M_PI * k / count));
    }
    const Polyline polyline(rows);
    const std::vector<PolylineBound> bounds =
        polyline_bounds(polyline.curve, polyline.points, 0.01, {.everywhere = true});
    ASSERT_GE(bounds.size(), static_cast<std::size_t>(count) * parts_of_edge);
    for (const PolylineBound& one : bounds) {
      // Between nodes the curve is round.
      if (one.at.share == 0)
        EXPECT_LT(one.distance(polyline.curve.at(one.at)), 1e-12) << count << ", edge " << one.at.edge;
    }
  }
}

}  // namespace
}  // namespace vspring
