#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "shape/frame.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_curve.hpp"

namespace vspring {

/// The curvature beside a node, and how it changes where up to three nodes go along their normals.
struct CurvatureStation {
  double curvature = 0;  ///< signed
  double place = 0;      ///< along the chain
  double length = 0;     ///< of edges that it stands for
  std::array<std::uint32_t, 3> nodes{};
  std::array<double, 3> slopes{};
};

/// Stations each of which is joined with the next.
struct CurvatureRun {
  std::vector<CurvatureStation> stations;
  bool closed = false;
  double around = 0;  ///< the length of the chain

  [[nodiscard]] std::size_t link_count() const { return stations.size() - (closed ? 0 : 1); }
  [[nodiscard]] const CurvatureStation& next(std::size_t k) const { return stations[(k + 1) % stations.size()]; }
  /// From station k to the next.
  [[nodiscard]] double step(std::size_t k) const;
};

/// A curve in a plane, in a frame of size 1, whose nodes go along their normals.
class PlanarPolygon {
 public:
  static constexpr std::uint32_t held = std::numeric_limits<std::uint32_t>::max();
  using Edge = std::array<std::uint32_t, 2>;

  /// None where the curve and the points lie in no plane, an edge has no length, or a normal is given.
  static std::optional<PlanarPolygon> of(const PolygonCurve& curve, const Constraints& constraints,
                                         std::span<const Vector3> points);

  [[nodiscard]] Eigen::Vector2d flat(const Vector3& place) const;
  [[nodiscard]] double scale() const { return frame_.scale(); }
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  [[nodiscard]] const std::vector<CurvatureRun>& runs() const { return runs_; }
  [[nodiscard]] const std::vector<Eigen::Vector2d>& places() const { return places_; }
  [[nodiscard]] const Eigen::Vector2d& place(std::uint32_t node) const { return places_[node]; }
  /// Unit, to the left; zero where a node is held.
  [[nodiscard]] const Eigen::Vector2d& normal(std::uint32_t node) const { return normals_[node]; }

  /// Numbers of nodes that move, in an order in which neighbours are near each other; else `held`.
  [[nodiscard]] std::uint32_t column(std::uint32_t node) const { return column_[node]; }
  [[nodiscard]] std::size_t column_count() const { return columns_; }
  /// Four nodes in succession lie within so many columns.
  [[nodiscard]] std::size_t column_width() const { return width_; }

  void set_places(std::vector<Eigen::Vector2d> places);

  /// As the curve has them, of nodes that have moved. input: the curve's.
  [[nodiscard]] std::vector<Vector3> lifted(const std::vector<Vector3>& input) const;

 private:
  PlanarPolygon() = default;
  void number(const PolygonCurve::Chain& chain);
  void find_normals();
  void find_stations(const PolygonCurve::Chain& chain);
  [[nodiscard]] CurvatureStation station(std::uint32_t before, std::uint32_t node, std::uint32_t after) const;
  [[nodiscard]] CurvatureStation station_beside(std::uint32_t node, std::uint32_t other, bool after) const;

  Frame frame_;
  Vector3 aside_ = Vector3::Zero();
  Vector3 ahead_ = Vector3::Zero();
  std::vector<PolygonCurve::Chain> chains_;
  std::vector<Edge> edges_;
  std::vector<std::uint8_t> fixed_;
  std::vector<std::uint32_t> column_;
  std::size_t columns_ = 0;
  std::size_t width_ = 0;
  std::vector<Eigen::Vector2d> first_;
  std::vector<Eigen::Vector2d> places_;
  std::vector<Eigen::Vector2d> normals_;
  std::vector<Eigen::Vector2d> given_;  // directions; zero: none
  std::vector<CurvatureRun> runs_;
};

}  // namespace vspring
