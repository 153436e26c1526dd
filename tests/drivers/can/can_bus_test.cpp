#include "drivers/can/can_bus.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

namespace sprung {
namespace {

std::string refusal_of(const std::string& address) {
  try {
    open_can_bus(address);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "opened";
}

TEST(OpenCanBus, RefusesUnknownFormsAndNamesTheKnownOnes) {
  for (const char* address : {"", "can0", "serial:/dev/ttyS0", "socketcan:"}) {
    EXPECT_THAT(refusal_of(address),
                testing::HasSubstr("expected socketcan:INTERFACE, udp:GROUP:PORT or memory:NAME"));
  }
}

TEST(OpenCanBus, OnlyOneOptionOfSocketCanIsKnown) {
  for (const char* address : {"socketcan:can0?", "socketcan:can0?fd=0", "socketcan:can0?fd=1x",
                              "socketcan:can0?fd", "socketcan:?fd=1", "socketcan:can0?FD=1"}) {
    EXPECT_THAT(refusal_of(address), testing::HasSubstr("socketcan:INTERFACE?fd=1")) << address;
  }
}

TEST(OpenCanBus, RefusesUdpAddressesWithAnExample) {
  for (const char* address : {"udp:", "udp:239.74.163.2", "udp:239.74.163.2:", "udp:239.74.163.2:99999",
                              "udp:239.74.163.2:12x", "udp:239.74.163.2:-1"}) {
    EXPECT_THAT(refusal_of(address), testing::HasSubstr("e.g. udp:239.74.163.2:43113")) << address;
  }
  EXPECT_THAT(refusal_of("udp:127.0.0.1:43113"), testing::HasSubstr("no IPv4 multicast address"));
}

TEST(OpenCanBus, MemoryBusesOfOneNameShareAMedium) {
  const auto first = open_can_bus("memory:factory_test");
  const auto second = open_can_bus("memory:factory_test");
  const auto other = open_can_bus("memory:factory_test_2");
  CanFrame frame;
  frame.id = 0x123;
  EXPECT_TRUE(first->send(&frame, 1));
  CanFrame received;
  ASSERT_EQ(second->receive(&received, 1), 1);
  EXPECT_EQ(received, frame);
  EXPECT_EQ(other->receive(&received, 1), 0);
  EXPECT_EQ(first->describe(), "memory:factory_test");
}

}  // namespace
}  // namespace sprung
