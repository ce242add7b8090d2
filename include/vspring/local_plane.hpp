#pragma once

#include "vspring/export.hpp"
#include "vspring/types.hpp"

namespace VSPRING_API vspring {

/// A plane in place of the earth's surface (WGS 84) around an origin: x is metres east, y metres north of it.
///
/// It is the oblique stereographic map: directions are true everywhere, so that angles and what is smooth stay, and
/// lengths are true at the origin and too long by r² / 4R² at a distance r from it (R is 6371 km): by 6e-7 at 10 km, by
/// 6e-5 at 100 km.
///
/// Source: IOGP, Coordinate Conversions and Transformations including Formulas, Guidance Note 7-2, method 9809, with
/// the scale 1 and no false origin. The sphere between (Gauss's) is that of the origin's latitude.
class LocalPlane {
 public:
  /// In degrees, north and east are positive.
  struct Place {
    double latitude;
    double longitude;
  };

  /// Throws Error(invalid_argument) unless the latitude is in −90 … 90 and the longitude is finite. The origin of one
  /// within 1e-6 of a pole is put that far from it.
  explicit LocalPlane(const Place& origin);

  [[nodiscard]] const Place& origin() const noexcept { return origin_; }

  /// The position of a place; z is 0. latitude: in −90 … 90. The place opposite to the origin has none that is finite.
  /// Exact to some 1e-8 m near the origin.
  [[nodiscard]] Vector3 position(const Place& place) const;

  /// The place of a position, its longitude in −180 … 180; z is not looked at.
  [[nodiscard]] Place place(const Vector3& position) const;

  /// How much too long lengths are at a position, as a share: 0 at the origin.
  [[nodiscard]] double stretch(const Vector3& position) const;

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
