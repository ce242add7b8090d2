#pragma once

#include <fuzzer/FuzzedDataProvider.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <string_view>
#include <type_traits>
#include <vector>

#include "vspring/vspring.hpp"

namespace vspring::fuzz {

inline void require(bool held) {
  if (!held) std::abort();
}

/// A coordinate: mostly one of few between -1 and 1, so that nodes meet and faces lie flat; sometimes far off or none.
inline double coordinate(FuzzedDataProvider& data) {
  constexpr std::array strange = {0.0,
                                  -0.0,
                                  1e150,
                                  -1e150,
                                  1e-150,
                                  5e-324,
                                  1e300,
                                  std::numeric_limits<double>::infinity(),
                                  std::numeric_limits<double>::quiet_NaN()};
  const auto chosen = data.ConsumeIntegral<std::uint8_t>();
  if (chosen == 255) return data.PickValueInArray(strange);
  return (static_cast<double>(chosen) - 127) / 127;
}

inline Vector3 vector(FuzzedDataProvider& data) {
  const double x = coordinate(data);
  const double y = coordinate(data);
  return {x, y, coordinate(data)};
}

/// A grid of quads or triangles that may lack faces and be bent, or any polygons between any nodes.
inline PolygonMesh mesh(FuzzedDataProvider& data) {
  MeshBuilder builder;
  if (data.ConsumeIntegralInRange(0, 3) == 0) {
    const auto nodes = data.ConsumeIntegralInRange<Index>(3, 16);
    for (Index i = 0; i < nodes; ++i) builder.add_node(vector(data));
    const int faces = data.ConsumeIntegralInRange(1, 16);
    for (int f = 0; f < faces; ++f) {
      std::vector<Index> face(data.ConsumeIntegralInRange<std::size_t>(1, 7));
      for (Index& node : face) node = data.ConsumeIntegralInRange<Index>(0, nodes - 1);
      builder.add_face(face);
    }
    return builder.take();
  }
  const auto columns = data.ConsumeIntegralInRange<Index>(1, 7);
  const auto rows = data.ConsumeIntegralInRange<Index>(1, 7);
  const bool triangles = data.ConsumeBool();
  const bool around = data.ConsumeBool();
  const double roughness = data.ConsumeBool() ? 1 : 0.1;
  for (Index row = 0; row <= rows; ++row) {
    for (Index column = 0; column <= columns; ++column) {
      const double angle = 6.283185307179586 * column / (columns + 1);
      const Vector3 even = around ? Vector3(std::cos(angle), std::sin(angle), 0.3 * row)
                                  : Vector3(static_cast<double>(column), static_cast<double>(row), 0);
      builder.add_node(even + (data.remaining_bytes() > 0 ? Vector3(roughness * vector(data)) : Vector3::Zero()));
    }
  }
  const Index last = around ? columns + 1 : columns;
  for (Index row = 0; row < rows; ++row) {
    for (Index column = 0; column < last; ++column) {
      const auto at = [&](Index r, Index c) { return r * (columns + 1) + c % (columns + 1); };
      if (data.ConsumeIntegralInRange(0, 15) == 15) continue;
      const std::array corners = {at(row, column), at(row, column + 1), at(row + 1, column + 1), at(row + 1, column)};
      if (triangles) {
        builder.add_face({corners[0], corners[1], corners[2]});
        builder.add_face({corners[0], corners[2], corners[3]});
      } else {
        builder.add_face(corners);
      }
    }
  }
  return builder.take();
}

inline PolygonCurve curve(FuzzedDataProvider& data) {
  const auto nodes = data.ConsumeIntegralInRange<std::size_t>(1, 40);
  std::vector<Vector3> positions;
  const bool planar = data.ConsumeBool();
  for (std::size_t i = 0; i < nodes; ++i) {
    Vector3 position(static_cast<double>(i), 0, 0);
    if (data.remaining_bytes() > 0) position += vector(data);
    if (planar) position.z() = 0;
    positions.push_back(position);
  }
  return PolygonCurve(std::move(positions), data.ConsumeBool());
}

/// Some nodes held, at their places or at others, some with directions, some of curves corners.
template <typename Shape>
Constraints constraints(FuzzedDataProvider& data, const Shape& shape) {
  Constraints result(shape.node_count());
  if (data.ConsumeIntegralInRange(0, 3) > 0) fix_boundary_positions(result, shape);
  const int edits = data.ConsumeIntegralInRange(0, 12);
  for (int k = 0; k < edits && shape.node_count() > 0; ++k) {
    const auto node = data.ConsumeIntegralInRange<Index>(0, shape.node_count() - 1);
    try {
      switch (data.ConsumeIntegralInRange(0, std::is_same_v<Shape, PolygonCurve> ? 6 : 4)) {
        case 0:
          result.fix_position(node, shape.position(node));
          break;
        case 1:
          result.fix_position(node, vector(data));
          break;
        case 2:
          result.fix_normal(node, vector(data));
          break;
        case 3:
          result.free_position(node);
          break;
        case 4:
          result.fix_tangent(node, vector(data));
          break;
        case 5:
          result.fix_tangent(node, vector(data), data.ConsumeBool() ? NodeSide::before : NodeSide::after);
          break;
        default:
          result.make_corner(node);
      }
    } catch (const Error& error) {
      require(error.code() == ErrorCode::unusable_constraint);
    }
  }
  return result;
}

/// What holds of every result: nodes that are held are where they are held to the bit, no node has lost its place, and
/// what is called converged expects to be.
template <typename Shape>
void check(const Shape& shape, const Constraints& constraints, const FairReport& report, double tolerance,
           const std::vector<Vector3>& positions) {
  require(positions.size() == static_cast<std::size_t>(shape.node_count()));
  for (Index i = 0; i < shape.node_count(); ++i) {
    const Vector3& position = positions[static_cast<std::size_t>(i)];
    if (constraints.position_fixed(i))
      require((position.array() == constraints.position(i).array()).all() || !constraints.position(i).allFinite());
    else
      require(position.allFinite() || !shape.position(i).allFinite());
  }
  if (report.expected_error) require(*report.expected_error >= 0);
  if (report.outcome == Outcome::converged && report.method == Method::equilibrium && report.expected_error)
    require(*report.expected_error <= tolerance);
}

/// All else than an Error with one line is a fault.
template <typename Call>
void attempt(const Call& call) {
  try {
    call();
  } catch (const Error& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
  }
}

}  // namespace vspring::fuzz
