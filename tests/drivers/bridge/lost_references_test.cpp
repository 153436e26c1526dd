// Positions that jump, and references that are lost or kept.
#include <gmock/gmock.h>

#include "drivers/canopen/objects.h"
#include "tests/drivers/bridge/faults_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;
using namespace canopen;

TEST_F(BridgeFaults, FlippedPositionIsKeptOutOfTheStateAndOfTheDamping) {
  bench_.drives[0].position_counts = 5000;
  bench_.run(200);
  const double before_rad = bench_.state.actuators[0].measured_position_rad;
  bend_samples([](std::vector<CanFrame>& frames, std::size_t i) { frames[i].data[2] ^= 0x80; });
  bench_.tick();
  EXPECT_EQ(bench_.state.actuators[0].measured_position_rad, before_rad);
  EXPECT_EQ(health(0).implausible_samples, 1);
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0);
  bench_.on_answers = nullptr;
  expect_damping(SafetyCause::kImplausible, "hip_motor: measured position jumped");
  expect_cleared();
}

TEST_F(BridgeFaults, EncoderThatHasJumpedLosesTheReferenceAlsoAnAbsoluteOne) {
  bench_.drives[0].position_counts += 500'000;
  bench_.run(900);
  EXPECT_EQ(cause(), SafetyCause::kImplausible);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_STREQ(health(0).recovery.data(), "nothing to do; reference lost: encoder jumped");
  EXPECT_STREQ(health(1).recovery.data(), "nothing to do");
  bench_.enable();
  EXPECT_FALSE(bench_.state.actuators[0].referenced);
  EXPECT_NE(bench_.drives[0].power, PowerState::kOperationEnabled);
  EXPECT_EQ(bench_.drives[1].power, PowerState::kOperationEnabled);
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor is not referenced"));
}

TEST_F(BridgeFaults, EncoderThatHasJumpedWhileItsDriveWasConfiguredLosesTheReferenceToo) {
  bench_.bridge->receive(0, canopen::emergency_frame(1, {0x8120, 0x11}), bench_.time_us);
  bench_.run(900);
  ASSERT_EQ(bench_.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench_.run(60);
  bench_.drives[0].position_counts += 500'000'000;  // 240 rad: more than it can turn in a second
  OperatorReply reply;
  for (int i = 0; i < 7000 && !bench_.bridge->next_reply(reply); ++i) bench_.tick();
  EXPECT_FALSE(bench_.state.actuators[0].referenced);
  EXPECT_TRUE(bench_.state.actuators[1].referenced);
}

/// A robot with incremental encoders, found by jig, whose hip `strike` hits while a clear configures it.
void expect_reference_lost_while_configured(void (*strike)(test::FakeDrive& hip)) {
  RobotConfig robot = test::two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) {
    actuator.referenced = false;
    actuator.reference = {ReferenceMethod::kJig, false, 1.0, 0.02};
  }
  test::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.run(50);
  OperatorCommand home;
  home.kind = OperatorKind::kHome;
  home.request_id = 991;
  home.actuator = -1;
  ASSERT_NE(bench.bridge->operator_command(home, bench.time_us).outcome, OperatorOutcome::kRefused);
  bench.run(20);
  OperatorReply reply;
  while (bench.bridge->next_reply(reply)) {
  }
  ASSERT_TRUE(bench.state.actuators[0].referenced);
  bench.bridge->receive(0, canopen::emergency_frame(1, {0x8120, 0x11}), bench.time_us);
  bench.run(900);
  ASSERT_EQ(bench.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench.run(5);
  strike(bench.drives[0]);
  for (int i = 0; i < 7000 && !bench.bridge->next_reply(reply); ++i) {
    bench.tick();
    if (i == 700) bench.drives[0].dead = false;
  }
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone);
  EXPECT_FALSE(bench.state.actuators[0].referenced);
  EXPECT_THAT(bench.bridge->bus_state().nodes[0].recovery.data(), HasSubstr("reference lost"));
}

TEST(BridgeReferences, IncrementalOneIsLostWhenTheDriveRestartsWhileItIsConfigured) {
  expect_reference_lost_while_configured([](test::FakeDrive& hip) { hip.restart_now = true; });
}

TEST(BridgeReferences, IncrementalOneIsLostWhenTheBootNeedsASecondTry) {
  expect_reference_lost_while_configured([](test::FakeDrive& hip) { hip.dead = true; });
}

/// Its drives know where they are, and not any more once they have begun anew.
RobotConfig incremental_robot() {
  RobotConfig robot = test::two_drive_robot();
  for (ActuatorConfig& actuator : robot.actuators) actuator.reference.absolute_encoder = false;
  return robot;
}

TEST(BridgeReferences, IncrementalOneIsLostWhenTheDriveWasSilent) {
  test::BridgeBench bench(incremental_robot());
  ASSERT_TRUE(bench.boot());
  bench.run(50);
  bench.drives[0].mute_samples = true;  // as without supply
  bench.run(900);
  ASSERT_EQ(bench.ask(OperatorKind::kClear).outcome, OperatorOutcome::kAccepted);
  bench.run(5);
  bench.drives[0].mute_samples = false;
  OperatorReply reply;
  for (int i = 0; i < 7000 && !bench.bridge->next_reply(reply); ++i) bench.tick();
  EXPECT_EQ(reply.outcome, OperatorOutcome::kDone) << reply.reason;
  EXPECT_FALSE(bench.state.actuators[0].referenced);
  EXPECT_TRUE(bench.state.actuators[1].referenced);
}

TEST(BridgeReferences, IncrementalOneIsKeptByAResetOfTheCommunication) {
  test::BridgeBench bench(incremental_robot());
  ASSERT_TRUE(bench.boot());
  bench.run(50);
  bench.bridge->receive(0, canopen::emergency_frame(1, {0x8120, 0x11}), bench.time_us);
  bench.run(900);
  EXPECT_EQ(bench.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(bench.drives[0].resets, 2);
  EXPECT_TRUE(bench.state.actuators[0].referenced);
}

}  // namespace
}  // namespace sprung
