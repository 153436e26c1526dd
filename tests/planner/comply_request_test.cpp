#include "planner/comply_request.h"

#include <gtest/gtest.h>

#include <limits>

namespace sprung {
namespace {

class ComplyRequestTest : public testing::Test {
 protected:
  ComplyRequestTest() {
    preset_.friction_compensation = 0.8;
    preset_.compliance = {{500.0, 0.0, 600.0}, {20.0, 0.0, 30.0}, 0.5};
    command_.stiffness_N_m = {2000.0, kNaN, 1500.0};
    command_.damping_N_s_m = {40.0, kNaN, 50.0};
  }
  std::string validate() const {
    const char* why = validate_comply(command_, preset_);
    return why == nullptr ? "" : why;
  }
  PresetConfig preset_;
  OperatorCommand command_;
};

TEST_F(ComplyRequestTest, WhatTheCommandSaysCountsAndWhatItLeavesOpenIsThePresets) {
  command_.stiffness_N_m[2] = kNaN;
  command_.damping_N_s_m = {kNaN, kNaN, kNaN};
  const ComplyRequest request = comply_request(command_, preset_);
  EXPECT_EQ(request.gains.stiffness_N_m, (Vec3{2000.0, 0.0, 600.0}));
  EXPECT_EQ(request.gains.damping_N_s_m, (Vec3{20.0, 0.0, 30.0}));
  EXPECT_EQ(request.gains.velocity_feedforward, 0.5);
  EXPECT_EQ(request.friction_compensation, 0.8);
  EXPECT_EQ(validate(), "");
}

TEST_F(ComplyRequestTest, FrictionCompensationOfZeroIsNotLeftOpen) {
  command_.friction_compensation = 0.0;
  EXPECT_EQ(comply_request(command_, preset_).friction_compensation, 0.0);
}

TEST_F(ComplyRequestTest, StiffnessMissingInBothIsNamed) {
  preset_.compliance = {};
  EXPECT_EQ(validate(), "");
  command_.stiffness_N_m[2] = kNaN;
  EXPECT_EQ(validate(), "stiffness is missing: this preset has no compliance of its own, give x and z");
  command_.stiffness_N_m[2] = 1500.0;
  command_.damping_N_s_m[0] = kNaN;
  EXPECT_EQ(validate(), "damping is missing: this preset has no compliance of its own, give x and z");
}

TEST_F(ComplyRequestTest, ImpossibleValuesAreNamed) {
  const double infinite = std::numeric_limits<double>::infinity();
  for (double wrong : {-1.0, infinite, -infinite, 1.1 * kStiffest_N_m}) {
    for (std::size_t axis = 0; axis < 3; ++axis) {
      OperatorCommand command = command_;
      command.stiffness_N_m[axis] = wrong;
      EXPECT_STREQ(validate_comply(command, preset_), "stiffness must be 0 to 100000 N/m");
      command = command_;
      command.damping_N_s_m[axis] = wrong;
      EXPECT_STREQ(validate_comply(command, preset_), "damping must be 0 to 10000 N s/m");
    }
  }
  for (double wrong : {-0.1, 1.01, infinite}) {
    command_.friction_compensation = wrong;
    EXPECT_EQ(validate(), "friction compensation must be 0 to 1");
  }
}

}  // namespace
}  // namespace sprung
