#include "tools/operate/launcher/log_lines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

TEST(LineSplitter, LinesComeWholeHoweverTheBytesCome) {
  LineSplitter splitter;
  EXPECT_THAT(splitter.add("on"), IsEmpty());
  EXPECT_THAT(splitter.add("e\ntwo\n\nth"), ElementsAre("one", "two", ""));
  EXPECT_THAT(splitter.add("ree\n"), ElementsAre("three"));
  EXPECT_EQ(splitter.rest(), "");
}

TEST(LineSplitter, WhatHasNoEndIsTheRest) {
  LineSplitter splitter;
  EXPECT_THAT(splitter.add("last words"), IsEmpty());
  EXPECT_EQ(splitter.rest(), "last words");
  EXPECT_EQ(splitter.rest(), "");
}

TEST(LineSplitter, LineWithoutEndIsCutAndNothingIsLost) {
  LineSplitter splitter;
  const auto lines = splitter.add(std::string(2 * LineSplitter::kLongest + 7, 'x'));
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0].size(), LineSplitter::kLongest);
  EXPECT_EQ(splitter.rest().size(), 7u);
}

TEST(Dated, LineOfTheLogStaysAsItIs) {
  const std::string text = "2026-11-21T20:01:25.123456 info sprung-can-bridge: drives operational";
  EXPECT_EQ(dated({0, "sprung-can-bridge", text}), text);
}

TEST(Dated, OtherLinesGetTimeAndProgram) {
  EXPECT_EQ(dated({1'000'000'000'000'042, "lcm-logger", "disk full"}),
            "2001-09-09T01:46:40.000042 lcm-logger: disk full");
  EXPECT_EQ(dated({0, "x", "2026-11-21 noon"}), "1970-01-01T00:00:00.000000 x: 2026-11-21 noon");
}

TEST(LogLines, KeepsTheNewest) {
  LogLines lines(2);
  for (const char* text : {"a", "b", "c"}) lines.add({0, "p", text});
  ASSERT_EQ(lines.lines().size(), 2u);
  EXPECT_EQ(lines.lines().front().text, "b");
  EXPECT_EQ(lines.lines().back().text, "c");
}

}  // namespace
}  // namespace sprung
