#include "tools/logs/replay/log_cycles.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <random>

#include "lcmtypes/channels.h"
#include "runtime/process_status.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/operator.h"
#include "signals/safety_state.h"
#include "tests/tools/logs/replay/logged_message.h"

namespace sprung {
namespace {

using test::event_of;
using test::message_of;

class LogCyclesTest : public testing::Test {
 protected:
  template <class Signal>
  void add(const char* channel, const Signal& signal) {
    const Bytes bytes = message_of(signal, session_);
    ++time_us_;
    cycles_.add(event_of(channel, bytes, time_us_), 1e-6 * static_cast<double>(time_us_));
  }
  template <class Signal>
  void add_cycle(const char* channel, std::int64_t seq) {
    Signal signal;
    signal.stamp.seq = seq;
    add(channel, signal);
  }
  void drive_state(std::int64_t seq) { add_cycle<DriveState>(channels::kDriveState, seq); }
  void leg_command(std::int64_t seq) { add_cycle<LegCommand>(channels::kLegCommand, seq); }
  void joint_state(std::int64_t seq) { add_cycle<JointState>(channels::kJointState, seq); }
  void command(std::int64_t id, std::int64_t apply_at_seq = -1, OperatorKind kind = OperatorKind::kStand) {
    OperatorCommand command;
    command.request_id = id;
    command.apply_at_seq = apply_at_seq;
    command.kind = kind;
    add(channels::kOperatorCommand, command);
  }
  static OperatorReply a_reply(std::int64_t id, std::int64_t seq) {
    OperatorReply reply;
    reply.stamp.seq = seq;
    reply.request_id = id;
    reply.outcome = OperatorOutcome::kAccepted;
    reply.answered_by = "sprung-motion-planner";
    return reply;
  }
  void reply(std::int64_t id, std::int64_t seq, const char* from = "sprung-motion-planner",
             OperatorOutcome outcome = OperatorOutcome::kAccepted) {
    OperatorReply reply = a_reply(id, seq);
    reply.outcome = outcome;
    reply.answered_by = from;
    add(channels::kOperatorReply, reply);
  }
  void safety(std::int64_t seq, std::int64_t missed_cycles) {
    SafetyState safety;
    safety.stamp.seq = seq;
    safety.missed_cycles = missed_cycles;
    add(channels::kSafetyState, safety);
  }
  void status(const char* process, std::int64_t pid, const char* detail = "") {
    ProcessStatus status;
    status.detail = detail;
    status.process = process;
    status.pid = pid;
    add(channels::kProcessStatus, status);
  }
  const LoggedCycle& at(std::int64_t seq) const {
    const auto found = std::find_if(seen_.begin(), seen_.end(),
                                    [&](const LoggedCycle& cycle) { return cycle.seq == seq; });
    static const LoggedCycle none;
    return found == seen_.end() ? none : *found;
  }
  std::vector<std::int64_t> seqs() const {
    std::vector<std::int64_t> out;
    for (const LoggedCycle& cycle : seen_) out.push_back(cycle.seq);
    return out;
  }

  std::vector<LoggedCycle> seen_;
  LogCycles cycles_{[this](const LoggedCycle& cycle) { seen_.push_back(cycle); }};
  std::int64_t time_us_ = 0;
  std::int64_t session_ = 1;
};

TEST_F(LogCyclesTest, MessagesOfOneCycleComeTogether) {
  drive_state(0);
  drive_state(1);
  leg_command(0);
  joint_state(1);
  cycles_.finish();
  ASSERT_EQ(seqs(), (std::vector<std::int64_t>{0, 1}));
  EXPECT_FALSE(seen_[0].drive_state.empty());
  EXPECT_FALSE(seen_[0].leg_command.empty());
  EXPECT_TRUE(seen_[0].joint_state.empty());
  EXPECT_FALSE(seen_[1].joint_state.empty());
  EXPECT_EQ(seen_[0].time_us, 1);
  EXPECT_DOUBLE_EQ(seen_[1].time_s, 2e-6);
}

TEST_F(LogCyclesTest, CyclesComeInOrderHoweverTheLogIsMixed) {
  std::mt19937 random(5);
  std::vector<std::int64_t> order;
  for (std::int64_t k = 0; k < 3000; ++k) order.push_back(k);
  for (std::size_t i = 0; i + 50 < order.size(); i += 50)
    std::shuffle(order.begin() + static_cast<std::ptrdiff_t>(i),
                 order.begin() + static_cast<std::ptrdiff_t>(i + 50), random);
  for (const std::int64_t k : order) drive_state(k);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 3000u);
  for (std::int64_t k = 0; k < 3000; ++k) ASSERT_EQ(seen_[k].seq, k);
  EXPECT_EQ(cycles_.flaws().late, 0);
}

TEST_F(LogCyclesTest, CyclesInWhichTheBridgeHadNoAnswerAreMarked) {
  safety(-1, 0);
  for (std::int64_t k = 0; k < 8; ++k) {
    drive_state(k);
    if (k == 0 || k == 1) safety(k, 1);
    if (k == 5) safety(k, 3);
  }
  safety(600, 9);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 8u) << "of a cycle that has nothing else none is made";
  for (std::int64_t k = 0; k < 8; ++k) EXPECT_EQ(seen_[k].alone, k == 0 || k == 5) << k;
  EXPECT_EQ(cycles_.flaws().late, 0);
}

