#include "tools/can/decode/word_texts.h"

#include <gtest/gtest.h>

namespace sprung::cantools {
namespace {

CanFrame error_frame(std::uint32_t classes, std::uint8_t details = 0) {
  CanFrame frame;
  frame.id = classes;
  frame.length = 8;
  frame.error = true;
  frame.data[1] = details;
  frame.data[6] = 97;
  frame.data[7] = 3;
  return frame;
}

TEST(WordTexts, EveryControlWordOfTheTable) {
  EXPECT_EQ(control_word_text(0x0006), "shutdown");
  EXPECT_EQ(control_word_text(0x0007), "switch on");
  EXPECT_EQ(control_word_text(0x000F), "enable operation");
  EXPECT_EQ(control_word_text(0x0000), "disable voltage");
  EXPECT_EQ(control_word_text(0x0002), "quick stop");
  EXPECT_EQ(control_word_text(0x0080), "fault reset");
  EXPECT_EQ(control_word_text(0x000E), "shutdown");  // bit 0 clear, as CiA 402's mask has it
}

TEST(WordTexts, StatusWordsOfTheTable) {  // facts canopen 2.2
  EXPECT_EQ(status_word_text(0x0140), "switch on disabled: offset measured");
  EXPECT_EQ(status_word_text(0x0108), "fault: offset measured");
  EXPECT_EQ(status_word_text(0x4123), "switched on: offset measured, refresh cycle");
}

TEST(WordTexts, UnknownModeKeepsItsNumber) {
  EXPECT_EQ(mode_text(10), "cyclic torque");
  EXPECT_EQ(mode_text(-3), "current, maxon");
  EXPECT_EQ(mode_text(42), "mode 42");
}

TEST(WordTexts, ErrorFramesNameClassAndDetail) {
  EXPECT_EQ(error_frame_text(error_frame(0x040)), "bus off");
  EXPECT_EQ(error_frame_text(error_frame(0x004, 0x20)), "controller (transmit passive)");
  EXPECT_EQ(error_frame_text(error_frame(0x204, 0x08)),
            "controller, error counters (transmit warning) (transmit 97, receive 3)");
  EXPECT_EQ(error_frame_text(error_frame(0x101)), "transmit time-out, restarted");
}

TEST(WordTexts, PlainNumbersHaveNoMeaning) {
  EXPECT_EQ(word_meaning({0x6064, 0}, 5), "");
  EXPECT_EQ(word_meaning({0x1A00, 0}, 3), "");
  EXPECT_FALSE(is_code_word({0x1003, 0}));
  EXPECT_TRUE(is_code_word({0x1003, 1}));
}

}  // namespace
}  // namespace sprung::cantools
