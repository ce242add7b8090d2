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
  triangle.add(0, BandTriangle::Row{1, 1}, 1);
  triangle.add(0, BandTriangle::Row{1e-160}, 1);
  for (std::size_t k = 1; k < count; ++k) triangle.add(k, BandTriangle::Row{1, 0.5}, 1);
  std::vector<double> right(count, 1);
  triangle.solve(std::span(right));
  for (const double one : right) EXPECT_TRUE(std::isfinite(one));
}

}  // namespace
}  // namespace vspring
