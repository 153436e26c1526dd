#include "robots/file_version.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(FileVersion, SameMinorVersionIsRead) {
  EXPECT_EQ(why_not_readable("0.1", "0.1.0"), "");
  EXPECT_EQ(why_not_readable("0.1.7", "0.1.0"), "");
  EXPECT_EQ(why_not_readable("0.1", "0.10.2"), "");
}

TEST(FileVersion, NewerIsRefusedWithBothVersionsAndARemedy) {
  EXPECT_THAT(why_not_readable("0.2", "0.1.9"),
              AllOf(HasSubstr("written for sprung 0.2"), HasSubstr("0.1.9"), HasSubstr("install")));
  EXPECT_NE(why_not_readable("0.10", "0.9.0"), "");  // minor versions are numbers, not decimals
  EXPECT_NE(why_not_readable("1.0", "0.9.0"), "");
}

TEST(FileVersion, OlderThanTheOldestIsRefused) {
  EXPECT_THAT(why_not_readable("0.0", "0.1.0"), HasSubstr("0.1 and later"));
}

TEST(FileVersion, WhatIsNoVersionIsRefused) {
  for (const char* text : {"", "1", "one", "0.1-beta", "0,1", "~"})
    EXPECT_THAT(why_not_readable(text, "0.1.0"), HasSubstr("expected a version")) << text;
}

TEST(FileVersion, TheFileIsReadUpToItsLine) {
  try {
    (void)read_robot_text("robot: x\nsprung: 99.0\n", "my/robot.yaml");
    ADD_FAILURE() << "a file of a later version was read";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), AllOf(HasSubstr("my/robot.yaml:2: key 'sprung'"), HasSubstr("99.0")));
  }
}

TEST(FileVersion, AFileOfThisVersionGoesOn) {
  try {
    (void)read_robot_text("sprung: 0.1\nrobot: x\n", "robot.yaml");
    ADD_FAILURE() << "half a robot was read";
  } catch (const ConfigError& error) {
    EXPECT_THAT(error.what(), HasSubstr("cycle_rate"));
  }
}

}  // namespace
}  // namespace sprung
