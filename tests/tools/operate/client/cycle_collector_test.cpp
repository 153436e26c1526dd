#include "tools/operate/client/cycle_collector.h"

#include <gtest/gtest.h>

#include <vector>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/process_status.h"
#include "signals/safety_state.h"
#include "tests/runtime/lcm_network.h"

namespace sprung {
namespace {

/// Plays the stack's messages over a network of its own. Which cycles are whole is cycle_assembler_test's.
class CycleCollectorTest : public testing::Test {
 protected:
  RunInfo info() const {
    RunInfo run;
    run.session = kSession;
    run.lcm_url = url_;
    return run;
  }
  template <class Signal>
  void publish(const char* channel, Signal signal) {
    signal.stamp.seq = kSeq;
    sender_.publisher<Signal>(channel).publish(signal);
  }
  void send_cycle() {
    publish(channels::kDriveState, DriveState(2));
    publish(channels::kJointState, JointState(2, 1));
    publish(channels::kDriveCommand, DriveCommand(2));
    publish(channels::kSimTruth, SimTruth(2, 1));
    publish(channels::kMotionState, MotionState(1));
    publish(channels::kLegCommand, LegCommand(1));
  }

  static constexpr std::int64_t kSession = 42, kSeq = 7, kTimeout_us = 20'000'000;
  const std::string url_ = test::own_lcm_url();
  RobotConfig robot_ = load_robot("single_leg");
  CycleCollector collector_{info(), robot_};
  Node sender_{NodeOptions{url_, kSession, 0, {}}};
};

/// LCM may lose any of them: what was sent is sent again until all have come.
TEST_F(CycleCollectorTest, EveryChannelOfACycleIsHeardAndTheRepliesToo) {
  std::vector<std::int64_t> seqs, requests;
  for (const std::int64_t end_us = sender_.utime_us() + kTimeout_us;
       (seqs.empty() || requests.empty()) && sender_.utime_us() < end_us;) {
    send_cycle();
    OperatorReply reply;
    reply.request_id = 5;
    sender_.publisher<OperatorReply>(channels::kOperatorReply).publish(reply);
    collector_.wait(0.02);
    collector_.collect([&](const CycleRecord& cycle) { seqs.push_back(cycle.drive_state.stamp.seq); },
                       [&](const OperatorReply& heard) { requests.push_back(heard.request_id); });
  }
  EXPECT_EQ(seqs, std::vector<std::int64_t>{kSeq});
  ASSERT_FALSE(requests.empty());
  EXPECT_EQ(requests.front(), 5);
  EXPECT_EQ(collector_.last_cycle(), kSeq);
  EXPECT_EQ(collector_.lost_cycles(), 0);
}

TEST_F(CycleCollectorTest, WhatIsMissedAfterTheLastCycleThatCountsIsNotCounted) {
  collector_.count_until(kSeq);
  bool heard = false;
  for (const std::int64_t end_us = sender_.utime_us() + kTimeout_us; !heard && sender_.utime_us() < end_us;) {
    SafetyState safety;
    safety.stamp.seq = kSeq;
    safety.missed_cycles = 2;
    sender_.publisher<SafetyState>(channels::kSafetyState).publish(safety);
    collector_.wait(0.02);
    collector_.collect([](const CycleRecord&) {}, [](const OperatorReply&) {});
    heard = collector_.missed_cycles() == 2;
    safety.stamp.seq = kSeq + 1;
    safety.missed_cycles = 3;
    sender_.publisher<SafetyState>(channels::kSafetyState).publish(safety);
    collector_.wait(0.02);
    collector_.collect([](const CycleRecord&) {}, [](const OperatorReply&) {});
  }
  EXPECT_TRUE(heard);
  EXPECT_EQ(collector_.missed_cycles(), 2);
}

/// The simulated drives say so when the bridge holds still for a second, and when it has ended in order.
TEST_F(CycleCollectorTest, RunThatAProcessCallsNotDeterministicBeforeTheLastCycleIsKnown) {
  collector_.count_until(kSeq);
  const auto says = [&](std::int64_t seq, const std::string& detail) {
    ProcessStatus status;
    status.stamp.seq = seq;
    status.process = "sprung-sim-drives";
    status.detail = detail;
    sender_.publisher<ProcessStatus>(channels::kProcessStatus).publish(status);
    collector_.wait(0.02);
    collector_.collect([](const CycleRecord&) {}, [](const OperatorReply&) {});
  };
  says(kSeq - 1, "refused: wrong hash");
  says(kSeq, "no SYNC: this run is not deterministic");
  EXPECT_EQ(collector_.not_deterministic(), "");
  const std::int64_t end_us = sender_.utime_us() + kTimeout_us;
  while (collector_.not_deterministic().empty() && sender_.utime_us() < end_us)
    says(kSeq - 1, "no SYNC: this run is not deterministic");
  EXPECT_EQ(collector_.not_deterministic(), "sprung-sim-drives: no SYNC: this run is not deterministic");
}

}  // namespace
}  // namespace sprung
