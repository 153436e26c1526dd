#include "tools/operate/client/angle_text.h"

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>

#include "signals/angles.h"

namespace sprung {
namespace {

TEST(AngleText, RadiansAndDegreesWithOrWithoutABlank) {
  EXPECT_EQ(parse_angle_rad("0.5rad"), 0.5);
  EXPECT_EQ(parse_angle_rad("-1.25 rad"), -1.25);
  EXPECT_NEAR(parse_angle_rad("30deg"), kPi / 6, 1e-15);
  EXPECT_NEAR(parse_angle_rad("-1e1 deg"), -kPi / 18, 1e-15);
}

TEST(AngleText, SpeedsAndAccelerationsHaveTheirOwnUnits) {
  EXPECT_EQ(parse_angle_rad("2rad/s", "/s"), 2.0);
  EXPECT_NEAR(parse_angle_rad("90 deg/s^2", "/s^2"), kPi / 2, 1e-15);
  EXPECT_THROW(parse_angle_rad("2rad", "/s"), std::invalid_argument);
  EXPECT_THROW(parse_angle_rad("2rad/s"), std::invalid_argument);
}

TEST(AngleText, WhatIsNoAngleIsRefusedWithAnExample) {
  for (const char* text : {"", "rad", "0.5", "0.5 m", "0.5radx", "x0.5rad", "nan rad", "inf rad", "--5rad"})
    EXPECT_THROW(parse_angle_rad(text), std::invalid_argument) << text;
  try {
    parse_angle_rad("0.5");
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()),
              "found '0.5', expected a number and its unit, as in 0.5rad or 30deg");
  }
}

}  // namespace
}  // namespace sprung
