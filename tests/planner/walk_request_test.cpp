#include "planner/walk_request.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

PresetConfig preset() {
  PresetConfig out;
  out.stand_length_m = 0.47;
  out.walk.stance_width_m = 0.03;
  return out;
}

TEST(WalkRequestTest, WhatIsLeftOpenIsThePresets) {
  OperatorCommand command;
  command.gait = 2;
  const WalkRequest request = walk_request(command, preset(), {});
  EXPECT_EQ(request.height_m, 0.47);
  EXPECT_EQ(request.stance_width_m, 0.03);
  EXPECT_EQ(request.speed, (std::array<double, 3>{0.0, 0.0, 0.0}));
  EXPECT_EQ(request.control, GaitControl::kAdaptive);
}

TEST(WalkRequestTest, AGaitMayHaveAHeightOfItsOwn) {
  std::vector<GaitConfig> gaits(2);
  gaits[1].height_m = 0.44;
  OperatorCommand command;
  command.gait = 1;
  EXPECT_EQ(walk_request(command, preset(), gaits).height_m, 0.44);
  command.gait = 0;
  EXPECT_EQ(walk_request(command, preset(), gaits).height_m, 0.47);
  command.gait = 1;
  command.body_height_m = 0.4;
  EXPECT_EQ(walk_request(command, preset(), gaits).height_m, 0.4);
}

TEST(WalkRequestTest, WhatTheOperatorSaysIsTaken) {
  OperatorCommand command;
  command.gait = 3;
  command.walk_speed = {0.1, -0.2, 0.3};
  command.body_height_m = 0.4;
  command.stance_width_m = 0.0;
  command.gait_control = GaitControl::kPreStance;
  const WalkRequest request = walk_request(command, preset(), {});
  EXPECT_EQ(request.gait, 3);
  EXPECT_EQ(request.speed, (std::array<double, 3>{0.1, -0.2, 0.3}));
  EXPECT_EQ(request.height_m, 0.4);
  EXPECT_EQ(request.stance_width_m, 0.0);
  EXPECT_EQ(request.control, GaitControl::kPreStance);
}

}  // namespace
}  // namespace sprung
