#include "signals/quantile.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

TEST(Quantile, ShareOfTheValuesIsSmaller) {
  std::vector<double> values;
  for (int k = 99; k >= 0; --k) values.push_back(k);
  EXPECT_EQ(quantile(values, 0.0), 0.0);
  EXPECT_EQ(quantile(values, 0.5), 50.0);
  EXPECT_EQ(quantile(values, 0.95), 95.0);
  EXPECT_EQ(quantile(values, 1.0), 99.0);
}

TEST(Quantile, OfNothingIsNotANumber) { EXPECT_TRUE(std::isnan(quantile({}, 0.5))); }

}  // namespace
}  // namespace sprung
