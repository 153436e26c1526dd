#include "runtime/receive_guard.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/safety_state.h"
#include "signals/sensors.h"
#include "signals/simulation.h"
#include "tests/signals/message_bytes.h"
#include "tests/support/enumerators.h"

namespace sprung {
namespace {

using test::encoded;
using Bytes = std::vector<std::uint8_t>;

constexpr std::int64_t kReceiveGuardSession = 0x1122334455667788;

void write_int32(Bytes& bytes, std::size_t offset, std::int32_t value) {
  const auto bits = static_cast<std::uint32_t>(value);
  for (std::size_t i = 0; i < 4; ++i) bytes[offset + i] = static_cast<std::uint8_t>(bits >> (24U - 8U * i));
}

sprung_msgs::joint_state_t joint_state() {
  sprung_msgs::joint_state_t message{};
  message.session = kReceiveGuardSession;
  message.n_joints = 2;
  message.n_legs = 1;
  message.joints.resize(2);
  message.legs.resize(1);
  message.joints[1].estimated_position_rad = 0.5;
  return message;
}

sprung_msgs::operator_reply_t reply() {
  sprung_msgs::operator_reply_t message{};
  message.session = kReceiveGuardSession;
  message.answered_by = "planner";
  message.reason = "a reason";
  return message;
}

/// Refuses bytes, and nothing else happened: counted once, named, nothing accepted.
template <class M>
void expect_refused(Refusal why, const Bytes& bytes, const CountLimits& limits) {
  ReceiveGuard guard("CHANNEL", layout_of<M>(), limits, kReceiveGuardSession);
  M out{};
  EXPECT_EQ(guard.decode(bytes.data(), bytes.size(), out), why) << name(why);
  EXPECT_EQ(guard.refused(why), 1);
  EXPECT_EQ(guard.refused(), 1);
  EXPECT_EQ(guard.accepted(), 0);
  EXPECT_NE(guard.last_refusal().find(std::string("CHANNEL refused: ") + name(why)), std::string::npos);
}

void expect_joint_state_refused(Refusal why, const Bytes& bytes) {
  expect_refused<sprung_msgs::joint_state_t>(why, bytes, CountLimits::exactly(2, 1));
}

TEST(Refusals, EveryOneHasItsOwnName) { test::expect_own_names<Refusal>(); }

TEST(ReceiveGuard, AcceptsAGoodMessage) {
  ReceiveGuard guard("JOINT_STATE", layout_of<sprung_msgs::joint_state_t>(), CountLimits::exactly(2, 1),
                     kReceiveGuardSession);
  const Bytes bytes = encoded(joint_state());
  sprung_msgs::joint_state_t out{};
  EXPECT_EQ(guard.decode(bytes.data(), bytes.size(), out), Refusal::kNone);
  EXPECT_EQ(out.joints.at(1).estimated_position_rad, 0.5);
  EXPECT_EQ(guard.accepted(), 1);
  EXPECT_EQ(guard.refused(), 0);
  EXPECT_EQ(guard.last_refusal(), "");
}

TEST(ReceiveGuard, RefusesCountsThatAreNotThisRobots) {
  for (const std::size_t which : {0U, 1U}) {
    for (const std::int32_t count : {-1, 0, 3, 1 << 28, std::numeric_limits<std::int32_t>::min(),
                                     std::numeric_limits<std::int32_t>::max()}) {
      Bytes bytes = encoded(joint_state());
      write_int32(bytes, kCountsOffset + 4 * which, count);
      expect_joint_state_refused(Refusal::kBadCount, bytes);
    }
  }
}

TEST(ReceiveGuard, RefusesAnotherTypeOrVersion) {
  Bytes bytes = encoded(joint_state());
  bytes[7] ^= 1U;
  expect_joint_state_refused(Refusal::kWrongHash, bytes);
  expect_joint_state_refused(Refusal::kWrongHash, encoded(reply()));
}

TEST(ReceiveGuard, RefusesAnotherSession) {
  auto message = joint_state();
  message.session = kReceiveGuardSession + 1;
  expect_joint_state_refused(Refusal::kWrongSession, encoded(message));
}

TEST(ReceiveGuard, ToolWithoutASessionAcceptsEverySession) {
  ReceiveGuard guard("JOINT_STATE", layout_of<sprung_msgs::joint_state_t>(), CountLimits::exactly(2, 1), 0);
  const Bytes bytes = encoded(joint_state());
  EXPECT_EQ(guard.check(bytes.data(), bytes.size()), Refusal::kNone);
}

TEST(ReceiveGuard, RefusesEveryTruncation) {
  const Bytes whole = encoded(joint_state());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    expect_joint_state_refused(size < kCountsOffset + 8 ? Refusal::kTooShort : Refusal::kWrongLength, part);
  }
}

TEST(ReceiveGuard, RefusesTrailingBytes) {
  Bytes bytes = encoded(joint_state());
  bytes.push_back(0);
  expect_joint_state_refused(Refusal::kWrongLength, bytes);
}

TEST(ReceiveGuard, AcceptsCountsUpToAMaximumWithTheRightLength) {
  ReceiveGuard guard("CAN_TRACE", layout_of<sprung_msgs::can_trace_t>(), CountLimits::up_to(256),
                     kReceiveGuardSession);
  sprung_msgs::can_trace_t message{};
  message.session = kReceiveGuardSession;
  for (const int frames : {0, 1, 256, 257}) {
    message.n = frames;
    message.frames.resize(static_cast<std::size_t>(frames));
    const Bytes bytes = encoded(message);
    EXPECT_EQ(guard.check(bytes.data(), bytes.size()), frames <= 256 ? Refusal::kNone : Refusal::kBadCount)
        << frames;
  }
}

TEST(ReceiveGuard, RefusesStringLengthsThatWouldKillTheDecoder) {
  const std::size_t first = layout_of<sprung_msgs::operator_reply_t>().fixed_size;
  for (const std::int32_t length : {0, -1, std::numeric_limits<std::int32_t>::min(), 7, 9, 10'000,
                                    std::numeric_limits<std::int32_t>::max()}) {
    Bytes bytes = encoded(reply());
    write_int32(bytes, first, length);
    expect_refused<sprung_msgs::operator_reply_t>(Refusal::kWrongLength, bytes, CountLimits::none());
  }
}

TEST(ReceiveGuard, RefusesEveryTruncationOfAMessageWithStrings) {
  const Bytes whole = encoded(reply());
  for (std::size_t size = kCountsOffset; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    expect_refused<sprung_msgs::operator_reply_t>(Refusal::kWrongLength, part, CountLimits::none());
  }
}

TEST(ReceiveGuard, RefusesBytesAfterTheLastString) {
  Bytes bytes = encoded(reply());
  bytes.push_back(0);
  expect_refused<sprung_msgs::operator_reply_t>(Refusal::kWrongLength, bytes, CountLimits::none());
}

TEST(ReceiveGuard, CountsWhatIsRefusedLater) {
  ReceiveGuard guard("X", layout_of<sprung_msgs::joint_state_t>(), CountLimits::exactly(2, 1),
                     kReceiveGuardSession);
  guard.refuse(Refusal::kBadValue, 9, 3);
  EXPECT_EQ(guard.refused(Refusal::kBadValue), 1);
  EXPECT_EQ(guard.last_refusal(), "X refused: bad value, found 9, expected 0 to 3");
  guard.refuse(Refusal::kBadValue, 0, 0);
  EXPECT_EQ(guard.last_refusal(), "X refused: bad value, a number beyond its range");
}

/// 100 000 seeded buffers: random ones, and good ones with a few bytes changed or cut. Whatever is accepted
/// encodes to the very bytes that came in, so nothing was read past them and nothing was made up.
template <class M>
void expect_survives_rubbish(const M& good, const CountLimits& limits) {
  constexpr int kBuffers = 100'000;
  std::mt19937 random(20261121);
  ReceiveGuard guard("FUZZ", layout_of<M>(), limits, kReceiveGuardSession);
  const Bytes whole = encoded(good);
  M out{};
  int accepted = 0;
  for (int i = 0; i < kBuffers; ++i) {
    Bytes bytes = whole;
    if (i % 4 == 0) bytes.resize(random() % (whole.size() + 8));
    const std::size_t changes = i % 8 == 1 ? bytes.size() : 1 + random() % 4;
    for (std::size_t c = 0; c < changes && !bytes.empty(); ++c) {
      bytes[random() % bytes.size()] = static_cast<std::uint8_t>(random());
    }
    // Exact allocation, so that the address sanitizer sees a single byte too many.
    if (guard.decode(bytes.data(), bytes.size(), out) == Refusal::kNone) {
      ++accepted;
      ASSERT_EQ(encoded(out), bytes);
    }
  }
  EXPECT_EQ(guard.accepted(), accepted);
  EXPECT_EQ(guard.accepted() + guard.refused(), kBuffers);
  EXPECT_GT(guard.refused(), kBuffers / 10);
}

template <class M>
M of_this_session() {
  M message{};
  message.session = kReceiveGuardSession;
  return message;
}

TEST(ReceiveGuardFuzz, DriveState) {
  auto message = of_this_session<sprung_msgs::drive_state_t>();
  message.n = 2;
  message.actuators.resize(2);
  expect_survives_rubbish(message, CountLimits::exactly(2));
}

TEST(ReceiveGuardFuzz, DriveCommand) {
  auto message = of_this_session<sprung_msgs::drive_command_t>();
  message.n = 2;
  message.actuators.resize(2);
  expect_survives_rubbish(message, CountLimits::exactly(2));
}

TEST(ReceiveGuardFuzz, JointState) { expect_survives_rubbish(joint_state(), CountLimits::exactly(2, 1)); }

TEST(ReceiveGuardFuzz, LegCommand) {
  auto message = of_this_session<sprung_msgs::leg_command_t>();
  message.n_legs = 1;
  message.legs.resize(1);
  expect_survives_rubbish(message, CountLimits::exactly(1));
}

TEST(ReceiveGuardFuzz, MotionState) {
  auto message = of_this_session<sprung_msgs::motion_state_t>();
  message.n_legs = 1;
  message.legs.resize(1);
  message.state_name = "standing";
  expect_survives_rubbish(message, CountLimits::exactly(1));
}

TEST(ReceiveGuardFuzz, CanTrace) {
  auto message = of_this_session<sprung_msgs::can_trace_t>();
  message.n = 3;
  message.frames.resize(3);
  expect_survives_rubbish(message, CountLimits::up_to(256));
}

TEST(ReceiveGuardFuzz, OperatorCommand) {
  expect_survives_rubbish(of_this_session<sprung_msgs::operator_command_t>(), CountLimits::none());
}

TEST(ReceiveGuardFuzz, OperatorReply) { expect_survives_rubbish(reply(), CountLimits::none()); }

TEST(ReceiveGuardFuzz, SafetyState) {
  auto message = of_this_session<sprung_msgs::safety_state_t>();
  message.detail = "hip_motor: 0x7305";
  expect_survives_rubbish(message, CountLimits::none());
}

TEST(ReceiveGuardFuzz, ProcessStatus) {
  auto message = of_this_session<sprung_msgs::process_status_t>();
  message.process = "sprung-x";
  expect_survives_rubbish(message, CountLimits::none());
}

TEST(ReceiveGuardFuzz, SimControl) {
  expect_survives_rubbish(of_this_session<sprung_msgs::sim_control_t>(), CountLimits::none());
  expect_survives_rubbish(of_this_session<sprung_msgs::torque_sensor_t>(), CountLimits::none());
}

TEST(ReceiveGuardFuzz, Imu) {
  expect_survives_rubbish(of_this_session<sprung_msgs::imu_t>(), CountLimits::none());
}

TEST(ReceiveGuardFuzz, SimTruth) {
  auto message = of_this_session<sprung_msgs::sim_truth_t>();
  message.n_joints = 2;
  message.n_legs = 1;
  message.joints.resize(2);
  message.legs.resize(1);
  expect_survives_rubbish(message, CountLimits::exactly(2, 1));
}

}  // namespace
}  // namespace sprung
