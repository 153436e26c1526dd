/// Drives that take their time to change their mode: the old one acts and is shown until they confirm.
#include <gtest/gtest.h>

#include "robots/robot_loader.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

constexpr double kDelay_s = 0.008;

/// A jump of single_leg, in which its drives are told to go from position to torque control and back.
class ModeDelay : public testing::Test {
 protected:
  ModeDelay() { test::stand_up(robot_, false); }
  static SimOptions slow_drives() {
    SimOptions sim;
    sim.plant = {{"mode_delay_us", 1e6 * kDelay_s}};
    return sim;
  }
  /// Where the host closes position loops, its drives stay in torque control.
  static RobotConfig leg_with_loops_of_drives() {
    RobotConfig robot = load_robot("single_leg");
    for (ActuatorConfig& actuator : robot.actuators) actuator.position_loop = PositionLoopSide::kDrive;
    return robot;
  }
  RobotConfig config_ = leg_with_loops_of_drives();
  InProcessRobot robot_{config_, "best", slow_drives()};
};

TEST_F(ModeDelay, NoSwitchIsCountedBeforeTheDriveConfirmsIt) {
  OperatorCommand jump = test::order_of(OperatorKind::kJump, 3);
  jump.jump_count = 1;
  robot_.submit(jump);
  int asked_since = 0, switches = 0;
  DriveMode shown = robot_.drive_state().actuators[0].shown_mode;
  for (int cycle = 0; cycle < 4000; ++cycle) {
    robot_.tick();
    const DriveMode now = robot_.drive_state().actuators[0].shown_mode;
    if (now != shown) {
      ++switches;
      EXPECT_GE(asked_since * config_.cycle_s, kDelay_s - config_.cycle_s) << "in cycle " << cycle;
    }
    shown = now;
    asked_since = robot_.drive_command().actuators[0].mode == shown ? 0 : asked_since + 1;
  }
  EXPECT_GE(switches, 2) << "there and back";
  EXPECT_EQ(robot_.bridge().safety().level, SafetyLevel::kOperational)
      << robot_.bridge().safety().detail.data();
}

}  // namespace
}  // namespace sprung
