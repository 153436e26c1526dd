#include "drivers/profiles/encoder_card/encoder_card_profile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "drivers/canopen/objects.h"

namespace sprung {
namespace {

EncoderCardConfig card() { return {"fl_card", 0, 4, "encoder_card", {}}; }
constexpr DriveTiming kTiming{0.002, 0.005, 0.020};

CanFrame sample_frame(std::uint64_t bits) {
  CanFrame frame;
  frame.id = 0x184;
  frame.length = 8;
  for (std::size_t i = 0; i < 8; ++i) frame.data[i] = static_cast<std::uint8_t>(bits >> (8 * i));
  return frame;
}

TEST(EncoderCardSample, ThreeEncodersAndACounterAreTakenApart) {
  const encoder_card::EncoderCardProfile profile(card(), kTiming);
  CardSample sample;
  ASSERT_TRUE(profile.decode_sample(sample_frame(0xA'CCCCC'00001'FFFFFULL), sample));
  EXPECT_EQ(sample.channels, 3);
  EXPECT_EQ(sample.counts[0], 0xFFFFFU);
  EXPECT_EQ(sample.counts[1], 0x00001U);
  EXPECT_EQ(sample.counts[2], 0xCCCCCU);
  EXPECT_EQ(sample.counter, 0xA);
  EXPECT_EQ(profile.channels(), 3);
  EXPECT_EQ(profile.counter_modulus(), 16);
}

TEST(EncoderCardSample, FramesOfOthersAndShortOnesAreNotTaken) {
  const encoder_card::EncoderCardProfile profile(card(), kTiming);
  CardSample sample;
  CanFrame frame = sample_frame(0);
  frame.length = 7;
  EXPECT_FALSE(profile.decode_sample(frame, sample));
  frame = sample_frame(0);
  frame.id = 0x183;
  EXPECT_FALSE(profile.decode_sample(frame, sample));
}

TEST(EncoderCardSettings, AreItsHeartbeatsAndOnePdoAtEverySync) {
  const encoder_card::EncoderCardProfile profile(card(), kTiming);
  const auto settings = profile.settings();
  ASSERT_EQ(settings.size(), 2U);
  EXPECT_EQ(settings[0].object.index, canopen::kHeartbeatProducer);
  EXPECT_EQ(settings[0].value, 5U);
  EXPECT_EQ(settings[1].value, (127U << 16) | 20U);
  const auto pdos = profile.pdos();
  ASSERT_EQ(pdos.size(), 1U);
  EXPECT_TRUE(pdos[0].transmit);
  EXPECT_EQ(pdos[0].transmission_type, 1);
  ASSERT_EQ(pdos[0].entries.size(), 1U);
  EXPECT_EQ(canopen::encode_map_entry(pdos[0].entries[0]), 0x21000040U);
}

TEST(EncoderCardSettings, HeartbeatsThatDoNotFitAreRefusedWithTheCardsName) {
  EXPECT_THAT(
      [] {
        encoder_card::EncoderCardProfile(card(), {0.002, 70.0, 100.0});
      },
      ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("'fl_card'")));
}

TEST(MakeCardProfile, ADriveIsNoCardAndACardIsNoDrive) {
  EncoderCardConfig wrong = card();
  wrong.profile = "epos2";
  EXPECT_THAT(
      [&] { make_card_profile(wrong, kTiming); },
      ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("there are: encoder_card")));
  ActuatorConfig drive;
  drive.profile = "encoder_card";
  EXPECT_THAT([&] { make_profile(drive, kTiming); },
              ::testing::ThrowsMessage<std::invalid_argument>(::testing::HasSubstr("epos2, gold")));
}

}  // namespace
}  // namespace sprung
