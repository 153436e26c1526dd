/// Devices need hardware; what one has said stands in a file.
#include <gtest/gtest.h>
#include <linux/input.h>

#include <fstream>

#include "tests/support/own_folder.h"
#include "tools/station/server/gamepad_device_shell.h"

namespace sprung::station {
namespace {

class RecordedGamepad : public testing::Test {
 protected:
  void record(std::int64_t time_us, std::uint16_t type, std::uint16_t code, std::int32_t value) {
    input_event event{};
    event.input_event_sec = time_us / 1'000'000;
    event.input_event_usec = time_us % 1'000'000;
    event.type = type;
    event.code = code;
    event.value = value;
    std::ofstream(file_, std::ios::app | std::ios::binary)
        .write(reinterpret_cast<const char*>(&event), sizeof event);
  }
  const test::OwnFolder folder_{"gamepad"};
  const std::string file_ = folder_.path() / "events";
};

TEST_F(RecordedGamepad, IsPlayedInItsOwnTimeAndIsGoneAtItsEnd) {
  record(1'700'000'000'000'000, EV_KEY, BTN_TL, 1);
  record(1'700'000'000'500'000, EV_ABS, ABS_Y, -32768);
  GamepadDevice device(file_);
  Gamepad pad;
  EXPECT_TRUE(device.read(pad, 10));
  EXPECT_TRUE(pad.input().dead_man);
  EXPECT_TRUE(device.read(pad, 500'009));
  EXPECT_EQ(pad.input().sticks.forward, 0.0);
  EXPECT_FALSE(device.read(pad, 500'010)) << "the file is at its end";
  EXPECT_DOUBLE_EQ(pad.input().sticks.forward, 1.0);
}

TEST_F(RecordedGamepad, AFileThatIsCutOffEndsThere) {
  std::ofstream(file_, std::ios::binary) << "short";
  GamepadDevice device(file_);
  Gamepad pad;
  EXPECT_FALSE(device.read(pad, 0));
}

TEST(GamepadDevice, WhatIsNoneIsNamed) {
  EXPECT_THROW(GamepadDevice("/nowhere/event7"), std::runtime_error);
  EXPECT_THROW(GamepadDevice("/dev/null"), std::runtime_error);
}

}  // namespace
}  // namespace sprung::station
