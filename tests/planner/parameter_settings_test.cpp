#include "planner/parameter_settings.h"

#include <gtest/gtest.h>

#include <string>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

class ParameterSettingsTest : public testing::Test {
 protected:
  static std::int64_t named(const std::string& name) { return parameter_id(name); }
  double stiffness() const { return settings_.acting().preset.compliance.stiffness_N_m[2]; }
  bool after(double seconds) { return settings_.advance(static_cast<std::int64_t>(seconds * 1e6)); }
  const RobotConfig robot_ = load_robot("pegasus");
  ParameterSettings settings_{robot_, robot_.preset("best")};
};

TEST_F(ParameterSettingsTest, ANewValueIsReachedInASecondInAStraightLine) {
  EXPECT_FALSE(after(0.0));
  settings_.set(named("compliance.stiffness.z"), 6000.0, 0);
  EXPECT_TRUE(after(0.25));
  EXPECT_DOUBLE_EQ(stiffness(), 3750.0);
  EXPECT_TRUE(after(1.0));
  EXPECT_EQ(stiffness(), 6000.0);
  EXPECT_FALSE(after(1.1));
}

TEST_F(ParameterSettingsTest, AnotherValueOnTheWayBeginsWhereItIs) {
  settings_.set(named("compliance.stiffness.z"), 6000.0, 0);
  after(0.5);
  settings_.set(named("compliance.stiffness.z"), 3000.0, 500'000);
  after(0.5);
  EXPECT_DOUBLE_EQ(stiffness(), 4500.0);
  after(1.5);
  EXPECT_EQ(stiffness(), 3000.0);
}

TEST_F(ParameterSettingsTest, ClockThatBeginsAnewEndsTheRamp) {
  settings_.set(named("compliance.stiffness.z"), 6000.0, 5'000'000);
  EXPECT_TRUE(after(0.0));
  EXPECT_EQ(stiffness(), 6000.0);
}

TEST_F(ParameterSettingsTest, TellsWhichAreNotRobotYamls) {
  EXPECT_EQ(settings_.next_changed(0)->id, 0);
  const std::int64_t one = named("compliance.stiffness.z"), other = named("walk.force_rise");
  settings_.set(other, 0.05, 0);
  settings_.set(one, 2000.0, 0);
  EXPECT_EQ(settings_.next_changed(0)->id, one);
  EXPECT_EQ(settings_.next_changed(0)->value, 2000.0);
  EXPECT_EQ(settings_.next_changed(one)->id, other);
  EXPECT_EQ(settings_.next_changed(other)->id, 0);
  EXPECT_FALSE(settings_.next_changed(12345)) << "there is none of that id";
}

TEST_F(ParameterSettingsTest, WhatMayNotBeIsRefusedWithTheReason) {
  const auto why = [&](std::int64_t parameter, double value, MotionPhase state = MotionPhase::kStanding) {
    const char* text = settings_.why_not(parameter, value, state);
    return std::string(text == nullptr ? "" : text);
  };
  EXPECT_EQ(why(named("compliance.stiffness.z"), 6000.0), "");
  EXPECT_EQ(why(named("compliance.stiffness.z"), 6000.1), "beyond its range");
  EXPECT_EQ(why(named("gaits.trot.fastest.forward"), 0.41),
            "beyond its range: a limit may only be tightened");
  EXPECT_EQ(why(-1, 1.0), "no such parameter of this robot under this preset");
  EXPECT_EQ(why(10'000, 1.0), "no such parameter of this robot under this preset");
  EXPECT_EQ(why(named("walk.force_rise"), kNaN), "the value is no number");
  EXPECT_EQ(why(named("stand_length"), 0.5), "");
  EXPECT_EQ(why(named("stand_length"), 0.5, MotionPhase::kComplying),
            "only while the robot stands, walks or is off");
}

}  // namespace
}  // namespace sprung
