// `sprung home`: every way to a zero, and everything that forbids it.
#include "drivers/bridge/homing.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "signals/angles.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

RobotConfig unreferenced_robot(ReferenceMethod method) {
  RobotConfig robot = test::robot_with_card();
  for (ActuatorConfig& actuator : robot.actuators) {
    actuator.referenced = false;
    actuator.reference = {method, true, 0.4, 0.02};
  }
  return robot;
}

class BridgeHoming : public ::testing::Test {
 protected:
  void boot(const RobotConfig& robot) {
    bench_ = std::make_unique<test::BridgeBench>(robot);
    for (test::FakeDrive& drive : bench_->drives) drive.position_counts = 10'000;
    bench_->cards[0].sample.counts[1] = 1048576 / 10;
    ASSERT_TRUE(bench_->boot()) << bench_->bridge->boot_detail();
    bench_->run(50);
  }
  OperatorReply home(int actuator = -1, ReferenceSource source = ReferenceSource::kConfigured) {
    OperatorCommand command;
    command.kind = OperatorKind::kHome;
    command.request_id = ++request_;
    command.actuator = actuator;
    command.reference_source = source;
    OperatorReply reply = bench_->bridge->operator_command(command, bench_->time_us);
    for (int i = 0; i < 2000 && reply.outcome == OperatorOutcome::kAccepted; ++i) {
      bench_->tick();
      bench_->bridge->next_reply(reply);
    }
    return reply;
  }
  const ActuatorState& actuator(std::size_t i) const { return bench_->state.actuators[i]; }
  NodeHealth health(std::size_t i) const { return bench_->bridge->bus_state().nodes[i]; }

  std::unique_ptr<test::BridgeBench> bench_;
  std::int64_t request_ = 100;
};

TEST_F(BridgeHoming, JigSaysWhereTheJointsAre) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  ASSERT_FALSE(actuator(0).referenced);
  EXPECT_TRUE(std::isnan(health(0).reference_offset_rad));
  EXPECT_EQ(home().outcome, OperatorOutcome::kDone);
  bench_->tick();
  for (std::size_t i = 0; i < 2; ++i) {
    EXPECT_TRUE(actuator(i).referenced);
    EXPECT_DOUBLE_EQ(actuator(i).measured_position_rad, 0.4);
    EXPECT_EQ(health(i).reference_source, ReferenceSource::kJig);
  }
  const double counts_rad = 10'000 * 2 * kPi / (131072.0 * 100);
  EXPECT_NEAR(health(0).reference_offset_rad, 0.4 - counts_rad, 1e-12);
  EXPECT_NEAR(health(1).reference_offset_rad, 0.4 + counts_rad, 1e-12) << "its motor runs the other way";
  EXPECT_EQ(bench_->bridge->homings(), 1);
  EXPECT_EQ(bench_->bridge->encoder_counts(1), 10'000);
}

TEST_F(BridgeHoming, LinkEncoderGivesTheMotorItsPosition) {
  boot(unreferenced_robot(ReferenceMethod::kLink));
  EXPECT_EQ(home().outcome, OperatorOutcome::kDone);
  bench_->tick();
  EXPECT_NEAR(actuator(0).measured_position_rad, 0.1, 1e-12);
  EXPECT_NEAR(actuator(1).measured_position_rad, 0.1 + 2 * kPi * 104857 / 1048576, 1e-12);
  EXPECT_EQ(health(1).reference_source, ReferenceSource::kLink);
}

TEST_F(BridgeHoming, TorqueComesOnlyAfterHomingAndGoesToTheRightPlace) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  bench_->enable();
  EXPECT_NE(bench_->drives[0].power, PowerState::kOperationEnabled);
  EXPECT_THAT(bench_->detail(), HasSubstr("hip_motor is not referenced"));
  bench_->command_all(DriveMode::kDisabled);
  bench_->run(5);
  ASSERT_EQ(home().outcome, OperatorOutcome::kDone);
  bench_->enable(DriveMode::kPosition);
  EXPECT_EQ(bench_->drives[0].power, PowerState::kOperationEnabled);
  EXPECT_EQ(bench_->drives[0].target_position_counts, 10'000) << "where it stands";
}

TEST_F(BridgeHoming, OneActuatorAloneLeavesTheOthers) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  EXPECT_EQ(home(1).outcome, OperatorOutcome::kDone);
  bench_->tick();
  EXPECT_FALSE(actuator(0).referenced);
  EXPECT_TRUE(actuator(1).referenced);
  EXPECT_STREQ(home(2).reason, "no such actuator");
}

TEST_F(BridgeHoming, RepeatedRequestGetsItsLastAnswer) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  EXPECT_EQ(home().outcome, OperatorOutcome::kDone);
  --request_;
  EXPECT_EQ(home().outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench_->bridge->homings(), 1);
}

