#include "runtime/transport/lcm_address.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "runtime/node.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(LcmAddressTest, PartsAreTakenFromTheUrl) {
  const LcmAddress address = LcmAddress::of("udpm://239.1.2.3:7000?ttl=1&recv_buf_size=4096&interface=eth0");
  EXPECT_EQ(address.group, "239.1.2.3");
  EXPECT_EQ(address.port, 7000);
  EXPECT_EQ(address.ttl, 1);
  EXPECT_EQ(address.receive_buffer_bytes, 4096);
  EXPECT_EQ(address.interface, "eth0");
  EXPECT_EQ(address.url(), "udpm://239.1.2.3:7000?ttl=1&recv_buf_size=4096") << "LCM knows no interface";
}

TEST(LcmAddressTest, WithoutOptionsNothingLeavesTheMachine) {
  const LcmAddress address = LcmAddress::of("udpm://239.255.76.67:7667");
  EXPECT_EQ(address.ttl, 0);
  EXPECT_EQ(address.receive_buffer_bytes, 0);
  EXPECT_EQ(address.interface, "");
}

TEST(LcmAddressTest, DefaultIsOneThatLcmTakesAsItIs) {
  EXPECT_EQ(LcmAddress::of(kDefaultLcmUrl).url(), kDefaultLcmUrl);
}

TEST(LcmAddressTest, WhatIsWrongIsNamedWithAnExample) {
  const auto expect = [](const std::string& url, const std::string& part) {
    EXPECT_THAT([&] { LcmAddress::of(url); },
                testing::ThrowsMessage<std::invalid_argument>(
                    AllOf(HasSubstr(url), HasSubstr(part), HasSubstr("udpm://239.255.76.67:7667"))))
        << url;
  };
  expect("memq://", "only udpm://");
  expect("udpm://10.0.0.1:7667", "'10.0.0.1' is no IPv4 multicast address");
  expect("udpm://239.1.2.3", "'' is no port");
  expect("udpm://239.1.2.3:70000", "'70000' is no port");
  expect("udpm://239.1.2.3:1x", "'1x' is no port");
  expect("udpm://239.1.2.3:7000?ttl=300", "'ttl=300'");
  expect("udpm://239.1.2.3:7000?ttl", "'ttl='");
  expect("udpm://239.1.2.3:7000?speed=1", "'speed=1'");
  expect("udpm://239.1.2.3:7000?interface=", "'interface='");
}

}  // namespace
}  // namespace sprung
