#include <gtest/gtest.h>

#include <stdexcept>

#include "tools/logs/replay/lcm_replay.h"

namespace sprung {
namespace {

TEST(ReplayPace, KeepsTheDistancesOfTheLog) {
  ReplayPace pace(1.0);
  EXPECT_EQ(pace.due_us(10.0, 5'000'000), 5'000'000);
  EXPECT_EQ(pace.due_us(10.5, 5'000'100), 5'500'000);
  EXPECT_EQ(pace.due_us(11.0, 9'000'000), 6'000'000);  // late already: no distance is added for it
}

TEST(ReplayPace, SpeedShortensThem) {
  ReplayPace pace(4.0);
  EXPECT_EQ(pace.due_us(0.0, 0), 0);
  EXPECT_EQ(pace.due_us(2.0, 0), 500'000);
}

TEST(ReplayPace, NoSpeedIsAtOnce) {
  ReplayPace pace(0.0);
  EXPECT_EQ(pace.due_us(0.0, 7), 7);
  EXPECT_EQ(pace.due_us(100.0, 8), 8);
}

TEST(ReplayPace, BeginsAgainWhereItIs) {
  ReplayPace pace(1.0);
  pace.due_us(0.0, 0);
  pace.begin_again();
  EXPECT_EQ(pace.due_us(0.0, 3'000'000), 3'000'000);
  EXPECT_EQ(pace.due_us(1.0, 3'000'000), 4'000'000);
}

TEST(ReplayPace, EventThatLiesBackInTimeIsDueEarlier) {
  ReplayPace pace(1.0);
  pace.due_us(1.0, 1'000'000);
  EXPECT_LT(pace.due_us(0.9, 1'000'000), 1'000'000);
}

TEST(ChannelNames, OthersKeepTheirs) {
  ChannelNames names({"IMU=IMU_OLD"});
  EXPECT_STREQ(names.of("IMU"), "IMU_OLD");
  EXPECT_STREQ(names.of("JOINT_STATE"), "JOINT_STATE");
}

TEST(ChannelNames, ThoseThatNobodyAskedForAreKnown) {
  ChannelNames names({"IMU=A", "IMO=B"});
  (void)names.of("IMU");
  EXPECT_EQ(names.unused(), std::vector<std::string>{"IMO"});
}

TEST(ChannelNames, BadTextsAreRefused) {
  for (const char* text : {"IMU", "=X", "IMU=", ""})
    EXPECT_THROW(ChannelNames({text}), std::invalid_argument) << text;
  EXPECT_THROW(ChannelNames({"A=B", "A=C"}), std::invalid_argument);
}

}  // namespace
}  // namespace sprung
