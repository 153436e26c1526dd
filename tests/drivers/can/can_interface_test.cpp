#include "drivers/can/can_interface.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

constexpr int kRate = 1'000'000;  // bit/s

InterfaceFacts good() {
  InterfaceFacts facts;
  facts.name = "can0";
  facts.kind = "can";
  facts.state = "ERROR-ACTIVE";
  facts.up = true;
  facts.bit_rate = 1'000'000;
  facts.restart_ms = 100;
  facts.queue_length = 32;
  return facts;
}

TEST(InterfaceAdvice, TypicalSetUpNeedsNone) { EXPECT_THAT(interface_advice(good(), 12, kRate), IsEmpty()); }

TEST(InterfaceAdvice, LongQueueKeepsOldSetPoints) {
  InterfaceFacts facts = good();
  facts.queue_length = 64;
  EXPECT_THAT(interface_advice(facts, 12, kRate), IsEmpty());
  facts.queue_length = 65;
  EXPECT_THAT(interface_advice(facts, 12, kRate),
              ElementsAre(AllOf(HasSubstr("65"), HasSubstr("ip link set can0 txqueuelen 32"))));
}

TEST(InterfaceAdvice, QueueMustHoldACycle) {
  InterfaceFacts facts = good();
  facts.queue_length = 12;
  EXPECT_THAT(interface_advice(facts, 12, kRate), IsEmpty());
  facts.queue_length = 11;
  EXPECT_THAT(interface_advice(facts, 12, kRate), ElementsAre(AllOf(HasSubstr("11"), HasSubstr("12"))));
}

TEST(InterfaceAdvice, BusOffMustNotBeForGood) {
  InterfaceFacts facts = good();
  facts.restart_ms = 0;
  EXPECT_THAT(interface_advice(facts, 12, kRate), ElementsAre(HasSubstr("restart-ms 100")));
}

TEST(InterfaceAdvice, OtherBitRatesAreNamed) {
  InterfaceFacts facts = good();
  facts.bit_rate = 500'000;
  EXPECT_THAT(interface_advice(facts, 12, kRate),
              ElementsAre(AllOf(HasSubstr("500000"), HasSubstr("bitrate 1000000"))));
}

TEST(InterfaceAdvice, RightBitRateIsTheRobots) {
  InterfaceFacts facts = good();
  facts.bit_rate = 500'000;
  EXPECT_THAT(interface_advice(facts, 12, 500'000), IsEmpty());
  EXPECT_THAT(interface_advice(good(), 12, 500'000),
              ElementsAre(AllOf(HasSubstr("1000000, not 500000"), HasSubstr("bitrate 500000"))));
}

std::string refusal(const InterfaceFacts& facts, int bit_rate) {
  return test::refusal_of([&] { check_bit_rate(facts, bit_rate); });
}

TEST(CheckBitRate, AnotherOneThanTheRobotsIsRefusedWithBothRemedies) {
  EXPECT_EQ(refusal(good(), kRate), "not refused");
  EXPECT_THAT(refusal(good(), 500'000),
              AllOf(HasSubstr("can0: bit rate is 1000000, not 500000"), HasSubstr("bit_rate")));
}

// 800 kbit/s of an 8 MHz clock come out exact, of others not quite; the kernel tells what it could set.
TEST(CheckBitRate, RoundingOfTheControllersClockIsNoDifference) {
  InterfaceFacts facts = good();
  facts.bit_rate = 803'571;
  EXPECT_EQ(refusal(facts, 800'000), "not refused");
  EXPECT_THAT(interface_advice(facts, 12, 800'000), IsEmpty());
  facts.bit_rate = 820'000;
  EXPECT_THAT(refusal(facts, 800'000), HasSubstr("820000, not 800000"));
}

TEST(CheckBitRate, WhatIsNotKnownIsOnlyWarnedOf) {
  InterfaceFacts facts = good();
  facts.bit_rate = 0;
  EXPECT_EQ(refusal(facts, kRate), "not refused");
  EXPECT_THAT(interface_advice(facts, 12, kRate), ElementsAre(HasSubstr("bitrate 1000000")));
  facts.kind = "vcan";
  EXPECT_EQ(refusal(facts, kRate), "not refused");
}

TEST(InterfaceAdvice, ControllerInTroubleIsNamedOnlyWhenUp) {
  InterfaceFacts facts = good();
  facts.state = "BUS-OFF";
  EXPECT_THAT(interface_advice(facts, 12, kRate), ElementsAre(HasSubstr("BUS-OFF")));
  facts.state = "STOPPED";
  facts.up = false;
  EXPECT_THAT(interface_advice(facts, 12, kRate), ElementsAre(HasSubstr("ip link set can0 up")));
}

TEST(InterfaceAdvice, VirtualInterfaceOnlyHasToBeUp) {
  InterfaceFacts facts;
  facts.name = "vcan0";
  facts.kind = "vcan";
  facts.queue_length = 1000;
  facts.up = true;
  EXPECT_THAT(interface_advice(facts, 12, kRate), IsEmpty());
  facts.up = false;
  EXPECT_THAT(interface_advice(facts, 12, kRate), ElementsAre(HasSubstr("ip link set vcan0 up")));
}

// As iproute2 6.1 printed them for an emulated SJA1000 and a vcan (tests/vm), shortened.
constexpr char kSja1000[] =
    R"([{"ifindex":2,"ifname":"can0","flags":["NOARP","UP","LOWER_UP","ECHO"],"mtu":16,
  "qdisc":"pfifo_fast","operstate":"UP","txqlen":10,"link_type":"can","linkinfo":{"info_kind":"can","info_data":{
  "ctrlmode_supported":["LOOPBACK","ONE-SHOT"],"state":"ERROR-ACTIVE","berr_counter":{"tx":0,"rx":0},"restart_ms":100,
  "bittiming":{"bitrate":1000000,"sample_point":"0.750","tq":125},"clock":8000000}}}])";
constexpr char kNotSetUp[] = R"([{"ifname":"can1","flags":["NOARP","ECHO"],"txqlen":10,"link_type":"can",
  "linkinfo":{"info_kind":"can","info_data":{"state":"STOPPED","restart_ms":0}}}])";
constexpr char kVirtual[] =
    R"([{"ifname":"vcan0","flags":["NOARP","UP","LOWER_UP"],"txqlen":1000,"link_type":"can",
  "linkinfo":{"info_kind":"vcan"}}])";

TEST(ParseInterface, ReadsAController) {
  const std::optional<InterfaceFacts> facts = parse_interface(kSja1000);
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->name, "can0");
  EXPECT_EQ(facts->kind, "can");
  EXPECT_EQ(facts->state, "ERROR-ACTIVE");
  EXPECT_TRUE(facts->up);
  EXPECT_EQ(facts->bit_rate, 1'000'000);
  EXPECT_EQ(facts->restart_ms, 100);
  EXPECT_EQ(facts->queue_length, 10);
}

