#include "tools/station/server/gamepad.h"

#include <gtest/gtest.h>

namespace sprung::station {
namespace {

constexpr std::uint16_t kSync = 0, kKey = 1, kAbsolute = 3;

TEST(Gamepad, SticksAreForwardLeftAndCounterClockwise) {
  Gamepad pad;
  pad.take({kAbsolute, 0x01, -32768});  // pushed away
  pad.take({kAbsolute, 0x00, -32768});  // to the left
  pad.take({kAbsolute, 0x03, 32767});   // right stick to the right
  EXPECT_DOUBLE_EQ(pad.input().sticks.forward, 1.0);
  EXPECT_DOUBLE_EQ(pad.input().sticks.left, 1.0);
  EXPECT_DOUBLE_EQ(pad.input().sticks.turning, -1.0);
}

TEST(Gamepad, RangesAreTheDevicesOwn) {
  Gamepad pad;
  pad.set_range(Gamepad::kForward, {0, 255});
  pad.take({kAbsolute, 0x01, 0});
  EXPECT_DOUBLE_EQ(pad.input().sticks.forward, 1.0);
  pad.take({kAbsolute, 0x01, 999});
  EXPECT_DOUBLE_EQ(pad.input().sticks.forward, -1.0) << "never beyond";
  pad.set_range(Gamepad::kForward, {7, 7});
  pad.take({kAbsolute, 0x01, 7});
  EXPECT_EQ(pad.input().sticks.forward, 0.0);
}

TEST(Gamepad, EitherShoulderButtonIsTheDeadMan) {
  Gamepad pad;
  EXPECT_FALSE(pad.input().dead_man);
  pad.take({kKey, 0x136, 1});
  pad.take({kKey, 0x137, 1});
  pad.take({kKey, 0x136, 0});
  EXPECT_TRUE(pad.input().dead_man);
  pad.take({kKey, 0x137, 0});
  EXPECT_FALSE(pad.input().dead_man);
}

TEST(Gamepad, ThePressOfTheButtonThatStopsIsToldOnce) {
  Gamepad pad;
  pad.take({kKey, 0x131, 1});
  pad.take({kKey, 0x131, 0});
  EXPECT_TRUE(pad.take_stop());
  EXPECT_FALSE(pad.take_stop());
}

TEST(Gamepad, WhereEventsWereLostNothingIsHeldUntilAllIsReadAnew) {
  Gamepad pad;
  pad.take({kKey, 0x136, 1});
  pad.take({kSync, 3, 0});
  EXPECT_TRUE(pad.lost_events());
  EXPECT_FALSE(pad.input().dead_man);
  pad.take({kKey, 0x136, 1});
  pad.read_anew();
  EXPECT_TRUE(pad.input().dead_man);
}

}  // namespace
}  // namespace sprung::station
