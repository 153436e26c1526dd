/// Whole robots whose nodes are guarded, on the shipped simulated devices: they boot, run, notice that the
/// bridge is gone, and stop where a node falls silent.
#include <gtest/gtest.h>

#include "drivers/canopen/emergency.h"
#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"

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
  RobotConfig config_ = guarded(GetParam());
  InProcessRobot robot_{config_, "best", SimOptions{}};
};

TEST_P(GuardedRobot, RunsForSecondsWithoutALoss) {
  run(2.0);
  EXPECT_FALSE(robot_.bridge().safety().latched) << robot_.bridge().safety().detail.data();
  for (const NodeHealth& node : robot_.bridge().bus_state().nodes) {
    EXPECT_EQ(node.heartbeat_losses + node.sdo_failures, 0);
    EXPECT_EQ(node.nmt_state, 5);
  }
}

// What follows in a drive is its master watch's business (tests/simulation/node).
TEST_P(GuardedRobot, EveryNodeSaysSoWhenTheBridgeAsksNoMore) {
  run(0.2);
  std::int64_t time_us = robot_.drive_state().stamp.utime_us;
  FrameBatch said;
  for (double t = 0.0; t < 0.1; t += config_.cycle_s)
    robot_.sim().advance_to(time_us += static_cast<std::int64_t>(1e6 * config_.cycle_s), said);
  std::size_t told = 0;
  for (const BusFrame& frame : said) {
    canopen::Emergency emergency;
    told += canopen::decode_emergency(frame.frame, emergency) && emergency.code == 0x8130 ? 1 : 0;
  }
  EXPECT_EQ(told, config_.actuators.size() + config_.encoder_cards.size());
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
