// Encoder cards: link-side positions, what their sample counter shows, and what a silent or lying one does.
#include <gmock/gmock.h>

#include <cmath>
#include <stdexcept>

#include "signals/angles.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

using ::testing::HasSubstr;

class BridgeEncoderCard : public ::testing::Test {
 protected:
  BridgeEncoderCard() : bench_(test::robot_with_card()) {}
  void SetUp() override {
    // Motor encoders at 0 with offset 0.1: the link encoders say the same.
    ASSERT_TRUE(bench_.boot()) << bench_.bridge->boot_detail();
    bench_.enable();
    ASSERT_EQ(bench_.state.safety, SafetyLevel::kOperational) << bench_.detail();
  }
  test::FakeCard& card() { return bench_.cards[0]; }
  NodeHealth health() const { return bench_.bridge->bus_state().nodes[2]; }
  double link_rad(std::size_t actuator) const {
    return bench_.state.actuators[actuator].measured_link_position_rad;
  }
  const SafetyState& safety() const { return bench_.bridge->safety(); }

  test::BridgeBench bench_;
};

TEST_F(BridgeEncoderCard, IsBootedAndShownAfterTheDrives) {
  EXPECT_TRUE(health().operational);
  EXPECT_EQ(health().actuator, -1);
  EXPECT_EQ(health().node, 9);
  for (const CanFrame& frame : card().received) {
    if (frame.id == canopen::kNmtId) continue;
    EXPECT_NE(canopen::decode_sdo_request(frame).object.index, canopen::kControlWord)
        << "a card has no power";
  }
}

TEST_F(BridgeEncoderCard, ChannelThatTheCardHasNotIsRefusedAtStart) {
  RobotConfig robot = test::robot_with_card();
  for (const int channel : {3, -1}) {
    robot.actuators[1].link_encoder.channel = channel;
    try {
      const BridgeCore bridge(robot, {});
      FAIL() << "accepted channel " << channel;
    } catch (const std::invalid_argument& error) {
      EXPECT_EQ(error.what(), "actuator 'knee_motor': encoder card 'leg_card' has no channel " +
                                  std::to_string(channel) + "; it has 3, counted from 0");
    }
  }
  robot.actuators[1].link_encoder.channel = 2;
  EXPECT_NO_THROW(BridgeCore(robot, {}));
}

TEST_F(BridgeEncoderCard, NoDriveIsStartedBeforeTheCardIsConfigured) {
  test::BridgeBench bench(test::robot_with_card());
  bench.cards[0].dead = true;
  bench.run(1500);
  EXPECT_EQ(bench.drives[0].nmt, canopen::NmtState::kPreOperational);
  EXPECT_THAT(bench.bridge->boot_detail(), HasSubstr("leg_card: node 9 does not answer"));
}

TEST_F(BridgeEncoderCard, PositionsHaveTheLinkEncodersOwnDirectionAndOffset) {
  EXPECT_NEAR(link_rad(0), 0.1, 1e-12);
  bench_.command_all(DriveMode::kDisabled);
  bench_.run(5);
  card().sample.counts[0] = 1048576 / 8;
  card().sample.counts[1] = 1048576 / 8;
  bench_.tick();
  EXPECT_NEAR(link_rad(0), 0.1 - kPi / 4, 1e-12);
  EXPECT_NEAR(link_rad(1), 0.1 + kPi / 4, 1e-12);
  card().sample.counts[1] = 1048575;
  bench_.tick();
  EXPECT_NEAR(link_rad(1), 0.1 - 2 * kPi / 1048576, 1e-12) << "just before the zero of its turn";
}

TEST_F(BridgeEncoderCard, MissingSampleIsNoPosition) {
  card().mute_samples = true;
  bench_.tick();
  EXPECT_TRUE(std::isnan(link_rad(0)));
  EXPECT_EQ(health().missing_samples, 1);
  card().mute_samples = false;
  bench_.tick();
  EXPECT_NEAR(link_rad(0), 0.1, 1e-12);
  EXPECT_EQ(bench_.state.safety, SafetyLevel::kOperational);
  EXPECT_EQ(health().missing_samples, 1);
}

TEST_F(BridgeEncoderCard, SamplesThatTheCardSkippedAreCounted) {
  card().skip = 3;
  bench_.tick();
  EXPECT_EQ(health().missing_samples, 3);
  EXPECT_NEAR(link_rad(0), 0.1, 1e-12) << "this one is good";
  EXPECT_EQ(bench_.state.safety, SafetyLevel::kOperational);
}

