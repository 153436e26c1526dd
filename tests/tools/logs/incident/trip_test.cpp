#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/tools/logs/log/robot_sample.h"
#include "tools/logs/incident/log_stretch.h"
#include "tools/logs/log/log_info.h"

namespace sprung::log {
namespace {

using testing::HasSubstr;

class TripTest : public testing::Test {
 protected:
  std::optional<Trip> trip_of(const std::vector<Kept>& events) {
    const LogFolder folder;
    write_all(folder("robot.lcm"), events);
    Reader reader(folder("robot.lcm"));
    return last_trip(collect_info(reader).incidents);
  }
  const Kept well_ = safety_event(1, "operational", "none", "");
};

TEST_F(TripTest, WhatBeganItIsTheCauseAndWhatFollowedIsTold) {
  const auto trip = trip_of({well_, safety_event(500, "damping", "drive silent", "node 3 is silent"),
                             safety_event(600, "disabled", "drive silent", "node 3 is silent")});
  ASSERT_TRUE(trip);
  EXPECT_EQ(trip_text(trip, "a.lcm"),
            "cause: safety damping, drive silent: node 3 is silent, at 0.998 s (cycle 500) of a.lcm\n"
            "then:  safety disabled, drive silent: node 3 is silent, at 1.198 s (cycle 600) of a.lcm\n");
}

TEST_F(TripTest, TheNewestCounts) {
  const auto trip = trip_of({well_, safety_event(5, "disabled", "emergency stop", ""),
                             safety_event(7, "operational", "none", ""),
                             safety_event(9, "quick stop", "bus lost", "")});
  ASSERT_TRUE(trip);
  EXPECT_EQ(trip->first.text, "safety quick stop, bus lost");
  EXPECT_FALSE(trip->from_before);
}

TEST_F(TripTest, ThatItBeganBeforeTheLogIsSaid) {
  const auto trip = trip_of({safety_event(5, "disabled", "emergency stop", "")});
  ASSERT_TRUE(trip);
  EXPECT_TRUE(trip->from_before);
  EXPECT_THAT(trip_text(trip, "a.lcm"), HasSubstr("it was there when the log began"));
}

TEST_F(TripTest, AStartAnOrderlyEndAndACommandThatCameBackAreNone) {
  const auto trip = trip_of({safety_event(0, "disabled", "starting", ""), well_,
                             safety_event(5, "operational", "command stale", "was damped until cycle 4"),
                             safety_event(9, "quick stop", "shutdown", "")});
  EXPECT_FALSE(trip);
  EXPECT_EQ(trip_text(trip, "a.lcm"), "cause: none found, safety stopped nothing in a.lcm\n");
}

}  // namespace
}  // namespace sprung::log
