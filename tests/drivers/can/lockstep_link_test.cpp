#include "drivers/can/lockstep_link.h"

#include <gtest/gtest.h>
#include <poll.h>

#include "runtime/own_port.h"

namespace sprung {
namespace {

constexpr char kGroup[] = "239.74.163.78";
constexpr int kTimeout_ms = 20'000;
/// The test's own: what is still on its way to the one before does not come here.
int test_port() {
  static const testing::TestInfo* whose = nullptr;
  static int port = 0;
  const testing::TestInfo* const now = testing::UnitTest::GetInstance()->current_test_info();
  if (now != whose) port = own_port();
  whose = now;
  return port;
}

LockstepLink link(std::vector<BurstFault> faults = {}) {
  return LockstepLink(std::make_unique<UdpBus>(kGroup, test_port()), std::move(faults));
}

FrameBatch batch_of(std::int64_t tick, int count) {
  FrameBatch batch;
  for (int i = 0; i < count; ++i) {
    CanFrame frame;
    frame.id = static_cast<std::uint32_t>(0x100 + i);
    frame.length = 1;
    frame.remote = i == 2;  // node guarding travels in bursts too
    frame.data[0] = frame.remote ? std::uint8_t{0} : static_cast<std::uint8_t>(tick & 0xFF);
    batch.push(0, frame);
    batch.push(1, frame);  // another bus's: not for this link
  }
  return batch;
}

LinkEvent wait_event(LockstepLink& of, int timeout_ms) {
  LinkEvent event = of.poll();
  while (event == LinkEvent::kNothing) {
    pollfd wait{of.fd(), POLLIN, 0};
    if (::poll(&wait, 1, timeout_ms) <= 0) break;
    event = of.poll();
  }
  return event;
}

/// The bridge's and the drives' side of one tick, each as its shell would do it. @return how often the bridge
/// sent again.
int exchange(LockstepLink& bridge, LockstepLink& drives, std::int64_t tick, int question, int answer,
             int& steps) {
  bridge.add(batch_of(tick, question), 0);
  bridge.send_burst(tick);
  for (int resends = 0; resends < 10; ++resends) {
    for (LinkEvent event = wait_event(drives, 20); event != LinkEvent::kNothing; event = drives.poll()) {
      if (event == LinkEvent::kRepeat) {
        drives.resend();
        continue;
      }
      ++steps;
      EXPECT_EQ(drives.tick(), tick);
      EXPECT_EQ(drives.frames().size(), static_cast<std::size_t>(question));
      drives.add(batch_of(tick, answer), 0);
      drives.send_answer(drives.tick());
    }
    if (wait_event(bridge, 20) == LinkEvent::kComplete) return resends;
    bridge.resend();
  }
  ADD_FAILURE() << "no answer for tick " << tick;
  return 10;
}

void take_at_least(UdpBus& bus, int count) {
  CanFrame frames[64];
  for (int got = 0; got < count; got += bus.receive(frames, 64)) {
    pollfd wait{bus.fd(), POLLIN, 0};
    ASSERT_EQ(::poll(&wait, 1, kTimeout_ms), 1);
  }
}

TEST(LockstepLink, BurstsAndAnswersArriveWholeWithEmptyAnswersSeen) {
  LockstepLink bridge = link(), drives = link();
  int steps = 0;
  for (std::int64_t tick = 0; tick < 50; ++tick) {
    const int answer = static_cast<int>(tick % 4);
    exchange(bridge, drives, tick, 3, answer, steps);
    EXPECT_EQ(bridge.tick(), tick);
    ASSERT_EQ(bridge.frames().size(), static_cast<std::size_t>(answer));
    for (int i = 0; i < answer; ++i) EXPECT_EQ(bridge.frames()[i], batch_of(tick, 4)[2 * i].frame);
  }
  EXPECT_EQ(steps, 50);
}

TEST(LockstepLink, LostAndRepeatedFramesChangeNothingAndStepNothingTwice) {
  using Kind = BurstFault::Kind;
  LockstepLink bridge = link({{1, 0, Kind::kDrop}, {2, 2, Kind::kDrop}, {3, 1, Kind::kRepeat}});
  LockstepLink drives = link({{4, 0, Kind::kDrop}, {5, 2, Kind::kDrop}, {6, 2, Kind::kRepeat}});
  int steps = 0;
  int resends = 0;
  for (std::int64_t tick = 0; tick < 8; ++tick) {
    resends += exchange(bridge, drives, tick, 3, 2, steps);
    ASSERT_EQ(bridge.tick(), tick);
    ASSERT_EQ(bridge.frames().size(), 2U);
    EXPECT_EQ(bridge.frames()[1], batch_of(tick, 2)[2].frame);
  }
  EXPECT_EQ(steps, 8) << "the drives must step once a tick";
  EXPECT_GE(resends, 4);
  EXPECT_GE(drives.counters().resent, 2);
}

TEST(LockstepLink, FramesOfOtherToolsAreIgnoredAndCounted) {
  LockstepLink bridge = link(), drives = link();
  UdpBus tool(kGroup, test_port());
  const CanFrame frame = batch_of(0, 1)[0].frame;
  tool.send(&frame, 1);
  pollfd wait{drives.fd(), POLLIN, 0};
  ASSERT_EQ(::poll(&wait, 1, kTimeout_ms), 1);
  EXPECT_EQ(drives.poll(), LinkEvent::kNothing);
  EXPECT_EQ(drives.counters().unstamped, 1);
  const std::vector<CanFrame> outsiders = drives.take_outsiders();
  ASSERT_EQ(outsiders.size(), 1u);
  EXPECT_EQ(outsiders[0].id, frame.id);
  EXPECT_TRUE(drives.take_outsiders().empty());
}

TEST(LockstepLink, FloodOfAToolDoesNotHoldUpTheLook) {
  LockstepLink drives = link();
  UdpBus tool(kGroup, test_port());
  const CanFrame frame = batch_of(0, 1)[0].frame;
  UdpBus witness(kGroup, test_port());
  for (int i = 0; i < 600; ++i) tool.send(&frame, 1);
  take_at_least(witness, 256);  // what has come to one has come to all
  EXPECT_EQ(drives.poll(), LinkEvent::kNothing);
  EXPECT_LE(drives.counters().unstamped, 256);
  EXPECT_EQ(drives.take_outsiders().size(), 64u);
}

TEST(LockstepLink, BurstBeyondTheLimitIsCutAndCounted) {
  LockstepLink bridge = link(), drives = link();
  for (int i = 0; i < 5; ++i) bridge.add(batch_of(0, 250), 0);
  EXPECT_EQ(bridge.counters().overflow, 5 * 250 - (kMaxBurst - 1));
}

}  // namespace
}  // namespace sprung
