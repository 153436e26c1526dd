#include "signals/number_text.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

TEST(NumberText, KeepsTheDigitsThatCount) {
  EXPECT_EQ(number_text(3.21234567), "3.21235");
  EXPECT_EQ(number_text(3.21234567, 3), "3.21");
  EXPECT_EQ(number_text(0.020), "0.02");
  EXPECT_EQ(number_text(-1.23456e-300, 17).substr(0, 8), "-1.23456");
}

TEST(NumberText, WhatIsNoNumberSaysSo) {
  EXPECT_EQ(number_text(std::nan("")), "nan");
  EXPECT_EQ(number_text(-HUGE_VAL), "-inf");
}

}  // namespace
}  // namespace sprung
