#include "tools/lab/study/even_points.h"

#include <gtest/gtest.h>

#include <array>

namespace sprung {
namespace {

TEST(EvenPoint, FillsTheBoxEvenlyHoweverManyAreTaken) {
  for (const std::size_t count : {32u, 64u, 100u}) {
    std::array<int, 16> cells{};  // 4 x 4
    for (std::size_t n = 0; n < count; ++n) {
      const UnitPoint point = even_point(2, n);
      ASSERT_EQ(point.size(), 2u);
      for (const double coordinate : point) {
        ASSERT_GE(coordinate, 0.0);
        ASSERT_LT(coordinate, 1.0);
      }
      ++cells[static_cast<std::size_t>(4.0 * point[0]) + 4 * static_cast<std::size_t>(4.0 * point[1])];
    }
    for (const int in_cell : cells) {
      EXPECT_GE(in_cell, static_cast<int>(count / 16) - 2) << count;
      EXPECT_LE(in_cell, static_cast<int>(count / 16) + 3) << count;
    }
  }
}

TEST(EvenPoint, BeginsInTheMiddleAndDiffersInEveryDimension) {
  EXPECT_EQ(even_point(3, 0), (UnitPoint{0.5, 0.5, 0.5}));
  const UnitPoint next = even_point(3, 1);
  EXPECT_NE(next[0], next[1]);
  EXPECT_NE(next[1], next[2]);
}

}  // namespace
}  // namespace sprung
