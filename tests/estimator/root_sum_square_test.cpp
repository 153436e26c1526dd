#include "estimator/root_sum_square.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace sprung {
namespace {

TEST(RootSumSquare, IsTheLengthOfItsParts) {
  EXPECT_DOUBLE_EQ(root_sum_square(3.0, -4.0), 5.0);
  EXPECT_DOUBLE_EQ(root_sum_square(2.0, 3.0, -6.0), 7.0);
  EXPECT_EQ(root_sum_square(0.0, 0.0), 0.0);
}

TEST(RootSumSquare, OfAnUnknownPartIsUnknown) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(std::isnan(root_sum_square(nan, 1.0)));
  EXPECT_TRUE(std::isnan(root_sum_square(1.0, 1.0, nan)));
}

}  // namespace
}  // namespace sprung
