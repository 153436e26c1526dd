/// pegasus before it stands: twelve EPOS2 and four encoder cards on four buses come up at 500 Hz, are
/// measured, and stay without torque, since nothing is referenced.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"

namespace sprung {
namespace {

class PegasusBoot : public testing::Test {
 protected:
  void run(double seconds) {
    for (int i = 0; i < static_cast<int>(std::lround(seconds / config_.cycle_s)); ++i) robot_.tick();
  }
  RobotConfig config_ = load_robot("pegasus");
  InProcessRobot robot_{config_, "best", SimOptions{}};
};

TEST_F(PegasusBoot, ComesUpOnFourBusesAndEveryNodeAnswersEverySync) {
  robot_.boot();
  EXPECT_EQ(robot_.cycle(), 0);
  for (int k = 0; k < 500; ++k) {
    ASSERT_TRUE(robot_.tick());
    for (std::size_t i = 0; i < 12; ++i) {
      const ActuatorState& a = robot_.drive_state().actuators[i];
      ASSERT_EQ(a.age_cycles, 0) << config_.actuators[i].name << " in cycle " << robot_.cycle();
      ASSERT_EQ(a.fault_code, 0) << config_.actuators[i].name;
      ASSERT_TRUE(std::isfinite(a.measured_link_position_rad)) << config_.actuators[i].name;
    }
  }
  EXPECT_EQ(robot_.cycle(), 500);
  EXPECT_EQ(robot_.bridge().safety().level, SafetyLevel::kOperational)
      << robot_.bridge().safety().detail.data();
}

TEST_F(PegasusBoot, LinkEncodersShowTheJointsWhateverTheMotorsCount) {
  robot_.boot();
  run(0.1);
  for (std::size_t i = 0; i < 12; ++i) {
    const ActuatorState& a = robot_.drive_state().actuators[i];
    EXPECT_NEAR(a.measured_link_position_rad, robot_.truth().joints[i].true_position_rad, 2e-3)
        << config_.joints[i].name;
    EXPECT_NEAR(a.measured_position_rad, 0.0, 0.2)
        << "an incremental encoder counts from where it was switched on";
    EXPECT_FALSE(a.referenced);
  }
}

TEST_F(PegasusBoot, StaysWithoutTorqueAndRefusesToStandWithItsReason) {
  robot_.boot();
  run(0.1);
  OperatorCommand stand;
  stand.kind = OperatorKind::kStand;
  stand.request_id = 1;
  robot_.submit(stand);
  run(0.5);
  OperatorReply reply;
  ASSERT_TRUE(robot_.next_reply(reply));
  EXPECT_EQ(reply.outcome, OperatorOutcome::kRefused);
  EXPECT_EQ(std::string(reply.reason), "a joint is not referenced: sprung home");
  for (const ActuatorState& a : robot_.drive_state().actuators) {
    EXPECT_NE(a.power_state, PowerState::kOperationEnabled);
    EXPECT_NEAR(a.measured_current_A, 0.0, 0.2);
  }
  EXPECT_EQ(robot_.motion_state().state, MotionPhase::kIdle);
}

TEST_F(PegasusBoot, HomingTakesTheZeroFromTheLinkEncoders) {
  robot_.boot();
  run(0.1);
  OperatorCommand home;
  home.kind = OperatorKind::kHome;
  home.request_id = 2;
  robot_.submit(home);
  run(1.0);
  std::string outcomes;
  for (OperatorReply reply; robot_.next_reply(reply);)
    outcomes += std::string(name(reply.outcome)) + " " + reply.reason + "; ";
  for (std::size_t i = 0; i < 12; ++i) {
    const ActuatorState& a = robot_.drive_state().actuators[i];
    EXPECT_TRUE(a.referenced) << outcomes;
    EXPECT_NEAR(a.measured_position_rad, robot_.truth().joints[i].true_position_rad, 2e-3)
        << config_.joints[i].name;
  }
}

TEST_F(PegasusBoot, TwoRunsAreAlikeBitForBit) {
  InProcessRobot twin(config_, "best", SimOptions{});
  robot_.boot();
  twin.boot();
  for (int k = 0; k < 200; ++k) {
    robot_.tick();
    twin.tick();
    for (std::size_t i = 0; i < 12; ++i) {
      const ActuatorState& a = robot_.drive_state().actuators[i];
      const ActuatorState& b = twin.drive_state().actuators[i];
      ASSERT_EQ(a.measured_position_rad, b.measured_position_rad);
      ASSERT_EQ(a.measured_link_position_rad, b.measured_link_position_rad);
      ASSERT_EQ(a.measured_current_A, b.measured_current_A);
    }
  }
}

}  // namespace
}  // namespace sprung
