#include "tools/logs/replay/lockstep_cycles.h"

#include <gtest/gtest.h>

#include "signals/drive_command.h"
#include "tests/tools/logs/replay/logged_message.h"

namespace sprung {
namespace {

/// Where a message of LockstepFlaws::kChannels is.
constexpr std::size_t kJoints = 0, kLegs = 1, kMotion = 2, kDrives = 3;

class LockstepCyclesTest : public testing::Test {
 protected:
  /// Whole, and made from its own inputs.
  static LoggedCycle cycle(std::int64_t seq) { return cycle(seq, seq, seq - 1); }
  static LoggedCycle cycle(std::int64_t seq, std::int64_t used_joint_state, std::int64_t used_leg_command) {
    DriveCommand command(2);
    command.stamp.seq = seq;
    command.used_joint_state_seq = used_joint_state;
    command.used_leg_command_seq = used_leg_command;
    LoggedCycle out;
    out.seq = seq;
    out.joint_state = out.leg_command = out.motion_state = Bytes{1};
    out.drive_command = message_of(command);
    return out;
  }
  static Bytes message_of(const DriveCommand& command) { return test::message_of(command); }
  void add(std::int64_t first, std::int64_t last) {
    for (std::int64_t seq = first; seq <= last; ++seq) cycles_.add(cycle(seq));
  }
  const LockstepFlaws& flaws() const { return cycles_.flaws(); }

  LockstepCycles cycles_;
};

TEST_F(LockstepCyclesTest, RunOfOwnInputsHasNoFlaws) {
  add(0, 50);
  EXPECT_TRUE(flaws().deterministic());
  EXPECT_TRUE(flaws().every_message());
}

/// The leg controller gave up waiting at 10, and the planner, when it went on, took the newest joint state.
TEST_F(LockstepCyclesTest, LegCommandsThatNobodyMadeAreNamedByTheCommandsThatDidWithout) {
  add(0, 9);
  for (std::int64_t seq = 10; seq <= 13; ++seq) {
    LoggedCycle one = cycle(seq, seq, 8);
    if (seq == 10 || seq == 11) one.leg_command = one.motion_state = {};
    if (seq == 10) one.drive_command = cycle(10).drive_command;  // LEG_COMMAND 9 came in time
    if (seq == 13) one.drive_command = cycle(13).drive_command;
    cycles_.add(one);
  }
  add(14, 20);
  EXPECT_FALSE(flaws().deterministic());
  EXPECT_FALSE(flaws().every_message());
  EXPECT_EQ(flaws().older.text(), "11 to 12");
  for (const std::size_t channel : {kLegs, kMotion}) {
    EXPECT_EQ(flaws().absent[channel].never_made.text(), "10 to 11") << channel;
    EXPECT_TRUE(flaws().absent[channel].not_in_log.empty()) << channel;
  }
  EXPECT_TRUE(flaws().absent[kJoints].never_made.empty());
}

TEST_F(LockstepCyclesTest, LegCommandThatWasUsedWasLostByTheLog) {
  add(0, 9);
  LoggedCycle lost = cycle(10);
  lost.leg_command.clear();
  cycles_.add(lost);
  add(11, 12);
  EXPECT_TRUE(flaws().deterministic());
  EXPECT_FALSE(flaws().every_message());
  EXPECT_EQ(flaws().absent[kLegs].not_in_log.text(), "10");
  EXPECT_TRUE(flaws().absent[kLegs].never_made.empty());
  EXPECT_TRUE(flaws().absent[kMotion].not_in_log.empty());
}

TEST_F(LockstepCyclesTest, MessageThatCameTooLateMakesARunNotDeterministicToo) {
  add(0, 9);
  cycles_.add(cycle(10, 10, 8));
  add(11, 12);
  EXPECT_FALSE(flaws().deterministic());
  EXPECT_TRUE(flaws().every_message());
  EXPECT_EQ(flaws().older.text(), "10");
}

TEST_F(LockstepCyclesTest, JointStateThatNobodyMadeIsNamedByTheCommandOfItsCycle) {
  add(0, 9);
  LoggedCycle without = cycle(10, 9, 9);
  without.joint_state.clear();
  cycles_.add(without);
  add(11, 12);
  EXPECT_EQ(flaws().absent[kJoints].never_made.text(), "10");
}

TEST_F(LockstepCyclesTest, OfADriveCommandThatIsNotThereNothingSaysWhetherItWas) {
  add(0, 9);
  add(13, 14);
  for (const std::size_t channel : {kJoints, kLegs, kMotion, kDrives})
    EXPECT_EQ(flaws().absent[channel].not_in_log.text(), "10 to 12") << channel;
  EXPECT_TRUE(flaws().deterministic());
  EXPECT_FALSE(flaws().every_message());
}

/// The drives were silent for 10 and 11: nothing else shows it. The leg controller was for 15.
TEST_F(LockstepCyclesTest, CyclesInWhichTheBridgeHadNoAnswerAreNamed) {
  for (std::int64_t seq = 0; seq <= 20; ++seq) {
    LoggedCycle one = cycle(seq);
    one.alone = seq == 10 || seq == 11 || seq == 15;
    if (seq == 15) one.drive_command.clear();
    cycles_.add(one);
  }
  EXPECT_FALSE(flaws().deterministic());
  EXPECT_EQ(flaws().without_answer.text(), "10 to 11, 15");
  EXPECT_EQ(flaws().absent[kDrives].never_made.text(), "15");
  EXPECT_TRUE(flaws().absent[kDrives].not_in_log.empty());
}

TEST_F(LockstepCyclesTest, BeforeItsFirstMessageAndAfterItsLastASenderWasNotThere) {
  for (std::int64_t seq = 3; seq < 9; ++seq) {
    LoggedCycle one = cycle(seq, seq, seq < 6 ? -1 : seq - 1);
    if (seq < 5 || seq > 7) one.leg_command = one.motion_state = {};
    if (seq < 6) one.drive_command.clear();
    cycles_.add(one);
  }
  EXPECT_TRUE(flaws().every_message());
  EXPECT_TRUE(flaws().deterministic());
}

TEST_F(LockstepCyclesTest, BridgeThatCountsAnewLeavesNoGap) {
  add(0, 9);
  LoggedCycle first = cycle(0);
  first.anew = true;
  cycles_.add(first);
  add(1, 3);
  EXPECT_TRUE(flaws().every_message());
  cycles_.add(cycle(4, 4, 2));
  EXPECT_EQ(flaws().older.text(), "4") << "though the run before had that cycle, and was well";
}

}  // namespace
}  // namespace sprung
