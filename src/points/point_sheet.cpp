#include "points/point_sheet.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <tuple>

#include "base/cancellation.hpp"
#include "base/dense_algebra.hpp"
#include "base/median.hpp"
#include "points/nearest_nodes.hpp"

namespace vspring {

namespace {

// How many points around a point to use, and for how many points to count them.
constexpr std::size_t points_about = 24;
constexpr std::size_t most_counted = 1000;
// Fewer do not make a surface.
constexpr std::size_t fewest_about = 6;
// Size of a cell, in radii, of which one point represents the others.
constexpr double cell_of_few = 0.25;
// Widest angle in the plane without a point inside the surface: a little less than at a straight end, 180°.
constexpr double widest_gap = 150 * std::numbers::pi / 180;

}  // namespace

PointSheet::PointSheet(std::span<const Vector3> points, std::span<const Vector3> normals, double least_radius)
    : points_(points), normals_(normals), tree_(points), radius_(least_radius) {
  std::vector<double> reaches;
  std::vector<PointTree::Near> near;
  const std::size_t step = points.size() / most_counted + 1;
  for (std::size_t j = 0; j < points.size(); j += step) {
    end_if_cancelled_at(j);
    tree_.nearest(static_cast<Index>(j), points_about, near);
    if (near.size() == points_about) reaches.push_back(std::sqrt(near.back().square));
  }
  if (reaches.empty()) return;
  radius_ = std::max(radius_, median(reaches));
  few_ = thinned(cell_of_few * radius_);
  for (const Index j : few_) places_of_few_.push_back(points_[static_cast<std::size_t>(j)]);
  tree_of_few_.emplace(places_of_few_);
}

/// The first point of every cell of a cubic grid.
std::vector<Index> PointSheet::thinned(double cell) const {
  std::vector<std::tuple<std::array<double, 3>, Index>> cells;
  cells.reserve(points_.size());
  for (std::size_t j = 0; j < points_.size(); ++j) {
    const Vector3 place = (points_[j] / cell).array().floor();
    cells.push_back({{place.x(), place.y(), place.z()}, static_cast<Index>(j)});
  }
  std::sort(cells.begin(), cells.end());
  std::vector<Index> first;
  for (std::size_t k = 0; k < cells.size(); ++k) {
    if (k == 0 || std::get<0>(cells[k]) != std::get<0>(cells[k - 1])) first.push_back(std::get<1>(cells[k]));
  }
  std::sort(first.begin(), first.end());
  return first;
}

bool PointSheet::face_alike(Index a, Index b) const {
  return normals_.empty() ||
         vspring::face_alike(normals_[static_cast<std::size_t>(a)], normals_[static_cast<std::size_t>(b)]);
}

std::optional<PointSheet::About> PointSheet::about(Index point) const {
  if (!tree_of_few_) return std::nullopt;
  const Vector3& place = points_[static_cast<std::size_t>(point)];
  std::vector<Index> found;
  tree_of_few_->within(place, radius_, found);
  std::vector<Vector3> others;
  for (const Index k : found) {
    if (face_alike(point, few_[static_cast<std::size_t>(k)]))
      others.push_back(places_of_few_[static_cast<std::size_t>(k)]);
  }
  if (others.size() < fewest_about) return std::nullopt;
  About about;
  about.centre = about.out = Vector3::Zero();
  for (const Vector3& other : others) about.centre += other;
  about.centre /= static_cast<double>(others.size());
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  for (const Vector3& other : others) squares += (other - about.centre) * (other - about.centre).transpose();
  about.normal = principal_axes(squares).col(0);
  look_for_end(point, others, about);
  if (!about.ends) return about;
  // Other points may lie where those few do not.
  tree_.within(place, radius_, found);
  others.clear();
  for (const Index k : found) {
    if (face_alike(point, k)) others.push_back(points_[static_cast<std::size_t>(k)]);
  }
  look_for_end(point, others, about);
  return about;
}

void PointSheet::look_for_end(Index point, const std::vector<Vector3>& others, About& about) const {
  const Vector3& place = points_[static_cast<std::size_t>(point)];
  const Vector3 first = about.normal.unitOrthogonal();
  const Vector3 second = about.normal.cross(first);
  std::vector<double> angles;
  for (const Vector3& other : others) {
    const Vector3 way = other - place;
    if (!way.isZero(0)) angles.push_back(std::atan2(way.dot(second), way.dot(first)));
  }
  about.ends = false;
  if (angles.empty()) return;
  std::sort(angles.begin(), angles.end());
  double begin = angles.back();
  double gap = angles.front() + 2 * std::numbers::pi - begin;
  for (std::size_t k = 1; k < angles.size(); ++k) {
    if (angles[k] - angles[k - 1] <= gap) continue;
    begin = angles[k - 1];
    gap = angles[k] - begin;
  }
  about.ends = gap > widest_gap;
  about.out = std::cos(begin + gap / 2) * first + std::sin(begin + gap / 2) * second;
}

}  // namespace vspring
