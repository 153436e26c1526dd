#include "drivers/can/udp_bus.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <string>
#include <vector>

#include "runtime/own_port.h"

namespace sprung {
namespace {

constexpr char kCanUdpBusGroup[] = "239.74.163.77";
constexpr int kCanUdpBusPatience_ms = 20'000;
/// The test's own: what is still on its way to the one before does not come here.
int can_udp_bus_test_port() {
  static const testing::TestInfo* whose = nullptr;
  static int port = 0;
  const testing::TestInfo* const now = testing::UnitTest::GetInstance()->current_test_info();
  if (now != whose) port = own_port();
  whose = now;
  return port;
}

/// Frames that arrive until `count` are there or nothing comes for a second.
std::vector<CanFrame> collect(CanBus& bus, int count) {
  std::vector<CanFrame> frames;
  CanFrame buffer[64];
  while (static_cast<int>(frames.size()) < count) {
    pollfd wait{bus.fd(), POLLIN, 0};
    if (::poll(&wait, 1, kCanUdpBusPatience_ms) <= 0) break;
    const int got = bus.receive(buffer, 64);
    frames.insert(frames.end(), buffer, buffer + got);
  }
  return frames;
}

std::vector<CanFrame> can_udp_bus_numbered(int count) {
  std::vector<CanFrame> frames(static_cast<std::size_t>(count));
  for (int i = 0; i < count; ++i) {
    frames[i].id = 0x100 + static_cast<std::uint32_t>(i);
    frames[i].length = 8;
  }
  return frames;
}

TEST(UdpBus, FramesReachOtherEndpointsAndNotTheSender) {
  UdpBus a(kCanUdpBusGroup, can_udp_bus_test_port()), b(kCanUdpBusGroup, can_udp_bus_test_port()),
      c(kCanUdpBusGroup, can_udp_bus_test_port());
  const std::vector<CanFrame> sent = can_udp_bus_numbered(40);
  EXPECT_TRUE(a.send(sent.data(), 40));
  EXPECT_EQ(collect(b, 40), sent);
  EXPECT_EQ(collect(c, 40), sent);
  CanFrame own;
  EXPECT_EQ(a.receive(&own, 1), 0);
  EXPECT_EQ(a.counters().sent, 40);
  EXPECT_EQ(b.counters().received, 40);
}

TEST(UdpBus, RemoteFramesArriveAndAreNotMalformed) {
  UdpBus a(kCanUdpBusGroup, can_udp_bus_test_port()), b(kCanUdpBusGroup, can_udp_bus_test_port());
  std::vector<CanFrame> sent(1);
  sent[0].id = 0x705;
  sent[0].length = 1;
  sent[0].remote = true;
  ASSERT_TRUE(a.send(sent.data(), 1));
  EXPECT_EQ(collect(b, 1), sent);
  EXPECT_EQ(b.counters().malformed, 0);
}

TEST(UdpBus, TimestampTravelsWithTheFrame) {
  UdpBus a(kCanUdpBusGroup, can_udp_bus_test_port()), b(kCanUdpBusGroup, can_udp_bus_test_port());
  StampedFrame sent;
  sent.timestamp = 123456789012.0;
  ASSERT_TRUE(a.send_stamped(&sent, 1));
  pollfd wait{b.fd(), POLLIN, 0};
  ASSERT_EQ(::poll(&wait, 1, kCanUdpBusPatience_ms), 1);
  StampedFrame received;
  ASSERT_EQ(b.receive_stamped(&received, 1), 1);
  EXPECT_EQ(received.timestamp, 123456789012.0);
}

TEST(UdpBus, ForeignDatagramsAreCountedAndSkipped) {
  UdpBus a(kCanUdpBusGroup, can_udp_bus_test_port()), b(kCanUdpBusGroup, can_udp_bus_test_port());
  const int fd = ::socket(AF_INET, SOCK_DGRAM, 0);
  sockaddr_in to{};
  to.sin_family = AF_INET;
  to.sin_port = htons(static_cast<std::uint16_t>(can_udp_bus_test_port()));
  ::inet_pton(AF_INET, kCanUdpBusGroup, &to.sin_addr);
  in_addr loop{htonl(INADDR_LOOPBACK)};
  ASSERT_EQ(::setsockopt(fd, IPPROTO_IP, IP_MULTICAST_IF, &loop, sizeof loop), 0);
  const std::string junk(300, 'x');
  ASSERT_GT(::sendto(fd, junk.data(), junk.size(), 0, reinterpret_cast<sockaddr*>(&to), sizeof to), 0);
  ::close(fd);
  const std::vector<CanFrame> sent = can_udp_bus_numbered(1);
  a.send(sent.data(), 1);
  EXPECT_EQ(collect(b, 1), sent);
  EXPECT_EQ(b.counters().malformed, 1);
}

TEST(UdpBus, ReceiveWithoutFramesReturnsAtOnce) {
  UdpBus bus(kCanUdpBusGroup, can_udp_bus_test_port());
  CanFrame frame;
  EXPECT_EQ(bus.receive(&frame, 1), 0);
}

TEST(UdpBus, DescribesItsAddress) {
  EXPECT_EQ(UdpBus(kCanUdpBusGroup, can_udp_bus_test_port()).describe(),
            std::string("udp:") + kCanUdpBusGroup + ":" + std::to_string(can_udp_bus_test_port()));
}

}  // namespace
}  // namespace sprung
