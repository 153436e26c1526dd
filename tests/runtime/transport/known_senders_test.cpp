#include "runtime/transport/known_senders.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>

namespace sprung {
namespace {

std::uint32_t ip(const char* text) {
  in_addr address{};
  inet_pton(AF_INET, text, &address);
  return address.s_addr;
}

TEST(KnownSendersTest, RangeIsANetworkOrOneAddress) {
  const AddressRange network{ip("192.168.7.1"), ip("255.255.255.0")};
  EXPECT_TRUE(network.has(ip("192.168.7.200")));
  EXPECT_FALSE(network.has(ip("192.168.8.1")));
  const AddressRange one{ip("192.168.7.1")};
  EXPECT_TRUE(one.has(ip("192.168.7.1")));
  EXPECT_FALSE(one.has(ip("192.168.7.2")));
}

TEST(KnownSendersTest, ThisMachineIsKnownAndOthersAreNot) {
  KnownSenders senders("");
  EXPECT_TRUE(senders.has(ip("127.0.0.1"), 0));
  EXPECT_TRUE(senders.has(ip("127.3.2.1"), 0));
  EXPECT_TRUE(senders.has(ip("0.0.0.0"), 0)) << "a machine without any network";
  // TEST-NET-3 and broadcast: nobody's address
  EXPECT_FALSE(senders.has(ip("203.0.113.7"), 2 * KnownSenders::kLookAgain_us));
  EXPECT_FALSE(senders.has(ip("255.255.255.255"), 2 * KnownSenders::kLookAgain_us));
}

TEST(KnownSendersTest, InterfaceBringsItsNetwork) {
  EXPECT_EQ(ranges_of_this_host("lo").size(), ranges_of_this_host("").size() + 1);
  EXPECT_EQ(ranges_of_this_host("none7").size(), ranges_of_this_host("").size());
  EXPECT_FALSE(KnownSenders("lo").has(ip("203.0.113.7"), 0));
}

}  // namespace
}  // namespace sprung
