/// What a drive tells beside its cycle and stops the robot: its emergency input, its supply. Both makes of
/// drive, whole robot.
#include <gtest/gtest.h>

#include <functional>
#include <string>

#include "robots/robot_loader.h"
#include "simulation/in_process/inprocess_robot.h"
#include "tests/simulation/in_process/operator_order.h"

namespace sprung {
namespace {

/// single_leg standing, robot.yaml bent before.
class DriveInputs : public testing::Test {
 protected:
  static RobotConfig bent(const std::string& name, const std::function<void(ActuatorConfig&)>& bend) {
    RobotConfig config = load_robot(name);
    bend(config.actuators[1]);
    return config;
  }
  static const SafetyState& safety(const InProcessRobot& robot) { return robot.bridge().safety(); }
  /// The last answer of the bridge to a clear.
  static OperatorReply clear(InProcessRobot& robot, std::int64_t id) {
    robot.submit(test::order_of(OperatorKind::kClear, id));
    OperatorReply reply, last;
    for (int i = 0; i < 1000; ++i) {
      robot.tick();
      while (robot.next_reply(reply))
        if (reply.request_id == id) last = reply;
    }
    return last;
  }
};

class EmergencyInputLevel : public DriveInputs, public testing::WithParamInterface<bool> {};

TEST_P(EmergencyInputLevel, EmergencyInputTakesThePowerAtOnceAndHoldsOffTheClear) {
  const RobotConfig config = bent("single_leg", [](ActuatorConfig& a) {
    a.emergency_input = {3, GetParam()};
  });
  InProcessRobot robot(config, "best", {});
  robot.boot();
  for (int i = 0; i < 20; ++i) robot.tick();  // a Gold tells its inputs at every seventh SYNC
  test::stand_up(robot, false);
  test::make_fault(robot, 1, FaultKind::kEmergencyInput, 0.0, 2.0);
  for (int i = 0; i < 15; ++i) robot.tick();  // seven cycles until the frame, at most
  EXPECT_EQ(safety(robot).level, SafetyLevel::kDisabled);
  EXPECT_EQ(safety(robot).cause, SafetyCause::kEmergencyStop);
  EXPECT_EQ(safety(robot).actuator, 1);
  EXPECT_STREQ(safety(robot).detail.data(), "emergency stop by the input of knee_motor");
  const OperatorReply refused = clear(robot, 50);
  EXPECT_EQ(refused.outcome, OperatorOutcome::kRefused);
  EXPECT_STREQ(refused.reason, "the emergency stop at a drive's input is still pressed: release it");
  for (int i = 0; i < 1500; ++i) robot.tick();
  EXPECT_EQ(clear(robot, 51).outcome, OperatorOutcome::kDone);
  robot.submit(test::order_of(OperatorKind::kStand, 52));
  test::tick_until(robot, MotionPhase::kStanding);
}

INSTANTIATE_TEST_SUITE_P(StopsAtZeroOrOne, EmergencyInputLevel, testing::Bool());

TEST_F(DriveInputs, RobotDoesNotMoveBeforeTheInputIsReleased) {
  const RobotConfig config = bent("pegasus", [](ActuatorConfig& a) { a.emergency_input = {15, false}; });
  InProcessRobot robot(config, "best", {});
  test::make_fault(robot, 1, FaultKind::kEmergencyInput, 0.0, 5.0);
  robot.boot();
  for (int i = 0; i < 200; ++i) robot.tick();
  EXPECT_EQ(safety(robot).cause, SafetyCause::kEmergencyStop) << safety(robot).detail.data();
  for (int i = 0; i < 3000; ++i) robot.tick();
  EXPECT_EQ(clear(robot, 50).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(safety(robot).level, SafetyLevel::kOperational) << safety(robot).detail.data();
}

TEST_F(DriveInputs, SupplyOutOfItsRangeDampsTheRobotBeforeTheDriveGivesUp) {
  const RobotConfig config = bent("single_leg", [](ActuatorConfig& a) { a.supply = {44.0, 56.0}; });
  InProcessRobot robot(config, "best", {});
  test::stand_up(robot, false);
  for (int i = 0; i < 2000; ++i) robot.tick();
  ASSERT_EQ(safety(robot).level, SafetyLevel::kOperational);
  test::make_fault(robot, 1, FaultKind::kUnderVoltage, 40.0, 5.0);
  for (int i = 0; i < 1100; ++i) robot.tick();
  EXPECT_EQ(safety(robot).cause, SafetyCause::kSupply);
  EXPECT_STREQ(safety(robot).detail.data(), "knee_motor: supply of 40.0 V, robot.yaml allows 44.0 to 56.0 V");
}

}  // namespace
}  // namespace sprung