TEST_F(BridgeHoming, IsRefusedUnderPower) {
  RobotConfig robot = unreferenced_robot(ReferenceMethod::kJig);
  robot.actuators[0].referenced = true;
  robot.actuators[0].link_encoder.card = -1;
  boot(robot);
  bench_->enable();
  EXPECT_STREQ(home(1).reason, "a drive has power: sprung sit or estop first");
}

TEST_F(BridgeHoming, IsRefusedWhileDrivesAreBeingEnabled) {
  RobotConfig robot = unreferenced_robot(ReferenceMethod::kJig);
  robot.actuators[0].referenced = true;
  robot.actuators[0].link_encoder.card = -1;
  boot(robot);
  bench_->run(3);
  bench_->command_all(DriveMode::kTorque);
  for (int i = 0; i < 10 && bench_->drives[0].power != PowerState::kReadyToSwitchOn; ++i) bench_->tick();
  ASSERT_EQ(bench_->drives[0].power, PowerState::kReadyToSwitchOn);
  EXPECT_STREQ(home().reason, "drives are being enabled: sprung sit or estop first");
  EXPECT_EQ(health(0).reference_source, ReferenceSource::kConfigured);
}

TEST_F(BridgeHoming, FailsWhenTorqueIsCommandedBeforeItIsDone) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  OperatorCommand command;
  command.kind = OperatorKind::kHome;
  command.request_id = ++request_;
  bench_->run(3);
  bench_->command_all(DriveMode::kTorque);
  bench_->mute_commands = true;
  bench_->tick();
  ASSERT_EQ(bench_->bridge->operator_command(command, bench_->time_us).outcome, OperatorOutcome::kAccepted);
  bench_->command.stamp = bench_->state.stamp;
  bench_->command.valid_until_utime_us = bench_->time_us + 21000;
  ASSERT_TRUE(bench_->bridge->command(bench_->command, bench_->time_us));
  OperatorReply reply;
  for (int i = 0; i < 10 && !bench_->bridge->next_reply(reply); ++i) bench_->tick();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
  EXPECT_STREQ(reply.reason, "drives are being enabled: sprung sit or estop first");
  EXPECT_FALSE(actuator(0).referenced);
}

TEST_F(BridgeHoming, IsRefusedWhileAJointMoves) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  for (int i = 0; i < 50; ++i) {
    bench_->drives[1].position_counts += 500;
    bench_->tick();
  }
  EXPECT_STREQ(home().reason, "a joint moves");
  bench_->tick();
  EXPECT_FALSE(actuator(0).referenced) << "all or none";
}

TEST_F(BridgeHoming, LinkWithoutASampleOrAnEncoderIsRefused) {
  RobotConfig robot = unreferenced_robot(ReferenceMethod::kLink);
  robot.actuators[0].link_encoder.card = -1;
  boot(robot);
  EXPECT_STREQ(home(0).reason, "an actuator has no link encoder in robot.yaml");
  bench_->cards[0].mute_samples = true;
  bench_->tick();
  EXPECT_STREQ(home(1).reason, "no sample from an encoder card");
}

TEST_F(BridgeHoming, AnswersThatAreMissingInACycleAreWaitedFor) {
  boot(unreferenced_robot(ReferenceMethod::kLink));
  bench_->drives[0].mute_samples = true;
  bench_->tick();
  int answers = 0;
  bench_->on_answers = [this, &answers](std::vector<CanFrame>& frames) {
    // First the drive is back without the card, then both.
    if (frames.empty() || ++answers > 2) return;
    bench_->drives[0].mute_samples = false;
    bench_->cards[0].mute_samples = answers == 1;
  };
  EXPECT_EQ(home().outcome, OperatorOutcome::kDone);
  EXPECT_TRUE(actuator(0).referenced);
  EXPECT_NEAR(actuator(1).measured_position_rad, actuator(1).measured_link_position_rad, 1e-9);
}