TEST_F(BridgeEncoderCard, CardThatRepeatsItselfIsSilentAfterThreeCycles) {
  card().stuck = true;
  bench_.run(2);
  EXPECT_TRUE(std::isnan(link_rad(0)));
  EXPECT_EQ(bench_.state.safety, SafetyLevel::kOperational);
  bench_.tick();
  EXPECT_EQ(safety().level, SafetyLevel::kDamping);
  EXPECT_EQ(safety().cause, SafetyCause::kDriveSilent);
  EXPECT_EQ(safety().actuator, -1);
  EXPECT_THAT(bench_.detail(), HasSubstr("leg_card: did not answer SYNC for 3 cycles"));
  EXPECT_EQ(health().missing_samples, 3);
}

TEST_F(BridgeEncoderCard, SilentCardStopsTheRobotAndClearBringsItBack) {
  card().dead = true;
  bench_.run(3);
  EXPECT_EQ(safety().level, SafetyLevel::kDamping);
  bench_.run(900);
  EXPECT_EQ(safety().level, SafetyLevel::kQuickStop);
  card().dead = false;
  card().restart_now = true;  // it was its supply
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  const NodeHealth after = health();
  EXPECT_THAT(after.recovery.data(), HasSubstr("restarted: reset communication, configured again"));
  bench_.enable();
  EXPECT_EQ(bench_.state.safety, SafetyLevel::kOperational);
}

TEST_F(BridgeEncoderCard, EmergencyOfACardStopsTheRobotAndNeedsItsReset) {
  card().pending_emergency = 0x7320;
  bench_.tick();
  EXPECT_EQ(safety().cause, SafetyCause::kDriveFault);
  EXPECT_THAT(bench_.detail(), HasSubstr("leg_card: fault 0x7320 ("));
  bench_.run(900);
  const int resets = card().resets;
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(card().resets, resets + 1);
}

TEST_F(BridgeEncoderCard, EmergencyStandsUntilTheErrorRegisterIsEmpty) {
  for (const std::uint16_t code : std::initializer_list<std::uint16_t>{0x5000, 0x7320, 0x0000})
    bench_.bridge->receive(0, canopen::emergency_frame(9, {code, 0x21}), bench_.time_us);
  bench_.run(900);
  EXPECT_EQ(safety().cause, SafetyCause::kDriveFault);
  const int resets = card().resets;
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  EXPECT_EQ(card().resets, resets + 1) << "one of two faults was gone, the other stood";
}

TEST_F(BridgeEncoderCard, PositionsAWholeTurnApartAreTheSame) {
  RobotConfig robot = test::robot_with_card();
  robot.actuators[0].offset_rad += 2 * kPi;
  test::BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.run(20);
  EXPECT_EQ(bench.state.safety, SafetyLevel::kOperational) << bench.detail();
  EXPECT_TRUE(bench.state.actuators[0].referenced);
}

TEST_F(BridgeEncoderCard, EncodersThatDisagreeLoseTheReference) {
  card().sample.counts[0] = 1048576 - 20000;  // 0.12 rad: a motor turn at 50:1
  bench_.run(9);
  EXPECT_EQ(bench_.state.safety, SafetyLevel::kOperational);
  bench_.tick();
  EXPECT_EQ(safety().level, SafetyLevel::kDamping);
  EXPECT_EQ(safety().cause, SafetyCause::kImplausible);
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor: motor encoder says 0.1 rad, link encoder 0.2"));
  EXPECT_FALSE(bench_.state.actuators[0].referenced);
  EXPECT_TRUE(std::isnan(bench_.bridge->bus_state().nodes[0].reference_offset_rad));
  bench_.run(900);
  EXPECT_EQ(bench_.ask_and_wait(OperatorKind::kClear).outcome, OperatorOutcome::kDone);
  bench_.enable();
  EXPECT_NE(bench_.drives[0].power, PowerState::kOperationEnabled) << "it is not referenced any more";
  EXPECT_THAT(bench_.detail(), HasSubstr("hip_motor is not referenced and gets no torque: sprung home"));
}

TEST_F(BridgeEncoderCard, ShortDisagreementIsNoTrouble) {
  for (int i = 0; i < 20; ++i) {
    card().sample.counts[0] = i % 8 == 7 ? 0 : 20000;
    bench_.tick();
    ASSERT_EQ(bench_.state.safety, SafetyLevel::kOperational);
  }
}

}  // namespace
}  // namespace sprung
