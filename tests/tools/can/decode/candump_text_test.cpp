#include "tools/can/decode/candump_text.h"

#include <gtest/gtest.h>

#include <random>

namespace sprung::cantools {
namespace {

struct Parsed {
  CandumpLine kind;
  std::string interface;
  ObservedFrame frame;
};

Parsed parse(const std::string& line) {
  Parsed parsed{};
  parsed.kind = parse_candump(line, parsed.interface, parsed.frame);
  return parsed;
}

TEST(CandumpText, LogLine) {
  const Parsed parsed = parse("(1436509052.249713) can0 044#2A366C2B");
  EXPECT_EQ(parsed.kind, CandumpLine::kFrame);
  EXPECT_EQ(parsed.interface, "can0");
  EXPECT_EQ(parsed.frame.time_us, 1436509052249713);
  EXPECT_EQ(parsed.frame.frame.id, 0x44u);
  EXPECT_EQ(parsed.frame.frame.length, 4);
  EXPECT_EQ(parsed.frame.frame.data[3], 0x2B);
  EXPECT_EQ(parsed.frame.direction, Direction::kUnknown);
}

TEST(CandumpText, RemoteRequestsErrorFramesAndDirections) {
  EXPECT_TRUE(parse("(1.000000) can0 701#R").frame.frame.remote);
  EXPECT_EQ(parse("(1.000000) can0 701#R1").frame.frame.length, 1);
  const Parsed error = parse("(1.000000) can0 20000040#0000000000000000");
  EXPECT_EQ(error.kind, CandumpLine::kFrame);
  EXPECT_TRUE(error.frame.frame.error);
  EXPECT_EQ(error.frame.frame.id, 0x40u);
  EXPECT_EQ(parse("(1.000000) can0 080# T").frame.direction, Direction::kSent);
  EXPECT_EQ(parse("(1.000000) can0 080# R").frame.direction, Direction::kReceived);
}

TEST(CandumpText, PlainFormatWithAndWithoutTime) {
  const Parsed timed = parse(" (000.000123)  can1  181   [3]  01 02 FF");
  EXPECT_EQ(timed.kind, CandumpLine::kFrame);
  EXPECT_EQ(timed.frame.time_us, 123);
  EXPECT_EQ(timed.frame.frame.length, 3);
  EXPECT_EQ(timed.frame.frame.data[2], 0xFF);
  EXPECT_EQ(parse("  can0  080   [0]").kind, CandumpLine::kFrame);
  EXPECT_TRUE(parse("  can0  701   [1]  remote request").frame.frame.remote);
  EXPECT_EQ(parse("  can0  TX - -  181   [1]  05").frame.direction, Direction::kSent);
}

/// Found by fuzzing: the time in microseconds overflowed.
TEST(CandumpText, TimesThatCannotBeAreBroken) {
  EXPECT_EQ(parse("(14365444409052.249713) can0 044#2A").kind, CandumpLine::kBroken);
  EXPECT_EQ(parse("(9223372036854775807.999999) can0 044#2A").kind, CandumpLine::kBroken);
  EXPECT_EQ(parse("(-5.000001) can0 044#2A").kind, CandumpLine::kBroken);
  EXPECT_EQ(parse("(5.-00001) can0 044#2A").kind, CandumpLine::kBroken);
  EXPECT_EQ(parse("(9000000000000.999999) can0 044#2A").frame.time_us, 9'000'000'000'000'999'999);
}

TEST(CandumpText, ForeignFramesAreToldApart) {
  EXPECT_EQ(parse("(1.000000) can0 12345678#00").kind, CandumpLine::kForeign);
  EXPECT_EQ(parse("(1.000000) can0 123##10011").kind, CandumpLine::kForeign);
  EXPECT_EQ(parse("  can0  12345678   [1]  00").kind, CandumpLine::kForeign);
}

TEST(CandumpText, BrokenLinesAreRefused) {
  for (const char* line :
       {"(x.000000) can0 044#00", "(1.000000) can0 044#0", "(1.000000) can0 04G#00", "(1.000000) can0 044#R9",
        "(1.000000) can0", "(1.000000) can0 044#00 X", "  can0 044 [2] 01", "  can0 044 4 01", "hello",
        "(1.000000) can0 044#00 T more"}) {
    const CandumpLine kind = parse(line).kind;
    EXPECT_EQ(kind, CandumpLine::kBroken) << line;
  }
  EXPECT_EQ(parse("").kind, CandumpLine::kNothing);
}

TEST(CandumpText, WhatIsWrittenIsReadBack) {
  std::mt19937 random(7);
  for (int i = 0; i < 2000; ++i) {
    ObservedFrame frame;
    frame.time_us = static_cast<std::int64_t>(random()) * 1000 + i;
    frame.direction = static_cast<Direction>(random() % 3);
    frame.frame.error = random() % 8 == 0;
    frame.frame.remote = !frame.frame.error && random() % 8 == 0;
    frame.frame.id = random() % 0x800;
    frame.frame.length = static_cast<std::uint8_t>(random() % 9);
    for (int b = 0; b < frame.frame.length && !frame.frame.remote; ++b)
      frame.frame.data[b] = static_cast<std::uint8_t>(random());
    const std::string line = candump_line(frame, "leg", frame.time_us);
    const Parsed parsed = parse(line);
    ASSERT_EQ(parsed.kind, CandumpLine::kFrame) << line;
    EXPECT_EQ(parsed.frame.frame, frame.frame) << line;
    EXPECT_EQ(parsed.frame.time_us, frame.time_us) << line;
    EXPECT_EQ(parsed.frame.direction, frame.direction) << line;
    EXPECT_EQ(parsed.interface, "leg");
  }
}

TEST(CandumpText, LineIsThatOfCandump) {
  ObservedFrame frame;
  frame.frame.id = 0x81;
  frame.frame.length = 2;
  frame.frame.data = {0x30, 0x81};
  EXPECT_EQ(candump_line(frame, "can0", 1'000'000'012'345'678), "(1000000012.345678) can0 081#3081");
}

TEST(CandumpText, FdFramesAreWrittenAsCandumpDoes) {
  ObservedFdFrame observed;
  observed.frame.id = 0x123;
  observed.frame.length = 12;
  observed.frame.fast = true;
  observed.frame.data[0] = 0xDE;
  const std::string line = candump_fd_line(observed, "can0", 1'700'000'000'000'123);
  EXPECT_EQ(line, "(1700000000.000123) can0 123##1DE0000000000000000000000");
  std::string interface;
  ObservedFrame classic;
  EXPECT_EQ(parse_candump(line, interface, classic), CandumpLine::kForeign);
  observed.frame.extended = true;
  observed.frame.passive = true;
  EXPECT_EQ(candump_fd_line(observed, "can0", 0).substr(20, 18), "can0 00000123##3DE");
}

}  // namespace
}  // namespace sprung::cantools
