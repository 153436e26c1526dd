#include "tools/operate/client/jump_heights.h"

#include <gmock/gmock.h>

#include "signals/vec3.h"

namespace sprung {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

sprung_msgs::motion_state_t done(int jumps, double height_m) {
  sprung_msgs::motion_state_t motion{};
  motion.jumps_done = jumps;
  motion.estimated_jump_height_m = height_m;
  return motion;
}

TEST(JumpHeights, EachJumpThatLandsIsToldOnceWithWhatItRestsOn) {
  JumpHeights heights(0.0);
  EXPECT_THAT(heights.add(done(0, kNaN)), IsEmpty());
  EXPECT_THAT(heights.add(done(0, 0.1862)), IsEmpty()) << "in its landing";
  EXPECT_THAT(heights.add(done(1, 0.1862)),
              ElementsAre("jump 1: 186 mm high, estimated from flight time and leg lengths"));
  EXPECT_THAT(heights.add(done(1, 0.1862)), IsEmpty());
  EXPECT_THAT(heights.add(done(1, kNaN)), IsEmpty()) << "the next thrust";
  EXPECT_THAT(heights.add(done(2, 0.1849)),
              ElementsAre("jump 2: 185 mm high, estimated from flight time and leg lengths"));
}

TEST(JumpHeights, WhatWasAskedStandsBeside) {
  JumpHeights heights(0.15);
  heights.add(done(0, kNaN));
  EXPECT_THAT(heights.add(done(1, 0.143)),
              ElementsAre("jump 1: 143 mm high (asked 150 mm), estimated from flight time and leg lengths"));
}

TEST(JumpHeights, JumpsOfTheRequestBeforeAreNotToldAgain) {
  JumpHeights heights(0.0);
  EXPECT_THAT(heights.add(done(3, 0.186)), IsEmpty());
  EXPECT_THAT(heights.add(done(0, 0.186)), IsEmpty()) << "the new request begins to count";
  EXPECT_THAT(heights.add(done(1, 0.170)),
              ElementsAre("jump 1: 170 mm high, estimated from flight time and leg lengths"));
}

TEST(JumpHeights, HeightThatWasNotMeasuredOrNotHeardIsNotMadeUp) {
  JumpHeights heights(0.0);
  heights.add(done(0, kNaN));
  EXPECT_THAT(heights.add(done(1, kNaN)),
              ElementsAre("jump 1: height unknown: lift-off or touchdown was not measured"));
  EXPECT_THAT(heights.add(done(3, 0.186)),
              ElementsAre("jump 2: height not heard, its message was lost on the way",
                          "jump 3: 186 mm high, estimated from flight time and leg lengths"));
}

}  // namespace
}  // namespace sprung
