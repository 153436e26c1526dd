#include "drivers/canopen/emergency.h"

#include <gtest/gtest.h>

#include <cstring>
#include <set>
#include <string>

namespace sprung::canopen {
namespace {

struct EmergencyRow {
  int code;
  const char* text;
};

// Typed by hand from facts canopen 2.5.
const EmergencyRow kEpos2[] = {
    {0x0000, "no error"},
    {0x1000, "generic error"},
    {0x2310, "over-current"},
    {0x3210, "supply over-voltage"},
    {0x3220, "supply under-voltage"},
    {0x4210, "over-temperature"},
    {0x5113, "logic supply low"},
    {0x5114, "output-stage supply low"},
    {0x6100, "internal software error"},
    {0x6320, "parameter error"},
    {0x7320, "position sensor"},
    {0x8110, "CAN overrun, objects lost"},
    {0x8111, "CAN overrun"},
    {0x8120, "CAN error passive"},
    {0x8130, "life guard or heartbeat lost"},
    {0x8150, "transmit identifier collision"},
    {0x81FD, "bus off"},
    {0x81FE, "CAN receive queue overrun"},
    {0x81FF, "CAN transmit queue overrun"},
    {0x8210, "PDO too short"},
    {0x8611, "following error"},
    {0xFF01, "Hall sensor"},
    {0xFF02, "encoder index"},
    {0xFF03, "encoder resolution"},
    {0xFF04, "Hall sensor not found"},
    {0xFF06, "negative limit"},
    {0xFF07, "positive limit"},
    {0xFF08, "Hall angle detection"},
    {0xFF09, "software position limit"},
    {0xFF0A, "position sensor breach"},
    {0xFF0B, "system overloaded"},
    {0xFF0C, "interpolated position mode"},
    {0xFF0D, "auto-tuning identification"},
    {0xFF0F, "gear scaling"},
    {0xFF10, "controller gain"},
    {0xFF11, "main sensor direction"},
    {0xFF12, "auxiliary sensor direction"},
};

// CiA 301 table 21.
const EmergencyRow kClasses[] = {
    {0x1001, "generic error"},
    {0x2010, "current"},
    {0x2110, "current, input side"},
    {0x2210, "current, inside"},
    {0x2320, "current, output side"},
    {0x3010, "voltage"},
    {0x3110, "mains voltage"},
    {0x3230, "voltage, inside"},
    {0x3310, "voltage, output side"},
    {0x4010, "temperature"},
    {0x4110, "ambient temperature"},
    {0x4220, "device temperature"},
    {0x4310, "temperature"},
    {0x5010, "device hardware"},
    {0x6010, "device software"},
    {0x6110, "internal software"},
    {0x6210, "user software"},
    {0x6310, "data set"},
    {0x7010, "additional modules"},
    {0x8010, "monitoring"},
    {0x8100, "communication"},
    {0x8140, "recovered from bus off"},
    {0x8220, "protocol error"},
    {0x9000, "external"},
    {0xA000, "reserved"},
    {0xF001, "additional functions"},
    {0xFF20, "device specific"},
};

TEST(EmergencyText, EveryCodeOfTheFactsHasItsOwnText) {
  std::set<std::string> texts;
  for (const EmergencyRow& row : kEpos2) {
    const char* text = emergency_text(static_cast<std::uint16_t>(row.code));
    EXPECT_STREQ(text, row.text) << std::hex << row.code;
    EXPECT_TRUE(texts.insert(text).second) << text;
  }
}

TEST(EmergencyText, OtherCodesHaveTheTextOfTheirClass) {
  for (const EmergencyRow& row : kClasses) {
    EXPECT_STREQ(emergency_text(static_cast<std::uint16_t>(row.code)), row.text) << std::hex << row.code;
  }
}

TEST(EmergencyText, NoCodeIsWithoutText) {
  for (int code = 0; code <= 0xFFFF; ++code)
    ASSERT_GT(std::strlen(emergency_text(static_cast<std::uint16_t>(code))), 3U) << std::hex << code;
}

TEST(Emergency, HasItsBytesAndSurvivesTheWire) {
  const CanFrame frame = emergency_frame(2, {0x8130, 0x11, {1, 2, 3, 4, 5}});
  EXPECT_EQ(frame.id, 0x82U);
  EXPECT_EQ(frame.length, 8);
  EXPECT_EQ(frame.data, (std::array<std::uint8_t, 8>{0x30, 0x81, 0x11, 1, 2, 3, 4, 5}));
  Emergency found;
  ASSERT_TRUE(decode_emergency(frame, found));
  EXPECT_EQ(found.code, 0x8130);
  EXPECT_EQ(found.error_register, 0x11);
  EXPECT_EQ(found.maker, (std::array<std::uint8_t, 5>{1, 2, 3, 4, 5}));
}

TEST(Emergency, ShortAndRemoteFramesAreNone) {
  Emergency found;
  CanFrame frame = emergency_frame(2, {0x8130, 0x11});
  frame.length = 7;
  EXPECT_FALSE(decode_emergency(frame, found));
  frame.length = 8;
  frame.remote = true;
  EXPECT_FALSE(decode_emergency(frame, found));
}

// Facts canopen 1.3.
TEST(ErrorRegister, BitsHaveNames) {
  const char* names[] = {"generic",       "current",        "voltage",  "temperature",
                         "communication", "device profile", "reserved", "manufacturer"};
  for (int bit = 0; bit < 8; ++bit) {
    EXPECT_STREQ(error_register_text(static_cast<std::uint8_t>(1 << bit)).data(), names[bit]);
  }
}

TEST(ErrorRegister, TextNamesAllBitsAndAlwaysFits) {
  EXPECT_STREQ(error_register_text(0).data(), "none");
  EXPECT_STREQ(error_register_text(kErrorGeneric | kErrorCommunication).data(), "generic, communication");
  EXPECT_STREQ(
      error_register_text(0xFF).data(),
      "generic, current, voltage, temperature, communication, device profile, reserved, manufacturer");
}

TEST(ErrorHistory, EntryHoldsTheCodeBelowAndTheMakersWordAbove) {
  EXPECT_EQ(encode_history_entry(0x8130), 0x00008130U);
  EXPECT_EQ(encode_history_entry(0x2310, 0xABCD), 0xABCD2310U);
  EXPECT_EQ(history_code(0xABCD2310), 0x2310);
}

}  // namespace
}  // namespace sprung::canopen
