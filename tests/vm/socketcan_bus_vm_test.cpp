/// SocketCanBus on a kernel that has CAN; run by tests/vm/guest-socketcan as root, with vcan0 up. Tests
/// prepare the interface themselves.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/can/raw.h>
#include <net/if.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <vector>

#include "drivers/can/can_errors.h"
#include "drivers/can/can_interface.h"
#include "drivers/can/kernel_frame.h"
#include "drivers/can/receive_controls.h"
#include "drivers/can/socketcan_bus.h"

namespace sprung {
namespace {

void shell(const std::string& command) { ASSERT_EQ(std::system(command.c_str()), 0) << command; }

struct Received {
  std::vector<CanFrame> frames;
  std::vector<std::int64_t> arrivals_us;
};

/// Whether something is there to be read, within a second.
bool comes(const CanBus& bus) {
  pollfd wait{bus.fd(), POLLIN, 0};
  return ::poll(&wait, 1, 1000) > 0;
}

/// Until `count` are there, or nothing has come for a second.
Received collect(CanBus& bus, int count) {
  Received all;
  CanFrame frames[64];
  std::int64_t arrivals_us[64];
  while (static_cast<int>(all.frames.size()) < count) {
    const int got = bus.receive_timed(frames, arrivals_us, 64);
    all.frames.insert(all.frames.end(), frames, frames + got);
    all.arrivals_us.insert(all.arrivals_us.end(), arrivals_us, arrivals_us + got);
    if (got == 0 && !comes(bus)) break;
  }
  return all;
}

/// Reads until the bus has confirmed `count` of its own frames, or nothing has come for a second. @return how
/// many frames of others came with them.
int confirm(CanBus& bus, std::int64_t count) {
  int others = 0;
  while (bus.counters().confirmed < count && comes(bus)) {
    CanFrame frames[64];
    others += bus.receive(frames, 64);
  }
  return others;
}

/// Ids run, data counts: no two are equal.
std::vector<CanFrame> numbered(int count) {
  std::vector<CanFrame> frames(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    CanFrame& frame = frames[i];
    frame.id = static_cast<std::uint32_t>(0x200 + i % 0x100);
    frame.length = static_cast<std::uint8_t>(2 + i % 7);
    frame.data[0] = static_cast<std::uint8_t>(i);
    frame.data[1] = static_cast<std::uint8_t>(i >> 8);
  }
  return frames;
}

bool send(CanBus& bus, const std::vector<CanFrame>& frames) {
  return bus.send(frames.data(), static_cast<int>(frames.size()));
}

/// Two endpoints on an interface that is up and has no queue.
class SocketCan : public testing::Test {
 protected:
  void SetUp() override {
    shell("tc qdisc del dev vcan0 root 2>/dev/null; ip link set vcan0 up");
    a_ = std::make_unique<SocketCanBus>("vcan0");
    b_ = std::make_unique<SocketCanBus>("vcan0");
  }
  std::unique_ptr<SocketCanBus> a_, b_;
};

TEST_F(SocketCan, BatchesArriveWholeAndInOrder) {
  const std::vector<CanFrame> sent = numbered(100);
  ASSERT_TRUE(send(*a_, sent));
  EXPECT_EQ(collect(*b_, 100).frames, sent);
  EXPECT_EQ(a_->counters().sent, 100);
  EXPECT_EQ(b_->counters().received, 100);
  EXPECT_EQ(b_->counters().malformed + b_->counters().dropped, 0);
  EXPECT_EQ(a_->last_send_error(), CanSendError::kNone);
}

TEST_F(SocketCan, ReadsNoMoreThanAskedFor) {
  const std::vector<CanFrame> sent = numbered(10);
  ASSERT_TRUE(send(*a_, sent));
  std::vector<CanFrame> received;
  // vcan hands frames on in a turn of its own: on a slow machine some of them after send() is back.
  while (received.size() < sent.size() && comes(*b_)) {
    std::vector<CanFrame> frames = numbered(6);
    const CanFrame untouched = frames[4];
    const int got = b_->receive(frames.data(), 4);
    ASSERT_LE(got, 4);
    EXPECT_EQ(frames[4], untouched);
    received.insert(received.end(), frames.begin(), frames.begin() + got);
  }
  EXPECT_EQ(received, sent);
  CanFrame frames[4];
  EXPECT_EQ(b_->receive(frames, 4), 0);
}

TEST_F(SocketCan, StampsAreTheKernelsAndNotTheReaders) {
  ::poll(nullptr, 0, 200);  // the kernel begins to stamp some time after it was asked
  const std::int64_t before_us = can_clock_us();
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(send(*a_, numbered(3)));
  const std::int64_t sent_us = can_clock_us();
  ::poll(nullptr, 0, 200);  // the reader wakes up late
  const Received received = collect(*b_, 60);
  ASSERT_EQ(received.frames.size(), 60u);
  EXPECT_TRUE(std::is_sorted(received.arrivals_us.begin(), received.arrivals_us.end()));
  const std::int64_t slack_us = 20'000;  // clocks are read one after the other, on an emulated CPU
  EXPECT_GE(received.arrivals_us.front(), before_us - slack_us);
  EXPECT_LE(received.arrivals_us.back(), sent_us + slack_us);
}

TEST_F(SocketCan, FiltersKeepForeignFramesFromWakingUp) {
  const CanFilter filters[] = {{0x080}, {0x201}};
  ASSERT_TRUE(b_->accept_only(filters, 2));
  CanFrame foreign;
  foreign.id = 0x202;
  ASSERT_TRUE(a_->send(&foreign, 1));
  pollfd wait{b_->fd(), POLLIN, 0};
  EXPECT_EQ(::poll(&wait, 1, 100), 0);
  CanFrame wanted;
  wanted.id = 0x201;
  wanted.remote = true;
  ASSERT_TRUE(a_->send(&wanted, 1));
  wanted.remote = false;
  ASSERT_TRUE(a_->send(&wanted, 1));
  EXPECT_EQ(collect(*b_, 2).frames.size(), 2u) << "remote requests pass like data";
  ASSERT_TRUE(b_->accept_only(nullptr, 0));
  ASSERT_TRUE(a_->send(&foreign, 1));
  EXPECT_EQ(collect(*b_, 1).frames, std::vector<CanFrame>{foreign});
}

TEST_F(SocketCan, ErrorFramesPassEveryFilter) {
  const CanFilter none{0x7FF};
  ASSERT_TRUE(b_->accept_only(&none, 1));
  shell("cansend vcan0 20000040#0000000000000000");
  shell("cansend vcan0 20000004#0020000000000000");
  shell("cansend vcan0 20000100#0000000000000000");
  const std::vector<CanFrame> frames = collect(*b_, 3).frames;
  ASSERT_EQ(frames.size(), 3u);
  EXPECT_TRUE(tells_bus_lost(frames[0])) << "bus off";
  EXPECT_TRUE(tells_bus_lost(frames[1])) << "transmitter error passive";
  EXPECT_TRUE(tells_bus_restarted(frames[2]));
}

TEST_F(SocketCan, RemoteRequestsGoBothWays) {
  CanFrame request;
  request.id = 0x701;
  request.length = 1;
  request.remote = true;
  ASSERT_TRUE(a_->send(&request, 1));
  EXPECT_EQ(collect(*b_, 1).frames, std::vector<CanFrame>{request});
  shell("cansend vcan0 702#R");
  const std::vector<CanFrame> frames = collect(*b_, 1).frames;
  ASSERT_EQ(frames.size(), 1u);
  EXPECT_TRUE(frames[0].remote);
  EXPECT_EQ(frames[0].id, 0x702u);
}

TEST_F(SocketCan, ExtendedFramesAreCountedAndIgnored) {
  shell("cansend vcan0 12345678#01");
  CanFrame plain;
  ASSERT_TRUE(a_->send(&plain, 1));
  EXPECT_EQ(collect(*b_, 1).frames, std::vector<CanFrame>{plain});
  EXPECT_EQ(b_->counters().malformed, 1);
}

TEST_F(SocketCan, OwnFramesComeBackAsConfirmationsOnly) {
  ASSERT_TRUE(send(*a_, numbered(40)));
  ASSERT_EQ(collect(*b_, 40).frames.size(), 40u);
  EXPECT_EQ(confirm(*a_, 40), 0);
  EXPECT_EQ(a_->counters().confirmed, 40);
  EXPECT_EQ(a_->counters().received, 0);
  EXPECT_GE(a_->counters().longest_confirmation_us, a_->counters().confirmation_us);
  EXPECT_LT(a_->counters().longest_confirmation_us, 1'000'000);
}

TEST_F(SocketCan, ConfirmationTellsHowLongAFrameWaitedForTheBus) {
  shell("tc qdisc add dev vcan0 root tbf rate 800bit burst 16 limit 1000");  // 0.16 s a frame
  ASSERT_TRUE(send(*a_, numbered(3)));
  ASSERT_EQ(collect(*b_, 3).frames.size(), 3u);
  EXPECT_EQ(confirm(*a_, 3), 0);
  EXPECT_EQ(a_->counters().confirmed, 3);
  EXPECT_GT(a_->counters().longest_confirmation_us, 250'000);
}

TEST_F(SocketCan, FullQueueIsNoBuffersAndTakesWhatFits) {
  shell("ip link set vcan0 txqueuelen 2");
  shell("tc qdisc add dev vcan0 root handle 1: tbf rate 800bit burst 16 limit 1000");
  shell("tc qdisc add dev vcan0 parent 1:1 pfifo");  // as long as txqueuelen
  const std::vector<CanFrame> sent = numbered(10);
  EXPECT_FALSE(send(*a_, sent));
  EXPECT_EQ(a_->last_send_error(), CanSendError::kNoBuffers);
  const CanBusCounters& counters = a_->counters();
  EXPECT_THAT(counters.sent, testing::AllOf(testing::Ge(2), testing::Le(4)));
  EXPECT_EQ(counters.sent + counters.no_buffers, 10);
  EXPECT_EQ(counters.send_failed, counters.no_buffers);
  EXPECT_EQ(counters.link_down, 0);
  const auto taken = static_cast<std::size_t>(counters.sent);
  EXPECT_EQ(collect(*b_, static_cast<int>(taken)).frames,
            std::vector<CanFrame>(sent.begin(), sent.begin() + counters.sent))
      << "what was taken arrives, in order";
  EXPECT_TRUE(a_->send(sent.data(), 1)) << "there is room again";
  EXPECT_EQ(a_->last_send_error(), CanSendError::kNone);
}

TEST_F(SocketCan, LinkDownIsNamedAndTheLinkWorksAgainWithoutReopening) {
  const std::vector<CanFrame> sent = numbered(3);
  shell("ip link set vcan0 down");
  for (int cycle = 0; cycle < 3; ++cycle) EXPECT_FALSE(send(*a_, sent));
  EXPECT_EQ(a_->last_send_error(), CanSendError::kLinkDown);
  EXPECT_EQ(a_->counters().link_down, 9);
  EXPECT_EQ(a_->counters().no_buffers, 0);
  CanFrame frame;
  EXPECT_EQ(b_->receive(&frame, 1), 0);
  shell("ip link set vcan0 up");
  EXPECT_TRUE(send(*a_, sent));
  EXPECT_EQ(collect(*b_, 3).frames, sent);
}

TEST_F(SocketCan, ShortLossOfTheLinkBetweenTwoCyclesCostsNothing) {
  const std::vector<CanFrame> sent = numbered(3);
  shell("ip link set vcan0 down; ip link set vcan0 up");
  EXPECT_TRUE(send(*a_, sent)) << "the error that the link left is not this frame's";
  EXPECT_EQ(collect(*b_, 3).frames, sent);
  shell("ip link set vcan0 down; ip link set vcan0 up");
  ASSERT_TRUE(send(*b_, sent));
  EXPECT_EQ(collect(*a_, 3).frames, sent) << "nor keeps it from reading";
}

TEST_F(SocketCan, InterfaceThatWasUnpluggedWorksAgainUnderItsName) {
  shell("ip link add dev vcan9 type vcan; ip link set vcan9 up");
  SocketCanBus a("vcan9"), b("vcan9");
  const CanFilter filter{0x200, 0x700};
  ASSERT_TRUE(b.accept_only(&filter, 1));
  const std::vector<CanFrame> sent = numbered(3);
  ASSERT_TRUE(send(a, sent));
  ASSERT_EQ(collect(b, 3).frames, sent);
  shell("ip link del vcan9");
  EXPECT_FALSE(send(a, sent));
  EXPECT_EQ(a.last_send_error(), CanSendError::kLinkDown);
  EXPECT_FALSE(send(b, sent));
  shell("ip link add dev vcan9 type vcan; ip link set vcan9 up");
  EXPECT_TRUE(send(b, sent)) << "both are bound again at their next send";
  EXPECT_TRUE(send(a, sent));
  EXPECT_EQ(collect(b, 3).frames, sent);
  CanFrame foreign;
  ASSERT_TRUE(a.send(&foreign, 1));
  EXPECT_EQ(collect(b, 1).frames.size(), 0u) << "filters hold again";
  shell("ip link del vcan9");
}

TEST_F(SocketCan, FramesLostBeforeTheyWereReadAreCounted) {
  const std::vector<CanFrame> sent = numbered(100);
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(send(*a_, sent));
  const auto first = static_cast<std::int64_t>(collect(*b_, 10'000).frames.size());
  EXPECT_LT(first, 10'000) << "the buffer holds more than this test sends";
  ASSERT_TRUE(send(*a_, sent));  // the kernel tells with the next frame that it queues
  const auto rest = static_cast<std::int64_t>(collect(*b_, 100).frames.size());
  EXPECT_EQ(rest, 100);
  EXPECT_EQ(b_->counters().dropped, 10'000 - first);
}

TEST(CanInterface, VirtualInterfaceIsReadAndNeedsNoAdvice) {
  shell("ip link set vcan0 txqueuelen 32 up");
  const std::optional<InterfaceFacts> facts = read_interface("socketcan:vcan0");
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->kind, "vcan");
  EXPECT_EQ(facts->queue_length, 32);
  EXPECT_THAT(interface_advice(*facts, 12, 1'000'000), testing::IsEmpty());
}

/// qemu's two SJA1000 on one bus, left alone until here.
class Sja1000 : public testing::Test {
 protected:
  void SetUp() override {
    shell("ip link set sja0 down; ip link set sja1 down");
    shell("ip link set sja0 type can bitrate 1000000 restart-ms 100; ip link set sja0 txqueuelen 32 up");
    shell("ip link set sja1 type can bitrate 500000 restart-ms 0; ip link set sja1 txqueuelen 100 up");
  }
};

TEST_F(Sja1000, BitRateRestartTimeAndStateAreReadByNetlink) {
  const std::optional<InterfaceFacts> good = read_interface("socketcan:sja0");
  ASSERT_TRUE(good);
  EXPECT_EQ(good->kind, "can");
  EXPECT_EQ(good->state, "ERROR-ACTIVE");
  EXPECT_EQ(good->bit_rate, 1'000'000);
  EXPECT_EQ(good->restart_ms, 100);
  EXPECT_THAT(interface_advice(*good, 12, 1'000'000), testing::IsEmpty());
  const std::optional<InterfaceFacts> bad = read_interface("socketcan:sja1");
  ASSERT_TRUE(bad);
  EXPECT_THAT(interface_advice(*bad, 12, 1'000'000),
              testing::ElementsAre(testing::HasSubstr("500000"), testing::HasSubstr("restart-ms"),
                                   testing::HasSubstr("100 frames")));
}

TEST_F(Sja1000, FramesCrossAndAreConfirmedByTheController) {
  SocketCanBus a("sja0"), b("sja1");
  const std::vector<CanFrame> frames = numbered(4);  // its receive buffer has 64 bytes, and this CPU is slow
  for (int round = 0; round < 5; ++round) {
    ASSERT_TRUE(send(a, frames));
    EXPECT_EQ(collect(b, 4).frames, frames);
    ASSERT_TRUE(send(b, frames));
    EXPECT_EQ(collect(a, 4).frames, frames);
  }
  CanFrame none;
  EXPECT_EQ(b.receive(&none, 1), 0);
  EXPECT_EQ(a.counters().confirmed, 20);
  EXPECT_EQ(b.counters().confirmed, 20);
}

TEST_F(Sja1000, RemoteRequestsCrossAController) {
  SocketCanBus a("sja0"), b("sja1");
  CanFrame request;
  request.id = 0x701;
  request.remote = true;
  ASSERT_TRUE(a.send(&request, 1));
  EXPECT_EQ(collect(b, 1).frames, std::vector<CanFrame>{request});
}

TEST_F(Sja1000, ControllerThatIsSwitchedOffAndOnWorksAgain) {
  SocketCanBus a("sja0"), b("sja1");
  const std::vector<CanFrame> sent = numbered(4);
  shell("ip link set sja0 down");
  EXPECT_FALSE(send(a, sent));
  EXPECT_EQ(a.last_send_error(), CanSendError::kLinkDown);
  EXPECT_EQ(read_interface("socketcan:sja0")->state, "STOPPED");
  shell("ip link set sja0 up");
  EXPECT_TRUE(send(a, sent));
  EXPECT_EQ(collect(b, 4).frames, sent);
}

/// An interface that takes CAN FD, somebody who speaks it, and a classic bus of ours on it.
class CanFd : public testing::Test {
 protected:
  void SetUp() override {
    shell("ip link set vcan0 down; ip link set vcan0 mtu 72; ip link set vcan0 up");
    ours_ = std::make_unique<SocketCanBus>("vcan0");
    hears_ = std::make_unique<SocketCanBus>("vcan0", true);
    stranger_ = ::socket(PF_CAN, SOCK_RAW, CAN_RAW);
    const int on = 1;
    ASSERT_EQ(::setsockopt(stranger_, SOL_CAN_RAW, CAN_RAW_FD_FRAMES, &on, sizeof on), 0);
    sockaddr_can address{};
    address.can_family = AF_CAN;
    address.can_ifindex = static_cast<int>(::if_nametoindex("vcan0"));
    ASSERT_EQ(::bind(stranger_, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
  }
  void TearDown() override {
    ::close(stranger_);
    shell("ip link set vcan0 down; ip link set vcan0 mtu 16; ip link set vcan0 up");
  }
  void send_fd(std::uint32_t id, std::uint8_t length) const {
    CanFdFrame frame;
    frame.id = id;
    frame.fast = true;
    frame.length = length;
    for (std::size_t i = 0; i < length; ++i) frame.data[i] = static_cast<std::uint8_t>(255 - i);
    const canfd_frame raw = fd_to_kernel(frame);
    ASSERT_EQ(::write(stranger_, &raw, CANFD_MTU), static_cast<ssize_t>(CANFD_MTU));
  }
  int stranger_ = -1;
  std::unique_ptr<SocketCanBus> ours_, hears_;
};

TEST_F(CanFd, ClassicFramesWorkBesideFramesOfFdAndNoneIsMistaken) {
  const std::vector<CanFrame> sent = numbered(20);
  for (const CanFrame& frame : sent) {
    send_fd(0x181, 64);  // an identifier of ours
    send_fd(0x181, 8);   // and as long as a classic frame
    ASSERT_TRUE(ours_->send(&frame, 1));
  }
  EXPECT_EQ(collect(*hears_, 20).frames, sent);
  confirm(*ours_, 20);
  CanFrame frame;
  EXPECT_EQ(ours_->receive(&frame, 1), 0);
  EXPECT_EQ(ours_->counters().fd_frames + ours_->counters().malformed, 0) << "the kernel gives it none";
  EXPECT_EQ(hears_->counters().malformed, 0);
  EXPECT_EQ(hears_->counters().fd_frames, 40);
}

TEST_F(CanFd, FramesOfFdAreHeardWhole) {
  send_fd(0x123, 64);
  send_fd(0x124, 12);
  EXPECT_TRUE(collect(*hears_, 1).frames.empty());
  CanFdFrame frames[4];
  ASSERT_EQ(hears_->receive_fd(frames, 4), 2);
  EXPECT_EQ(frames[0].id, 0x123u);
  EXPECT_EQ(frames[0].length, 64);
  EXPECT_TRUE(frames[0].fast);
  EXPECT_EQ(frames[0].data[63], 192);
  EXPECT_EQ(frames[1].length, 12);
  EXPECT_EQ(hears_->receive_fd(frames, 4), 0);
}

TEST_F(CanFd, ClassicInterfaceIsRefusedForFd) {
  shell("ip link set vcan0 down; ip link set vcan0 mtu 16; ip link set vcan0 up");
  try {
    const SocketCanBus bus("vcan0", true);
    FAIL() << "not refused";
  } catch (const std::runtime_error& error) {
    EXPECT_THAT(error.what(), testing::HasSubstr("fd on"));
  }
}

}  // namespace
}  // namespace sprung
