#include "drivers/can/send_confirmations.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

CanFrame frame(std::uint32_t id, std::uint8_t first = 0) {
  CanFrame made;
  made.id = id;
  made.length = 1;
  made.data[0] = first;
  return made;
}

TEST(SendConfirmations, GivesTheTimeFromSendingToTheBus) {
  SendConfirmations confirmations;
  confirmations.sent(frame(0x80), 1000);
  confirmations.sent(frame(0x201), 1001);
  EXPECT_EQ(confirmations.confirmed(frame(0x80), 1056), 56);
  EXPECT_EQ(confirmations.confirmed(frame(0x201), 1167), 166);
  EXPECT_EQ(confirmations.awaited(), 0u);
  EXPECT_EQ(confirmations.unconfirmed(), 0);
}

TEST(SendConfirmations, SameFrameTwiceIsConfirmedInOrder) {
  SendConfirmations confirmations;
  confirmations.sent(frame(0x80), 1000);
  confirmations.sent(frame(0x80), 2000);
  EXPECT_EQ(confirmations.confirmed(frame(0x80), 2001), 1001);
  EXPECT_EQ(confirmations.confirmed(frame(0x80), 2001), 1);
}

TEST(SendConfirmations, ControllerMaySendByPriority) {
  SendConfirmations confirmations;
  confirmations.sent(frame(0x301), 0);
  confirmations.sent(frame(0x80), 10);
  EXPECT_EQ(confirmations.confirmed(frame(0x80), 60), 50);
  EXPECT_EQ(confirmations.confirmed(frame(0x301), 170), 170);
}

TEST(SendConfirmations, UnknownFrameIsNotPaired) {
  SendConfirmations confirmations;
  confirmations.sent(frame(0x201, 1), 0);
  EXPECT_EQ(confirmations.confirmed(frame(0x201, 2), 5), SendConfirmations::kUnknown) << "other data";
  EXPECT_EQ(confirmations.awaited(), 1u);
}

TEST(SendConfirmations, FramesOfALinkThatWentDownAreForgotten) {
  SendConfirmations confirmations;
  confirmations.sent(frame(0x80), 0);
  confirmations.forget();
  confirmations.sent(frame(0x80), 1'000'000);
  EXPECT_EQ(confirmations.confirmed(frame(0x80), 1'000'055), 55)
      << "not paired with the one of a second before";
  EXPECT_EQ(confirmations.unconfirmed(), 1);
}

TEST(SendConfirmations, WhatIsNeverConfirmedIsGivenUpOldestFirst) {
  SendConfirmations confirmations;
  const auto count = static_cast<std::int64_t>(SendConfirmations::kCapacity) + 3;
  for (std::int64_t i = 0; i < count; ++i) confirmations.sent(frame(static_cast<std::uint32_t>(i)), i);
  EXPECT_EQ(confirmations.unconfirmed(), 3);
  EXPECT_EQ(confirmations.awaited(), SendConfirmations::kCapacity);
  EXPECT_EQ(confirmations.confirmed(frame(2), count), SendConfirmations::kUnknown);
  EXPECT_EQ(confirmations.confirmed(frame(3), count), count - 3);
}

TEST(SendConfirmations, LongRunsNeedNoMoreRoom) {
  SendConfirmations confirmations;
  for (std::int64_t i = 0; i < 10'000; ++i) {
    confirmations.sent(frame(0x301, static_cast<std::uint8_t>(i)), i);
    confirmations.sent(frame(0x80, static_cast<std::uint8_t>(i)), i);
    ASSERT_EQ(confirmations.confirmed(frame(0x80, static_cast<std::uint8_t>(i)), i + 1), 1);
    ASSERT_EQ(confirmations.confirmed(frame(0x301, static_cast<std::uint8_t>(i)), i + 2), 2);
  }
  EXPECT_EQ(confirmations.unconfirmed(), 0);
}

}  // namespace
}  // namespace sprung