TEST(ParseInterface, ControllerThatWasNotSetUpHasNoBitRate) {
  const std::optional<InterfaceFacts> facts = parse_interface(kNotSetUp);
  ASSERT_TRUE(facts);
  EXPECT_FALSE(facts->up);
  EXPECT_EQ(facts->bit_rate, 0);
  EXPECT_EQ(facts->state, "STOPPED");
}

TEST(ParseInterface, ReadsAVirtualInterface) {
  const std::optional<InterfaceFacts> facts = parse_interface(kVirtual);
  ASSERT_TRUE(facts);
  EXPECT_EQ(facts->kind, "vcan");
  EXPECT_EQ(facts->bit_rate, 0);
}

TEST(RequireVirtual, SimulationIsRefusedOnARealController) {
  EXPECT_NO_THROW(require_virtual(*parse_interface(kVirtual)));
  InterfaceFacts real;
  real.name = "can0";
  real.kind = "can";
  try {
    require_virtual(real);
    FAIL() << "a real controller was taken";
  } catch (const std::invalid_argument& error) {
    EXPECT_EQ(std::string(error.what()).find("can0 is a real CAN interface, and this is a simulation"), 0U);
  }
}

TEST(ParseInterface, AnythingElseIsNoCanInterface) {
  for (const char* text : {"", "[]", "{}", "[1]", "no json", R"([{"ifname":"eth0","link_type":"ether"}])",
                           R"([{"ifname":7,"link_type":"can"}])", R"([{"link_type":"can","linkinfo":[]}])"}) {
    EXPECT_FALSE(parse_interface(text)) << text;
  }
}

TEST(ReadInterface, OnlySocketCanAddressesThatAreOneWordAreAskedFor) {
  for (const char* address : {"udp:239.74.163.2:43113", "socketcan:", "socketcan:lo", "socketcan:a;b",
                              "socketcan:-h", "socketcan:nosuchcan9", "socketcan:a_name_that_is_too_long"}) {
    EXPECT_FALSE(read_interface(address)) << address;
  }
}

TEST(InterfaceOf, IsTheNameWithoutOptions) {
  EXPECT_EQ(interface_of("socketcan:can0"), "can0");
  EXPECT_EQ(interface_of("socketcan:can0?fd=1"), "can0");
  EXPECT_EQ(interface_of("udp:239.74.163.2:43113"), "");
}

}  // namespace
}  // namespace sprung
