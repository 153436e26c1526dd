#include <gtest/gtest.h>

#include <string>

#include "signals/messages.h"
#include "tests/signals/message_bytes.h"

namespace sprung {
namespace {

using test::encoded;
using test::random_message;

template <class Signal>
void expect_round_trip() {
  for (unsigned seed = 0; seed < 20; ++seed) {
    const auto message = random_message(MessageOf<Signal>{}, 0, seed);
    Signal signal;
    ASSERT_TRUE(from_message(message, signal));
    MessageOf<Signal> back{};
    to_message(signal, message.session, back);
    EXPECT_EQ(encoded(back), encoded(message)) << "seed " << seed;
  }
}

TEST(EventMessages, OperatorCommandSurvivesBitForBit) { expect_round_trip<OperatorCommand>(); }

TEST(EventMessages, SimControlSurvivesBitForBit) { expect_round_trip<SimControl>(); }

TEST(EventMessages, TorqueSensorSurvivesBitForBit) { expect_round_trip<TorqueSensor>(); }

TEST(EventMessages, MotionStateKeepsItsNumbersAndTexts) {
  MotionState signal(2);
  signal.stamp = {10, 20};
  signal.legs[1] = {LegPhase::kFlight, 0.25};
  signal.state = MotionPhase::kThrust;
  signal.jumps_done = 3;
  signal.jumps_left = 4;
  signal.jump_height_scale = 0.75;
  signal.jump_mode = JumpMode::kTorque;
  signal.last_transition = "crouch ended";
  sprung_msgs::motion_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.state_name, name(MotionPhase::kThrust));
  MotionState back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_STREQ(back.last_transition, "crouch ended");
  sprung_msgs::motion_state_t again{};
  to_message(back, 5, again);
  EXPECT_EQ(encoded(again), encoded(message));
  EXPECT_EQ(back.legs[1].phase_time_s, 0.25);
  EXPECT_EQ(back.jumps_left, 4);
}

TEST(EventMessages, SafetyStateKeepsItsNumbersAndTexts) {
  SafetyState signal;
  signal.stamp = {10, 20};
  signal.level = SafetyLevel::kQuickStop;
  signal.cause = SafetyCause::kBusLost;
  signal.latched = true;
  signal.actuator = 1;
  signal.since_seq = 19;
  signal.commands_refused = 2;
  signal.overruns = 3;
  signal.missed_cycles = 4;
  std::snprintf(signal.detail.data(), signal.detail.size(), "bus leg is off");
  sprung_msgs::safety_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.level_name, name(SafetyLevel::kQuickStop));
  EXPECT_EQ(message.cause_name, name(SafetyCause::kBusLost));
  SafetyState back;
  ASSERT_TRUE(from_message(message, back));
  sprung_msgs::safety_state_t again{};
  to_message(back, 5, again);
  EXPECT_EQ(encoded(again), encoded(message));
  EXPECT_EQ(back.missed_cycles, 4);
  EXPECT_STREQ(back.detail.data(), "bus leg is off");
}

TEST(EventMessages, DetailWithoutATerminatorIsCutAtItsEnd) {
  SafetyState signal;
  signal.detail.fill('x');
  sprung_msgs::safety_state_t message{};
  to_message(signal, 5, message);
  EXPECT_EQ(message.detail, std::string(signal.detail.size(), 'x'));
  SafetyState back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(std::string(back.detail.data()), std::string(signal.detail.size() - 1, 'x'));
}

TEST(EventMessages, OperatorReplyKeepsItsNumbersAndTexts) {
  OperatorReply signal;
  signal.stamp = {10, 20};
  signal.request_id = 42;
  signal.took_effect_at_seq = 21;
  signal.outcome = OperatorOutcome::kQueued;
  signal.from = "planner";
  signal.reason = "no contact";
  sprung_msgs::operator_reply_t message{};
  to_message(signal, 5, message);
  OperatorReply back;
  ASSERT_TRUE(from_message(message, back));
  EXPECT_EQ(back.stamp.seq, 20);
  EXPECT_EQ(back.request_id, 42);
  EXPECT_EQ(back.took_effect_at_seq, 21);
  EXPECT_EQ(back.outcome, OperatorOutcome::kQueued);
  EXPECT_STREQ(back.from, "planner");
  EXPECT_STREQ(back.reason, "no contact");
}

TEST(EventMessages, UnknownOperatorKindIsRefused) {
  sprung_msgs::operator_command_t message{};
  message.kind = 100;
  OperatorCommand signal;
  EXPECT_FALSE(from_message(message, signal));
}

}  // namespace
}  // namespace sprung
