#include "tools/lab/gait/legged_trial.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

SimOptions slippery(double friction_scale) {
  SimOptions sim;
  sim.plant["friction_scale"] = friction_scale;
  return lying(sim);
}

/// Switched on, its legs fall from where they lie; homing is refused while a joint moves.
TEST(LeggedTrial, ARobotWithLittleFrictionIsHomedOnceItRests) {
  LeggedTrial trial(load_robot("pegasus"), "best", slippery(0.02));
  EXPECT_NO_THROW(trial.stand_up());
  EXPECT_EQ(trial.robot().motion_state().state, MotionPhase::kStanding);
}

/// Hung up, its legs are pendulums.
TEST(LeggedTrial, WhatNeverRestsIsRefusedWithTheJointThatMoves) {
  SimOptions swinging;
  swinging.plant = {{"friction_scale", 0.0}, {"suspended", 1.0}};
  LeggedTrial trial(load_robot("pegasus"), "best", swinging);
  try {
    trial.stand_up();
    FAIL() << "it rests";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(),
                testing::ContainsRegex("does not come to rest: after 20 s joint [fh][lr]_[a-z]+ still"));
  }
}

TEST(LeggedTrial, ARobotThatRestsIsHomedAfterTwoTenthsOfASecondAsEver) {
  const RobotConfig robot = load_robot("pegasus");
  LeggedTrial trial(robot, "best", slippery(1.0));
  const double booted_s = trial.simulated_s();
  trial.stand_up();
  EXPECT_NEAR(trial.simulated_s() - booted_s, 0.2 + 1.0 + robot.preset("best").rise_time_s + 1.0, 1e-9);
}

}  // namespace
}  // namespace sprung
