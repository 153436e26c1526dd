#include "tools/operate/client/cycle_assembler.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

namespace sprung {
namespace {

/// The messages of a cycle, in the order of their bits below.
enum Part : unsigned { kDrive = 1, kJoint = 2, kCommand = 4, kTruth = 8, kMotion = 16, kLeg = 32, kAll = 63 };

class CycleAssemblerTest : public testing::Test {
 protected:
  void add(std::int64_t seq, unsigned parts = kAll) {
    add_if<DriveState>(parts & kDrive, seq, DriveState(2));
    add_if<JointState>(parts & kJoint, seq, JointState(2, 1));
    add_if<DriveCommand>(parts & kCommand, seq, DriveCommand(2));
    add_if<SimTruth>(parts & kTruth, seq, SimTruth(2, 1));
    add_if<MotionState>(parts & kMotion, seq, MotionState(1));
    add_if<LegCommand>(parts & kLeg, seq, LegCommand(1));
  }
  std::vector<std::int64_t> handed_over() {
    std::vector<std::int64_t> seqs;
    const int count = assembler_.hand_over([&](const CycleRecord& cycle) {
      const std::int64_t seq = cycle.drive_state.stamp.seq;
      for (const std::int64_t other :
           {cycle.joint_state.stamp.seq, cycle.drive_command.stamp.seq, cycle.truth.stamp.seq,
            cycle.motion_state.stamp.seq, cycle.leg_command.stamp.seq})
        EXPECT_EQ(other, seq);
      seqs.push_back(seq);
    });
    EXPECT_EQ(count, static_cast<int>(seqs.size()));
    return seqs;
  }
  using Seqs = std::vector<std::int64_t>;
  CycleAssembler assembler_;

 private:
  template <class Signal>
  void add_if(bool wanted, std::int64_t seq, Signal signal) {
    signal.stamp.seq = seq;
    if (wanted) assembler_.add(std::move(signal));
  }
};

TEST_F(CycleAssemblerTest, CyclesComeOnceInOrderAndWhole) {
  for (const std::int64_t seq : {0, 2, 1, 3}) add(seq);
  add(1);  // a repeat
  EXPECT_EQ(handed_over(), (Seqs{0, 1, 2, 3}));
  EXPECT_EQ(assembler_.lost_cycles(), 0);
  EXPECT_EQ(assembler_.last_cycle(), 3);
  add(1);  // one that comes late
  EXPECT_EQ(handed_over(), Seqs{});
}

TEST_F(CycleAssemblerTest, CycleWaitsForItsLastMessageWhicheverThatIs) {
  std::int64_t seq = 0;
  for (unsigned missing = kDrive; missing <= kLeg; missing <<= 1, seq += 3) {
    add(seq);
    add(seq + 1, kAll & ~missing);
    add(seq + 2);
    EXPECT_EQ(handed_over(), (Seqs{seq}));
    add(seq + 1, missing);
    EXPECT_EQ(handed_over(), (Seqs{seq + 1, seq + 2}));
  }
  EXPECT_EQ(assembler_.lost_cycles(), 0);
}

TEST_F(CycleAssemblerTest, LostMessageIsCountedAndNeverMadeUp) {
  for (std::int64_t seq = 0; seq <= 150; ++seq) add(seq, seq == 7 ? kAll & ~kJoint : kAll);
  const Seqs seqs = handed_over();
  EXPECT_EQ(seqs.size(), 150u);
  EXPECT_EQ(std::count(seqs.begin(), seqs.end(), 7), 0);
  EXPECT_EQ(assembler_.lost_cycles(), 1);
}

TEST_F(CycleAssemblerTest, WholeCycleThatNeverCameIsCounted) {
  for (const std::int64_t seq : {10, 11}) add(seq);
  for (std::int64_t seq = 14; seq <= 130; ++seq) add(seq);
  EXPECT_EQ(handed_over().size(), 2u + 117u);
  EXPECT_EQ(assembler_.last_cycle(), 130);
  EXPECT_EQ(assembler_.lost_cycles(), 2);
}

TEST_F(CycleAssemblerTest, CycleInWhichItJoinedIsNotLost) {
  add(5, kAll & ~kDrive);
  for (std::int64_t seq = 6; seq <= 110; ++seq) add(seq);
  EXPECT_EQ(handed_over().front(), 6);
  EXPECT_EQ(assembler_.lost_cycles(), 0);
}

}  // namespace
}  // namespace sprung
