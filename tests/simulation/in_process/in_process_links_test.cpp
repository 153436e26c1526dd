#include "simulation/in_process/in_process_links.h"

#include <gtest/gtest.h>

#include <cmath>

#include "drivers/canopen/protocol.h"
#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

class Disturbed : public InProcessLinks {
 public:
  bool pass(JointState& message) noexcept override {
    message.joints[1].estimated_position_rad += shift_rad;
    return !lose;
  }
  void sent(const FrameBatch& frames) noexcept override { frames_sent += frames.size(); }
  void answered(const FrameBatch& frames) noexcept override { frames_answered += frames.size(); }
  void add_foreign(FrameBatch& frames) noexcept override {
    if (strange) frames.push(0, foreign);
  }

  bool lose = false, strange = false;
  double shift_rad = 0.0;
  CanFrame foreign;
  int frames_sent = 0, frames_answered = 0;
};

class InProcessLinksTest : public testing::Test {
 protected:
  InProcessLinksTest() { robot_.put_on_links(&links_); }
  void ticks(int count) {
    for (int i = 0; i < count; ++i) robot_.tick();
  }
  const RobotConfig config_ = load_robot("single_leg");
  Disturbed links_;
  InProcessRobot robot_{config_, "best", {}};
};

TEST_F(InProcessLinksTest, WhatPassesUnchangedChangesNothing) {
  InProcessRobot other(config_, "best", {});
  test::stand_up(robot_, false);
  test::stand_up(other, false);
  EXPECT_EQ(robot_.truth().joints[1].true_position_rad, other.truth().joints[1].true_position_rad);
  EXPECT_GT(links_.frames_sent, 0);
  EXPECT_GT(links_.frames_answered, 0);
}

TEST_F(InProcessLinksTest, LostMessagesStopTheRobot) {
  test::stand_up(robot_, false);
  links_.lose = true;
  ticks(300);
  EXPECT_EQ(robot_.bridge().safety().cause, SafetyCause::kCommandStale);
  EXPECT_TRUE(robot_.bridge().safety().latched);
}

TEST_F(InProcessLinksTest, ReceiversHearWhatWasChangedAndTheSenderKeepsItsOwn) {
  test::stand_up(robot_, false);
  robot_.submit(test::order_of(OperatorKind::kComply, 3));
  test::tick_until(robot_, MotionPhase::kComplying);
  ticks(500);
  const double before_Nm = robot_.truth().joints[1].true_motor_torque_Nm;
  links_.shift_rad = 0.05;
  ticks(200);
  EXPECT_NEAR(robot_.joint_state().joints[1].estimated_position_rad,
              robot_.truth().joints[1].true_position_rad, 0.01);
  EXPECT_GT(std::abs(robot_.truth().joints[1].true_motor_torque_Nm - before_Nm), 5.0)
      << "the foot's spring is drawn by what the controller hears";
}

TEST_F(InProcessLinksTest, StrangersFrameIsHeardByDrivesAndBridge) {
  test::stand_up(robot_, false);
  links_.foreign.id = canopen::kNmtId;
  links_.foreign.length = 2;
  links_.foreign.data = {0x80, static_cast<std::uint8_t>(config_.actuators[1].node)};
  links_.strange = true;
  ticks(1);
  links_.strange = false;
  ticks(100);
  EXPECT_EQ(robot_.bridge().safety().cause, SafetyCause::kForeignMaster);
  EXPECT_NE(robot_.bridge().bus_state().nodes[1].nmt_state, 5) << "the drive has obeyed";
}

TEST(WrongFile, MachineIsNotWhatTheStackWasTold) {
  const RobotConfig machine = load_robot("single_leg");
  RobotConfig file = machine;
  file.actuators[0].offset_rad += 0.2;
  InProcessRobot robot(file, "best", machine, {});
  robot.boot();
  for (int i = 0; i < 200; ++i) robot.tick();
  EXPECT_NEAR(robot.joint_state().joints[0].estimated_position_rad,
              robot.truth().joints[0].true_position_rad + 0.2, 0.01);
}

}  // namespace
}  // namespace sprung
