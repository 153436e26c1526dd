#include "drivers/profiles/encoder_card/encoder_card_layout.h"

#include <gtest/gtest.h>

namespace sprung::encoder_card {
namespace {

TEST(EncoderCardLayout, EveryFieldHasItsOwnBits) {
  EXPECT_EQ(pack({{0xFFFFF, 0, 0}, 0}), 0x00000000000FFFFFULL);
  EXPECT_EQ(pack({{0, 0xFFFFF, 0}, 0}), 0x000000FFFFF00000ULL);
  EXPECT_EQ(pack({{0, 0, 0xFFFFF}, 0}), 0x0FFFFF0000000000ULL);
  EXPECT_EQ(pack({{0, 0, 0}, 15}), 0xF000000000000000ULL);
}

TEST(EncoderCardLayout, WhatIsPackedIsUnpacked) {
  const Sample sample{{0x12345, 0xABCDE, 0x0F0F0}, 9};
  const Sample again = unpack(pack(sample));
  EXPECT_EQ(again.counts, sample.counts);
  EXPECT_EQ(again.counter, sample.counter);
}

TEST(EncoderCardLayout, WhatDoesNotFitDisturbsNoOtherField) {
  const Sample sample = unpack(pack({{kCountsPerTurn + 5, 0, 0}, 0x12}));
  EXPECT_EQ(sample.counts[0], 5U);
  EXPECT_EQ(sample.counts[1], 0U);
  EXPECT_EQ(sample.counter, 2);
}

TEST(EncoderCardLayout, CounterTellsLostSamplesAcrossItsWrap) {
  EXPECT_EQ(missed_samples(3, 4), 0);
  EXPECT_EQ(missed_samples(15, 0), 0);
  EXPECT_EQ(missed_samples(14, 1), 2);
  EXPECT_EQ(missed_samples(7, 7), 15);
}

}  // namespace
}  // namespace sprung::encoder_card
