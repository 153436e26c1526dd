#include "tools/lab/commission/commission_experiment.h"

#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// `sprung experiment commission` draws 30; here each kind once would take too long.
TEST(CommissionExperiment, DrawnMistakesAreFoundInTimeAndRightDrivesPass) {
  const std::vector<RobotConfig> robots = {load_robot("single_leg"), load_robot("pegasus")};
  const std::vector<CommissionOutcome> outcomes = run_commission_cases(robots, 3, 6, {});
  ASSERT_EQ(outcomes.size(), 12U);
  for (const CommissionOutcome& one : outcomes) {
    EXPECT_TRUE(one.right()) << name(one.mistake) << ", " << one.detail << " on " << one.drive << ": "
                             << (one.found_at.empty() ? "nothing" : one.found_at);
    if (one.mistake == Mistake::kNone) continue;
    EXPECT_LE(one.torque_share, kTorqueShare) << name(one.mistake);
    EXPECT_LE(one.motion_rad, kMotion_rad) << name(one.mistake);
  }
}

/// What only motion can show: a Gold tells none of it.
TEST(CommissionExperiment, MistakesThatOnlyMotionShowsAreFoundThere) {
  const RobotConfig robot = load_robot("single_leg");
  Dice dice(5);
  for (const Mistake mistake : {Mistake::kPolePairs, Mistake::kPhases, Mistake::kCurrentGains}) {
    const CommissionOutcome one = run_commission_case(draw_case(robot, mistake, 7, dice));
    EXPECT_EQ(one.found_at, mistake == Mistake::kCurrentGains ? "current step" : "commutation and signs")
        << name(mistake) << " " << one.detail;
    EXPECT_LE(one.torque_share, kTorqueShare);
    EXPECT_LE(one.motion_rad, kMotion_rad);
  }
}

TEST(CommissionExperiment, TheSameSeedDrawsTheSame) {
  const RobotConfig robot = load_robot("pegasus");
  Dice first(9), second(9);
  const CommissionCase a = draw_case(robot, Mistake::kLimits, 1, first);
  const CommissionCase b = draw_case(robot, Mistake::kLimits, 1, second);
  EXPECT_EQ(a.actuator, b.actuator);
  EXPECT_EQ(a.detail, b.detail);
  EXPECT_EQ(a.setup.sim.plant, b.setup.sim.plant);
}

TEST(CommissionExperiment, AMistakeThatAMakeCannotHaveIsRefused) {
  const RobotConfig robot = load_robot("single_leg");
  Dice dice(1);
  EXPECT_THROW((void)draw_case(robot, Mistake::kBitRate, 1, dice), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
