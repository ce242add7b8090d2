#pragma once

#include <span>
#include <string>
#include <vector>

#include "vspring/curve_file.hpp"

namespace vspring {

/// What a file of a curve is to be made from.
struct FreshCurve {
  const std::vector<PolygonCurve::Chain>& chains;
  std::span<const Vector3> positions;
  bool planar;  ///< two coordinates
  std::string name;
};

/// A file of another format than SVG made from nothing but a curve. losses: what the format cannot hold is added.
/// Throws Error(invalid_argument) for DAT of several chains or of a curve in space.
std::string fresh_curve(CurveFormat format, const FreshCurve& curve, std::vector<std::string>& losses);

/// The first node that does not lie in the plane z = 0; the number of nodes where there is none.
std::size_t first_off_plane(std::span<const Vector3> positions);

}  // namespace vspring
