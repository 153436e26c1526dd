/// Whole robots whose nodes are guarded, on the shipped simulated devices: they boot, stand the loss of the
/// bridge as with heartbeats, and stop where a node falls silent.
#include <gtest/gtest.h>

#include <optional>

#include "drivers/canopen/emergency.h"
#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

RobotConfig guarded(const std::string& name) {
  RobotConfig robot = load_robot(name);
  for (ActuatorConfig& actuator : robot.actuators) actuator.watch = NodeWatch::kGuarding;
  for (EncoderCardConfig& card : robot.encoder_cards) card.watch = NodeWatch::kGuarding;
  return robot;
}

class GuardedRobot : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override { robot_.boot(); }
  void run(double time_s) {
    for (double t = 0.0; t < time_s; t += config_.cycle_s) robot_.tick();
  }
  bool powered() const {
    for (const ActuatorState& a : robot_.drive_state().actuators)
      if (a.power_state == PowerState::kOperationEnabled) return true;
    return false;
  }
  RobotConfig config_ = guarded(GetParam());
  InProcessRobot robot_{config_, "best", SimOptions{}};
};

TEST_P(GuardedRobot, RunsForSecondsWithoutALoss) {
  run(2.0);
  EXPECT_EQ(robot_.bridge().safety().level, SafetyLevel::kDisabled);
  for (const NodeHealth& node : robot_.bridge().bus_state().nodes) {
    EXPECT_EQ(node.heartbeat_losses + node.emergencies + node.sdo_failures, 0);
    EXPECT_EQ(node.nmt_state, 5);
  }
}

// EMCY 0x8130, and the abort option of 0x6007: no power.
TEST_P(GuardedRobot, DrivesLetGoWhenTheBridgeAsksNoMore) {
  run(0.2);
  robot_.stop(StackProcess::kBridge);
  run(0.5);
  robot_.stop(StackProcess::kBridge, false);
  run(0.1);
  int told = 0;
  for (const NodeHealth& node : robot_.bridge().bus_state().nodes) told += node.emergencies > 0 ? 1 : 0;
  EXPECT_EQ(told, static_cast<int>(robot_.bridge().bus_state().nodes.size()));
  EXPECT_FALSE(powered());
  EXPECT_TRUE(robot_.bridge().safety().latched);
}

TEST_P(GuardedRobot, NodeThatAnswersNoMoreIsSilent) {
  run(0.2);
  SimControl control;
  control.kind = SimControlKind::kNodeFault;
  control.fault = FaultKind::kHeartbeatStopped;
  control.actuator = 0;
  robot_.sim().control(control);
  run(0.3);
  EXPECT_EQ(robot_.bridge().safety().cause, SafetyCause::kDriveSilent);
  EXPECT_EQ(robot_.bridge().bus_state().nodes[0].heartbeat_losses, 1);
}

INSTANTIATE_TEST_SUITE_P(Robots, GuardedRobot, testing::Values("single_leg", "pegasus"));

}  // namespace
}  // namespace sprung
