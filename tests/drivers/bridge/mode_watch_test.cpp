#include "drivers/bridge/mode_watch.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

TEST(ModeWatch, CountsHowLongAModeIsNotConfirmed) {
  ModeWatch watch;
  watch.begin_operation(8, 10'000);
  watch.send(DriveMode::kTorque, false, 11'000);
  watch.send(DriveMode::kTorque, false, 12'000);
  EXPECT_EQ(watch.unconfirmed_us(), 2'000);
  EXPECT_EQ(watch.sent(), DriveMode::kTorque);
  watch.send(DriveMode::kTorque, true, 13'000);
  EXPECT_EQ(watch.unconfirmed_us(), 0);
  watch.send(DriveMode::kPosition, false, 14'000);
  EXPECT_EQ(watch.unconfirmed_us(), 1'000);
  EXPECT_EQ(watch.sent(), DriveMode::kPosition);
}

TEST(ModeWatch, WhatTheDriveTellsOutranksWhatWasReadWhileBooting) {
  ModeWatch watch;
  watch.begin_operation(8, 0);
  EXPECT_EQ(watch.display(), 8);
  watch.restart();
  watch.take_display(10);
  watch.begin_operation(8, 0);
  EXPECT_EQ(watch.display(), 10);
  watch.restart();
  watch.begin_operation(8, 0);
  EXPECT_EQ(watch.display(), 8) << "told before it was restarted";
  watch.read_display(9);
  EXPECT_EQ(watch.display(), 9);
}

TEST(ModeWatch, ARestartedDriveHasNothingToConfirm) {
  ModeWatch watch;
  watch.begin_operation(8, 0);
  watch.send(DriveMode::kTorque, false, 2'000'000);
  watch.restart();
  EXPECT_EQ(watch.unconfirmed_us(), 0);
}

}  // namespace
}  // namespace sprung
