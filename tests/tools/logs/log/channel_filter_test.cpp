#include "tools/logs/log/channel_filter.h"

#include <gtest/gtest.h>

#include <stdexcept>

namespace sprung::log {
namespace {

TEST(ChannelFilter, NoPatternKeepsEverything) {
  ChannelFilter filter({});
  EXPECT_TRUE(filter.keeps("DRIVE_STATE"));
  EXPECT_TRUE(filter.keeps(""));
}

TEST(ChannelFilter, ANameIsThatNameAlone) {
  ChannelFilter filter({"IMU"});
  EXPECT_TRUE(filter.keeps("IMU"));
  EXPECT_FALSE(filter.keeps("IMU2"));
  EXPECT_FALSE(filter.keeps("MY_IMU"));
}

TEST(ChannelFilter, StarsAndQuestionMarksStandForLetters) {
  ChannelFilter filter({"DRIVE_*", "?MU"});
  EXPECT_TRUE(filter.keeps("DRIVE_STATE"));
  EXPECT_TRUE(filter.keeps("DRIVE_"));
  EXPECT_TRUE(filter.keeps("IMU"));
  EXPECT_FALSE(filter.keeps("XIMU"));
  EXPECT_FALSE(filter.keeps("A_DRIVE_STATE"));
}

TEST(ChannelFilter, EveryOtherLetterOfAGlobStandsForItself) {
  ChannelFilter filter({"A.B", "C+(D)"});
  EXPECT_TRUE(filter.keeps("A.B"));
  EXPECT_FALSE(filter.keeps("AxB"));
  EXPECT_TRUE(filter.keeps("C+(D)"));
  EXPECT_FALSE(filter.keeps("CCD"));
}

TEST(ChannelFilter, SlashesMakeARegularExpressionOnTheWholeName) {
  ChannelFilter filter({"/IMU|DRIVE_(STATE|COMMAND)/"});
  EXPECT_TRUE(filter.keeps("DRIVE_COMMAND"));
  EXPECT_TRUE(filter.keeps("IMU"));
  EXPECT_FALSE(filter.keeps("DRIVE_STATES"));
}

TEST(ChannelFilter, DropWinsOverKeep) {
  ChannelFilter filter({"DRIVE_*"}, {"*COMMAND"});
  EXPECT_TRUE(filter.keeps("DRIVE_STATE"));
  EXPECT_FALSE(filter.keeps("DRIVE_COMMAND"));
  EXPECT_FALSE(filter.keeps("DRIVE_COMMAND"));  // the second time as the first
  ChannelFilter drop_only({}, {"CAN_TRACE"});
  EXPECT_TRUE(drop_only.keeps("IMU"));
  EXPECT_FALSE(drop_only.keeps("CAN_TRACE"));
}

TEST(ChannelFilter, ARegularExpressionThatIsNoneIsNamed) {
  try {
    ChannelFilter filter({"/DRIVE_(/"});
    FAIL();
  } catch (const std::invalid_argument& error) {
    EXPECT_NE(std::string(error.what()).find("'DRIVE_(' is no regular expression"), std::string::npos);
  }
}

}  // namespace
}  // namespace sprung::log