TEST_F(LogCyclesTest, WhatProcessesSayOfARunThatIsNotDeterministicIsKept) {
  drive_state(0);
  status("sprung-sim-drives", 5, "no SYNC: this run is not deterministic");
  status("sprung-sim-drives", 5, "no SYNC: this run is not deterministic");
  status("sprung-can-bridge", 6, "refused: wrong hash");
  EXPECT_EQ(cycles_.flaws().said, std::vector<std::string>{"sprung-sim-drives: no SYNC"});
}

TEST_F(LogCyclesTest, FirstOfRepeatedMessagesCounts) {
  DriveState first, second;
  first.stamp = {1000, 0};
  second.stamp = {2000, 0};
  add(channels::kDriveState, first);
  add(channels::kDriveState, second);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 1u);
  EXPECT_EQ(seen_[0].drive_state, message_of(first));
}

// A leg controller or an estimator that stood still for a second, while the bridge went on.
TEST_F(LogCyclesTest, OldMessagesOfOneThatStalledAreLateAndNoNewBeginning) {
  for (std::int64_t k = 0; k < 1000; ++k) drive_state(k);
  for (std::int64_t k = 400; k < 700; ++k) joint_state(k);
  for (std::int64_t k = 1000; k < 1100; ++k) drive_state(k);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 1100U);
  EXPECT_EQ(std::count_if(seen_.begin(), seen_.end(), [](const LoggedCycle& one) { return one.anew; }), 0);
  EXPECT_EQ(cycles_.flaws().late, 300);
}

TEST_F(LogCyclesTest, BridgeThatCountsFromZeroAgainIsANewBeginning) {
  for (std::int64_t k = 0; k < 1000; ++k) drive_state(k);
  for (std::int64_t k = 0; k < 10; ++k) {
    drive_state(k);
    joint_state(k);
  }
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 1010U);
  EXPECT_TRUE(seen_[1000].anew);
  EXPECT_FALSE(seen_[1009].joint_state.empty());
  EXPECT_EQ(cycles_.flaws().late, 0);
}

TEST_F(LogCyclesTest, MessageThatIsFarTooLateIsCountedAndLeftOut) {
  for (std::int64_t k = 0; k < 300; ++k) drive_state(k);
  leg_command(43);  // handed out, but not so long ago that the bridge began anew
  cycles_.finish();
  EXPECT_EQ(cycles_.flaws().late, 1);
  EXPECT_TRUE(at(43).leg_command.empty());
  EXPECT_EQ(seen_.size(), 300u);
}

