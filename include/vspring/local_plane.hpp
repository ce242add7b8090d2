#pragma once

#include "vspring/export.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// Maps the earth's surface (WGS 84) around an origin to a plane: x is metres east, y metres north of the origin.
///
/// The map is the oblique stereographic projection: angles are true everywhere, so smooth curves stay smooth. Lengths
/// are true at the origin and too long by r² / 4R² at a distance r from it (R is 6371 km): by 6e-7 at 10 km, by 6e-5 at
/// 100 km.
///
/// Source: IOGP, Coordinate Conversions and Transformations including Formulas, Guidance Note 7-2, method 9809, with
/// the scale 1 and no false origin. The intermediate sphere (Gauss's) is that of the origin's latitude.
class LocalPlane {
 public:
  /// A place in degrees; north and east are positive.
  struct Place {
    double latitude;   ///< −90 … 90
    double longitude;  ///< any turn
  };

  /// Throws Error(invalid_argument) unless the latitude is in −90 … 90 and the longitude is finite. An origin nearer
  /// than 1e-6 degrees to a pole is moved that far from it.
  explicit LocalPlane(const Place& origin);

  /// The place at x = y = 0.
  [[nodiscard]] const Place& origin() const noexcept { return origin_; }

  /// The position of a place, in metres; z is 0. Its latitude must be in −90 … 90. Not finite for the place opposite to
  /// the origin. Exact to about 1e-8 m near the origin.
  [[nodiscard]] Vector3 position(const Place& place) const;

  /// The place of a position, its longitude in −180 … 180; z is ignored.
  [[nodiscard]] Place place(const Vector3& position) const;

  /// By what share lengths are too long at a position: 0 at the origin.
  [[nodiscard]] double stretch(const Vector3& position) const;

  /// Whether both have the same origin.
  bool operator==(const LocalPlane& other) const {
    return origin_.latitude == other.origin_.latitude && origin_.longitude == other.origin_.longitude;
  }

 private:
  Place origin_;
  double diameter_;          ///< 2 R of the sphere, metres
  double exponent_;          ///< n: degrees of longitude on the sphere for each on the earth
  double isometric_;         ///< isometric latitude of the origin
  double sphere_isometric_;  ///< the same on the sphere
  double sine_;              ///< of the origin's latitude on the sphere
  double cosine_;
};

}  // namespace vspring
