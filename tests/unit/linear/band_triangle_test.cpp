#include "linear/band_triangle.hpp"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <cstddef>
#include <vector>

namespace vspring {
namespace {

TEST(BandTriangle, WhatDwindlesBelowAllNumbersIsNothing) {
  constexpr std::size_t count = 6;
  BandTriangle triangle(count, 2);
  // Each row hands on a hundred and fiftieth power of ten less to the next column, where nothing stands yet.
  triangle.add(0, {1, 1}, 1);
  triangle.add(0, {1e-160, 0}, 1);
  for (std::size_t k = 1; k < count; ++k) triangle.add(k, {1, 0.5}, 1);
  std::vector<double> right(count, 1);
  triangle.solve(std::span(right));
  for (const double one : right) EXPECT_TRUE(std::isfinite(one));
}

TEST(BandTriangle, ItsInverseInTheBandIsThatOfTheWholeMatrix) {
  constexpr std::size_t count = 9;
  constexpr std::size_t width = 4;
  BandTriangle triangle(count, width);
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t first = 0; first < count; ++first) {
    BandTriangle::Row entries{};
    Eigen::VectorXd row = Eigen::VectorXd::Zero(count);
    for (std::size_t k = 0; k < width && first + k < count; ++k)
      row[static_cast<Eigen::Index>(first + k)] = entries[k] = std::cos(static_cast<double>(7 * first + 3 * k)) + 1.5;
    triangle.add(first, entries, 2);
    whole += 4 * row * row.transpose();
  }
  const Eigen::MatrixXd inverse = whole.inverse();
  const auto found = triangle.inverse_in_band();
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t k = 0; k < width && i + k < count; ++k)
      EXPECT_NEAR(found[i][k], inverse(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(i + k)),
                  1e-9 * inverse.norm());
  }
}

}  // namespace
}  // namespace vspring