TEST_F(LogCyclesTest, MissingCyclesAreLeftOut) {
  drive_state(0);
  drive_state(5);
  drive_state(100'000);
  cycles_.finish();
  EXPECT_EQ(seqs(), (std::vector<std::int64_t>{0, 5, 100'000}));
}

TEST_F(LogCyclesTest, MessagesBeforeTheFirstCycleBelongToNone) {
  drive_state(-1);
  cycles_.finish();
  EXPECT_TRUE(seen_.empty());
}

TEST_F(LogCyclesTest, ForeignBytesAreCounted) {
  const Bytes bytes{1, 2, 3};
  cycles_.add(event_of(channels::kDriveState, bytes), 0.0);
  EXPECT_EQ(cycles_.flaws().foreign, 1);
}

TEST_F(LogCyclesTest, CycleThatCannotBeIsDamageAndEndsNothing) {
  drive_state(0);
  drive_state(std::numeric_limits<std::int64_t>::max());
  drive_state(1);
  cycles_.finish();
  EXPECT_EQ(seqs(), (std::vector<std::int64_t>{0, 1}));
  EXPECT_EQ(cycles_.flaws().foreign, 1);
}

TEST_F(LogCyclesTest, BridgeThatCountsFromZeroAgainBeginsAnew) {
  for (std::int64_t k = 0; k < 400; ++k) drive_state(k);
  for (std::int64_t k = 0; k < 3; ++k) drive_state(k);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 403u);
  EXPECT_FALSE(seen_[0].anew);
  EXPECT_TRUE(seen_[400].anew);
  EXPECT_EQ(seen_[400].seq, 0);
  EXPECT_FALSE(seen_[401].anew);
}

TEST_F(LogCyclesTest, AnotherSessionBeginsAnewAndItsCommandsAreItsOwn) {
  command(7);
  drive_state(0);
  leg_command(0);
  reply(7, 0);
  session_ = 2;
  command(7);
  drive_state(0);
  leg_command(0);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 2u);
  EXPECT_FALSE(seen_[0].anew);
  EXPECT_TRUE(seen_[1].anew);
  EXPECT_EQ(seen_[0].operator_commands.size(), 1u);
  EXPECT_EQ(seen_[1].operator_commands.size(), 1u);
}

/// As when a recorder's own status comes between the messages of a log that is played.
TEST_F(LogCyclesTest, StatusOfAnotherSessionBetweenCyclesChangesNothing) {
  status("sprung-motion-planner", 5);
  drive_state(0);
  session_ = 2;
  status("sprung-recorder", 9);
  status("sprung-motion-planner", 6);
  command(7);
  session_ = 1;
  drive_state(1);
  leg_command(1);
  cycles_.finish();
  ASSERT_EQ(seen_.size(), 2u);
  EXPECT_FALSE(seen_[1].anew);
  EXPECT_FALSE(seen_[1].restarted[static_cast<std::size_t>(Core::kPlanner)]);
  EXPECT_TRUE(seen_[1].operator_commands.empty());
}

TEST_F(LogCyclesTest, RecordingMayBeginInTheMiddle) {
  drive_state(5000);
  joint_state(4999);
  cycles_.finish();
  EXPECT_EQ(seqs(), (std::vector<std::int64_t>{4999, 5000}));
}

TEST_F(LogCyclesTest, ProcessThatWasStartedAgainIsFreshFromItsNextMessageOn) {
  status("sprung-torque-estimator", 10);
  drive_state(0);
  joint_state(0);
  status("sprung-torque-estimator", 11);
  status("sprung-can-bridge", 12);
  drive_state(1);
  drive_state(2);
  joint_state(2);
  cycles_.finish();
  const auto estimator = static_cast<std::size_t>(Core::kEstimator);
  EXPECT_FALSE(at(0).restarted[estimator]);
  EXPECT_FALSE(at(1).restarted[estimator]);
  EXPECT_TRUE(at(2).restarted[estimator]);
  EXPECT_FALSE(at(2).restarted[static_cast<std::size_t>(Core::kPlanner)]);
}

TEST_F(LogCyclesTest, ReplyOfALogOfBeforeCountsAsOneOfToday) {
  leg_command(0);
  command(7);
  for (std::int64_t k = 1; k < 6; ++k) leg_command(k);
  const Bytes today = message_of(a_reply(7, 3), session_);
  Bytes before = today;
  constexpr std::uint64_t kFormerHash = 0x3e25ef2266fe2692;  // of the field `from`, by lcm-gen
  for (std::size_t i = 0; i < 8; ++i) before[i] = static_cast<std::uint8_t>(kFormerHash >> (56 - 8 * i));
  ++time_us_;
  cycles_.add(event_of(channels::kOperatorReply, before, time_us_), 1e-6 * static_cast<double>(time_us_));
  cycles_.finish();
  EXPECT_EQ(at(3).operator_commands.size(), 1u);
  ASSERT_EQ(at(3).replies.size(), 1u);
  EXPECT_EQ(at(3).replies[0], today) << "compared with what a planner of today answers";
}

TEST_F(LogCyclesTest, CommandComesInTheCycleThatItsAnswerNames) {
  leg_command(0);
  command(7);
  for (std::int64_t k = 1; k < 6; ++k) leg_command(k);
  reply(7, 3);
  cycles_.finish();
  EXPECT_TRUE(at(1).operator_commands.empty());
  EXPECT_EQ(at(3).operator_commands.size(), 1u);
  EXPECT_EQ(at(3).replies.size(), 1u);
  EXPECT_TRUE(at(4).operator_commands.empty());
  EXPECT_EQ(cycles_.flaws().unanswered, 0);
}

TEST_F(LogCyclesTest, CommandWithoutAnAnswerComesWhereItStands) {
  leg_command(0);
  leg_command(1);
  command(7);
  leg_command(2);
  cycles_.finish();
  EXPECT_EQ(at(2).operator_commands.size(), 1u);
  EXPECT_EQ(cycles_.flaws().unanswered, 1);
}

/// The planner itself makes it wait: no flaw of the log.
TEST_F(LogCyclesTest, CommandForALaterCycleComesWhereItStands) {
  command(7, 5000);
  reply(7, -1, "planner", OperatorOutcome::kQueued);
  leg_command(0);
  leg_command(1);
  cycles_.finish();
  EXPECT_EQ(at(0).operator_commands.size(), 1u);
  EXPECT_EQ(cycles_.flaws().unanswered, 0);
}

TEST_F(LogCyclesTest, RepeatedCommandAndRepeatedAnswerCountOnce) {
  leg_command(0);
  command(7);
  command(7);
  leg_command(1);
  reply(7, 1);
  reply(7, 1);
  command(7);
  leg_command(2);
  cycles_.finish();
  EXPECT_EQ(at(1).operator_commands.size(), 1u);
  EXPECT_EQ(at(1).replies.size(), 1u);
  EXPECT_TRUE(at(2).operator_commands.empty());
}

TEST_F(LogCyclesTest, CommandsOfTheBridgeAreNotThePlanners) {
  leg_command(0);
  command(1, -1, OperatorKind::kEstop);
  command(2, -1, OperatorKind::kClear);
  command(3, -1, OperatorKind::kHome);
  leg_command(1);
  reply(1, 1, "sprung-can-bridge");
  cycles_.finish();
  EXPECT_TRUE(at(1).operator_commands.empty());
  EXPECT_TRUE(at(1).replies.empty());
}

TEST_F(LogCyclesTest, CommandsOfOneCycleKeepTheirOrder) {
  leg_command(0);
  command(8);
  command(7);
  leg_command(1);
  reply(8, 1);
  reply(7, 1);
  cycles_.finish();
  ASSERT_EQ(at(1).operator_commands.size(), 2u);
  OperatorCommand first;
  first.request_id = 8;
  first.apply_at_seq = -1;
  first.kind = OperatorKind::kStand;
  EXPECT_EQ(at(1).operator_commands[0], message_of(first));
}

TEST(LogCyclesUse, MayKeepACycleAndLeaveAnother) {
  std::vector<LoggedCycle> kept;
  LogCycles cycles([&](LoggedCycle& cycle) {
    LoggedCycle other;
    other.replies.push_back({1, 2, 3});
    other.imu = {4};
    std::swap(cycle, other);
    kept.push_back(std::move(other));
  });
  DriveState state;
  for (state.stamp.seq = 0; state.stamp.seq < 600; ++state.stamp.seq) {
    const Bytes bytes = message_of(state);
    cycles.add(event_of(channels::kDriveState, bytes), 0.0);
  }
  cycles.finish();
  ASSERT_EQ(kept.size(), 600u);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    EXPECT_EQ(kept[k].seq, static_cast<std::int64_t>(k));
    EXPECT_TRUE(kept[k].imu.empty());
    EXPECT_TRUE(kept[k].replies.empty());
  }
}

TEST(LogCyclesUses, WhatCoresTakeAndMake) {
  for (const char* channel : {"DRIVE_STATE", "IMU", "JOINT_STATE", "LEG_COMMAND", "MOTION_STATE",
                              "DRIVE_COMMAND", "OPERATOR_COMMAND", "OPERATOR_REPLY", "PROCESS_STATUS"})
    EXPECT_TRUE(LogCycles::uses(channel)) << channel;
  for (const char* channel : {"CAN_TRACE", "SIM_TRUTH", "LOG_METADATA"})
    EXPECT_FALSE(LogCycles::uses(channel)) << channel;
}

}  // namespace
}  // namespace sprung
