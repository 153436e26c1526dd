#include "tools/client/cycle_collector.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <vector>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "tools/experiments/separate_run.h"
#include "tools/launcher/launcher.h"

namespace sprung {
namespace {

/// Plays the stack's messages over a network of its own.
class CycleCollectorTest : public testing::Test {
 protected:
  RunInfo info() const {
    RunInfo run;
    run.session = 42;
    run.lcm_url = url_;
    return run;
  }
  /// Every message of a cycle but the channels left out.
  void send(std::int64_t seq, const std::set<std::string>& without = {}) {
    publish(seq, channels::kDriveState, DriveState(2), without);
    publish(seq, channels::kJointState, JointState(2, 1), without);
    publish(seq, channels::kDriveCommand, DriveCommand(2), without);
    publish(seq, channels::kSimTruth, SimTruth(2, 1), without);
    publish(seq, channels::kMotionState, MotionState(1), without);
    publish(seq, channels::kLegCommand, LegCommand(1), without);
  }
  template <class Signal>
  void publish(std::int64_t seq, const char* channel, Signal signal, const std::set<std::string>& without) {
    if (without.count(channel) > 0) return;
    signal.stamp.seq = seq;
    sender_.publisher<Signal>(channel).publish(signal);
  }
  /// Cycles handed over until `last` came or a second passed.
  std::vector<std::int64_t> collect(std::int64_t last) {
    std::vector<std::int64_t> seqs;
    const std::int64_t end_us = sender_.utime_us() + 1'000'000;
    while (sender_.utime_us() < end_us && (seqs.empty() || seqs.back() < last)) {
      collector_.wait(0.02);
      collector_.collect([&](const CycleRecord& cycle) { seqs.push_back(cycle.drive_state.stamp.seq); },
                         [](const OperatorReply&) {});
    }
    return seqs;
  }

  const std::string url_ = lcm_url_on_port(random_port());
  RobotConfig robot_ = load_robot("single_leg");
  CycleCollector collector_{info(), robot_};
  Node sender_{NodeOptions{url_, 42, 0, {}}};
};

TEST_F(CycleCollectorTest, CyclesComeOnceInOrderAndWhole) {
  for (std::int64_t seq : {0, 2, 1, 3}) send(seq);
  send(1);  // a repeat
  EXPECT_EQ(collect(3), (std::vector<std::int64_t>{0, 1, 2, 3}));
  EXPECT_EQ(collector_.lost_cycles(), 0);
  EXPECT_EQ(collector_.last_cycle(), 3);
}

TEST_F(CycleCollectorTest, CycleWaitsForItsLastMessage) {
  send(0);
  send(1, {channels::kSimTruth});
  send(2);
  EXPECT_EQ(collect(0), (std::vector<std::int64_t>{0}));
  publish(1, channels::kSimTruth, SimTruth(2, 1), {});
  EXPECT_EQ(collect(2), (std::vector<std::int64_t>{1, 2}));
  EXPECT_EQ(collector_.lost_cycles(), 0);
}

TEST_F(CycleCollectorTest, LostMessageIsCountedAndNeverMadeUp) {
  for (std::int64_t seq = 0; seq <= 150; ++seq)
    send(seq, seq == 7 ? std::set<std::string>{channels::kJointState} : std::set<std::string>{});
  const std::vector<std::int64_t> seqs = collect(150);
  EXPECT_EQ(seqs.size(), 150u);
  EXPECT_EQ(std::count(seqs.begin(), seqs.end(), 7), 0);
  EXPECT_EQ(collector_.lost_cycles(), 1);
}

TEST_F(CycleCollectorTest, WholeCycleThatNeverCameIsCounted) {
  for (std::int64_t seq : {10, 11}) send(seq);
  for (std::int64_t seq = 14; seq <= 130; ++seq) send(seq);
  collect(130);
  EXPECT_EQ(collector_.last_cycle(), 130);
  EXPECT_EQ(collector_.lost_cycles(), 2);
}

TEST_F(CycleCollectorTest, CycleInWhichItJoinedIsNotLost) {
  send(5, {channels::kDriveState});
  for (std::int64_t seq = 6; seq <= 110; ++seq) send(seq);
  EXPECT_EQ(collect(110).front(), 6);
  EXPECT_EQ(collector_.lost_cycles(), 0);
}

}  // namespace
}  // namespace sprung