TEST_F(BridgeHoming, DriveThatStaysSilentIsNotWaitedFor) {
  boot(unreferenced_robot(ReferenceMethod::kLink));
  bench_->drives[0].mute_samples = true;
  bench_->tick();
  const std::int64_t begun_us = bench_->time_us;
  EXPECT_STREQ(home().reason, "a drive does not answer");
  EXPECT_LE(bench_->time_us - begun_us, 5'000);
  EXPECT_STREQ(home().reason, "a drive does not answer") << "refused at once";
  EXPECT_FALSE(actuator(1).referenced) << "all or none";
}

TEST_F(BridgeHoming, MethodThatRobotYamlDoesNotNameIsRefused) {
  boot(unreferenced_robot(ReferenceMethod::kNone));
  EXPECT_STREQ(home().reason, "robot.yaml names no way to find this reference");
  EXPECT_STREQ(home(0, ReferenceSource::kJig).reason, "an actuator has no jig position in robot.yaml");
  EXPECT_THAT(home(0, ReferenceSource::kIndex).reason, HasSubstr("an actuator has no index"));
  EXPECT_EQ(home(0, ReferenceSource::kLink).outcome, OperatorOutcome::kDone);
}

TEST_F(BridgeHoming, IsRefusedWhileBooting) {
  boot(unreferenced_robot(ReferenceMethod::kJig));
  BridgeCore fresh(bench_->robot, {bench_->robot.watchdogs});
  OperatorCommand command;
  command.kind = OperatorKind::kHome;
  EXPECT_STREQ(fresh.operator_command(command, 0).reason, "drives are still being configured");
}

/// EPOS2 keeps its count at the index: 0x2021.
class BridgeHomingByIndex : public BridgeHoming {
 protected:
  void SetUp() override {
    RobotConfig robot = unreferenced_robot(ReferenceMethod::kIndex);
    robot.encoder_cards.clear();
    for (ActuatorConfig& actuator : robot.actuators) {
      actuator.profile = "epos2";
      actuator.identity = {0xFB, 0x63220000, 0, 0};
      actuator.gear_ratio = 50;
      actuator.encoder_counts_per_turn = 2000;
      actuator.torque_constant_Nm_A = 0.217;
      actuator.rated_current_A = 2.12;
      actuator.torque_limit_Nm = 20;
      actuator.speed_limit_rad_s = 4;
      actuator.speed_limit_object = 0;
      actuator.position_gains_object = 0;
      actuator.link_encoder = {};
    }
    bench_ = std::make_unique<test::BridgeBench>(robot);
    for (test::FakeDrive& drive : bench_->drives) {
      drive.position_counts = 900;
      drive.objects[{0x2021, 0}] = 300;
    }
    ASSERT_TRUE(bench_->boot()) << bench_->bridge->boot_detail();
    bench_->run(50);
  }
};

TEST_F(BridgeHomingByIndex, TakesTheMotorTurnThatIsNearestToTheJig) {
  EXPECT_EQ(home().outcome, OperatorOutcome::kDone);
  bench_->tick();
  const double turn_rad = 2 * kPi / 50;
  for (std::size_t i = 0; i < 2; ++i) {
    // At the index the actuator is at 0.02 rad, whole motor turns aside; now 600 counts further.
    const double direction = i == 0 ? 1.0 : -1.0;
    const double at_index_rad = actuator(i).measured_position_rad - direction * 600 * turn_rad / 2000;
    EXPECT_NEAR(std::remainder(at_index_rad - 0.02, turn_rad), 0.0, 1e-12);
    EXPECT_NEAR(actuator(i).measured_position_rad, 0.4, turn_rad / 2);
    EXPECT_EQ(health(i).reference_source, ReferenceSource::kIndex);
  }
}

TEST_F(BridgeHomingByIndex, FailsWhereNoIndexWasSeen) {
  bench_->drives[1].objects[{0x2021, 0}] = 0;
  const OperatorReply reply = home();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kFailed);
  EXPECT_THAT(reply.reason, HasSubstr("has seen no index pulse"));
  bench_->tick();
  EXPECT_FALSE(actuator(0).referenced) << "all or none";
}

TEST_F(BridgeHomingByIndex, FailsWhereTheDriveRefusesToTell) {
  bench_->drives[0].aborts[{0x2021, 0}] = canopen::kAbortNoObject;
  EXPECT_EQ(home().outcome, OperatorOutcome::kFailed);
  EXPECT_EQ(health(0).sdo_failures, 1);
}

TEST_F(BridgeHoming, IncrementalEncoderLosesItsReferenceWhenItsDriveRestarts) {
  for (const bool absolute : {true, false}) {
    RobotConfig robot = unreferenced_robot(ReferenceMethod::kJig);
    robot.actuators[0].reference.absolute_encoder = absolute;
    boot(robot);
    ASSERT_EQ(home().outcome, OperatorOutcome::kDone);
    // Both joints agree with their link encoders, so that nothing else takes the reference away.
    bench_->drives[0].restart_now = true;
    bench_->run(2);
    EXPECT_EQ(actuator(0).referenced, absolute);
  }
}

TEST_F(BridgeHoming, RestoredReferenceIsInForceFromTheFirstCycle) {
  bench_ = std::make_unique<test::BridgeBench>(unreferenced_robot(ReferenceMethod::kJig));
  bench_->bridge->restore_reference(0, {0.1, true, ReferenceSource::kJig});
  ASSERT_TRUE(bench_->boot());
  EXPECT_TRUE(actuator(0).referenced);
  EXPECT_EQ(actuator(0).measured_position_rad, 0.1);
  EXPECT_FALSE(actuator(1).referenced);
}

}  // namespace
}  // namespace sprung
