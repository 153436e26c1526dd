#include "drivers/bridge/command_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>
#include <limits>

#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
constexpr double kInfinity = std::numeric_limits<double>::infinity();

class CommandGateTest : public ::testing::Test {
 protected:
  CommandGateTest() {
    for (ActuatorState& actuator : state_.actuators) actuator.measured_position_rad = 1.0;
  }

  DriveCommand command(std::int64_t seq, DriveMode mode) const {
    DriveCommand command(2);
    command.stamp.seq = seq;
    command.valid_until_utime_us = 10'000;
    for (ActuatorCommand& actuator : command.actuators) actuator.mode = mode;
    return command;
  }
  bool accept(const DriveCommand& command, std::int64_t cycle = 5, std::int64_t time_us = 5'000) {
    return gate_.accept(command, cycle, time_us, state_);
  }
  std::string detail() const { return gate_.detail().data(); }

  CommandGate gate_{test::two_drive_robot()};
  DriveState state_{2};
};

TEST_F(CommandGateTest, GoodCommandsAreKeptAndAged) {
  DriveCommand good = command(4, DriveMode::kTorque);
  good.actuators[1].commanded_torque_Nm = -171.6;
  EXPECT_TRUE(accept(good));
  EXPECT_EQ(gate_.last().actuators[1].commanded_torque_Nm, -171.6);
  EXPECT_EQ(gate_.age_cycles(5), 1);
  EXPECT_EQ(gate_.refused(), 0);
}

TEST_F(CommandGateTest, OnlyAllDisabledArms) {
  EXPECT_TRUE(accept(command(1, DriveMode::kTorque)));
  EXPECT_FALSE(gate_.armed());
  DriveCommand half = command(2, DriveMode::kDisabled);
  half.actuators[1].mode = DriveMode::kDamping;
  EXPECT_TRUE(accept(half));
  EXPECT_FALSE(gate_.armed());
  EXPECT_TRUE(accept(command(3, DriveMode::kDisabled)));
  EXPECT_TRUE(gate_.armed());
  EXPECT_TRUE(accept(command(4, DriveMode::kTorque)));
  EXPECT_TRUE(gate_.armed());
  gate_.disarm();
  EXPECT_FALSE(gate_.armed());
}

TEST_F(CommandGateTest, SequenceMustGrowAndNotRunAhead) {
  EXPECT_FALSE(accept(command(-1, DriveMode::kDisabled))) << "the first one is of a cycle too";
  EXPECT_TRUE(accept(command(4, DriveMode::kDisabled)));
  EXPECT_FALSE(accept(command(4, DriveMode::kDisabled))) << "repeated";
  EXPECT_FALSE(accept(command(3, DriveMode::kDisabled))) << "older";
  EXPECT_FALSE(accept(command(6, DriveMode::kDisabled))) << "of a cycle to come";
  EXPECT_THAT(detail(), HasSubstr("command of cycle 6 in cycle 5, the last good one was of 4"));
  EXPECT_FALSE(accept(command(-1, DriveMode::kDisabled)));
  EXPECT_EQ(gate_.refused(), 5);
}

TEST_F(CommandGateTest, ExpiredAndMisshapenCommandsAreRefused) {
  EXPECT_FALSE(accept(command(5, DriveMode::kDisabled), 5, 10'001));
  EXPECT_THAT(detail(), HasSubstr("came 1 us after it expired"));
  for (const std::int64_t absurd : {std::numeric_limits<std::int64_t>::min(), std::int64_t{1'005'001},
                                    std::numeric_limits<std::int64_t>::max()}) {
    DriveCommand bad = command(5, DriveMode::kDisabled);
    bad.valid_until_utime_us = absurd;
    EXPECT_FALSE(accept(bad)) << absurd;
  }
  EXPECT_THAT(detail(), HasSubstr("valid for more than a second"));
  DriveCommand wide = command(5, DriveMode::kDisabled);
  wide.actuators.emplace_back();
  EXPECT_FALSE(accept(wide));
  EXPECT_THAT(detail(), HasSubstr("command for 3 actuators, expected 2"));
}

TEST_F(CommandGateTest, ValuesThatTheModeUsesAreJudged) {
  const struct {
    DriveMode mode;
    std::function<void(ActuatorCommand&)> bend;
    const char* says;
  } cases[] = {
      {DriveMode::kTorque, [](ActuatorCommand& a) { a.commanded_torque_Nm = kNaN; },
       "knee_motor: commanded torque nan"},
      {DriveMode::kTorque, [](ActuatorCommand& a) { a.commanded_torque_Nm = 172.0; },
       "172 Nm, limit 171.6 Nm"},
      {DriveMode::kTorque, [](ActuatorCommand& a) { a.commanded_torque_Nm = -kInfinity; },
       "commanded torque -inf"},
      {DriveMode::kPosition, [](ActuatorCommand& a) { a.commanded_torque_Nm = 172.0; },
       "172 Nm, limit 171.6 Nm"},
      {DriveMode::kPosition, [](ActuatorCommand& a) { a.commanded_position_rad = kNaN; },
       "commanded position nan"},
      {DriveMode::kPosition, [](ActuatorCommand& a) { a.commanded_position_rad = 22.0; },
       "22 rad, measured 1 rad"},
      {DriveMode::kDamping, [](ActuatorCommand& a) { a.commanded_damping_Nm_s_rad = -0.1; },
       "commanded damping -0.1"},
      {DriveMode::kDamping, [](ActuatorCommand& a) { a.commanded_damping_Nm_s_rad = 121.0; },
       "121 Nm s/rad, limit 120"},
      {DriveMode::kDamping, [](ActuatorCommand& a) { a.commanded_damping_Nm_s_rad = kNaN; },
       "commanded damping nan"},
      {DriveMode::kTorque, [](ActuatorCommand& a) { a.mode = static_cast<DriveMode>(9); },
       "unknown command mode 9"},
  };
  for (const auto& c : cases) {
    DriveCommand bad = command(5, c.mode);
    for (ActuatorCommand& actuator : bad.actuators) actuator.commanded_position_rad = 1.0;
    c.bend(bad.actuators[1]);
    EXPECT_FALSE(accept(bad)) << c.says;
    EXPECT_THAT(detail(), HasSubstr(c.says));
    EXPECT_TRUE(gate_.last_was_refused());
  }
  EXPECT_FALSE(gate_.any());
}

TEST_F(CommandGateTest, ValuesThatTheModeDoesNotUseMayBeUnset) {
  DriveCommand torque = command(4, DriveMode::kTorque);
  torque.actuators[0].commanded_position_rad = kNaN;
  torque.actuators[0].commanded_damping_Nm_s_rad = kNaN;
  EXPECT_TRUE(accept(torque)) << detail();
  DriveCommand position = command(5, DriveMode::kPosition);
  for (ActuatorCommand& actuator : position.actuators) actuator.commanded_position_rad = 2.0;
  position.actuators[0].commanded_torque_Nm = kNaN;
  EXPECT_TRUE(accept(position)) << detail();
}

TEST_F(CommandGateTest, RoundingAboveTheLimitPasses) {
  DriveCommand torque = command(4, DriveMode::kTorque);
  torque.actuators[0].commanded_torque_Nm = 171.6 * (1.0 + 1e-9);
  EXPECT_TRUE(accept(torque)) << detail();
}

}  // namespace
}  // namespace sprung
