#include "drivers/profiles/encoder_card/encoder_card_device.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "drivers/canopen/objects.h"

namespace sprung::encoder_card {
namespace {

using canopen::NmtCommand;

constexpr int kNode = 9;
constexpr double kCountsPerRad = kCountsPerTurn / (2 * M_PI);

class EncoderCardDeviceTest : public testing::Test {
 protected:
  explicit EncoderCardDeviceTest(const std::vector<double>& counts_per_turn = {})
      : card_(setup(counts_per_turn)) {
    card_.outbox().open(&out_);
    card_.step(0);
    nmt(NmtCommand::kStart);
    out_.clear();
  }
  static sim::SimCardSetup setup(const std::vector<double>& counts_per_turn) {
    sim::SimCardSetup setup;
    setup.card.bus = 1;
    setup.card.node = kNode;
    setup.seed = 1;
    setup.counts_per_turn = counts_per_turn;
    return setup;
  }
  void nmt(NmtCommand command) { card_.receive(canopen::nmt_frame(command, 0), 0); }
  /// One cycle with these angles; what the card sent, all zero when it sent nothing.
  Sample cycle(double first_rad, double second_rad = 0.0, double third_rad = 0.0) {
    ++cycle_;
    card_.sample(0, first_rad, cycle_);
    card_.sample(1, second_rad, cycle_);
    card_.sample(2, third_rad, cycle_);
    out_.clear();
    card_.receive(canopen::sync_frame(), 1000 * cycle_);
    if (out_.size() != 1) return {};
    const CanFrame& frame = out_[0].frame;
    EXPECT_EQ(frame.id, canopen::tpdo_id(0, kNode));
    EXPECT_EQ(frame.length, 8);
    const std::uint64_t high = canopen::get_le(&frame.data[4], 4);
    return unpack(high << 32 | canopen::get_le(frame.data.data(), 4));
  }
  canopen::SdoMessage read(std::uint16_t index, std::uint8_t sub = 0) {
    out_.clear();
    card_.receive(canopen::sdo_read_request(kNode, {index, sub}), 1000 * cycle_);
    return out_.size() == 1 ? canopen::decode_sdo_reply(out_[0].frame) : canopen::SdoMessage{};
  }

  EncoderCardDevice card_;
  FrameBatch out_;
  std::int64_t cycle_ = 0;
};

TEST_F(EncoderCardDeviceTest, SendsAllChannelsAtEverySyncAndCounts) {
  const Sample first = cycle(1.0, 2.0, 3.0);
  EXPECT_EQ(first.counts[0], static_cast<std::uint32_t>(1.0 * kCountsPerRad));
  EXPECT_EQ(first.counts[1], static_cast<std::uint32_t>(2.0 * kCountsPerRad));
  EXPECT_EQ(first.counts[2], static_cast<std::uint32_t>(3.0 * kCountsPerRad));
  EXPECT_EQ(missed_samples(first.counter, cycle(1.0).counter), 0);
}

TEST_F(EncoderCardDeviceTest, AnglesAreAbsoluteWithinATurn) {
  EXPECT_EQ(cycle(-1e-9).counts[0], kCountMask);
  EXPECT_EQ(cycle(-M_PI).counts[0], kCountsPerTurn / 2);
  EXPECT_EQ(cycle(2 * M_PI + 1.0).counts[0], cycle(1.0).counts[0]);
}

class CoarseEncoders : public EncoderCardDeviceTest {
 protected:
  CoarseEncoders() : EncoderCardDeviceTest({65536, 4000}) {}
};

TEST_F(CoarseEncoders, CountAsManyAsTheyHaveAndWrapThere) {
  const Sample sample = cycle(M_PI / 2, M_PI / 2, M_PI / 2);
  EXPECT_EQ(sample.counts[0], 16384U);
  EXPECT_EQ(sample.counts[1], 1000U);
  EXPECT_EQ(sample.counts[2], kCountsPerTurn / 4);  // nobody said: what the card can carry
  EXPECT_EQ(cycle(-1e-9).counts[0], 65535U);
  EXPECT_EQ(cycle(0.0, -1e-9).counts[1], 3999U);
  EXPECT_EQ(cycle(4 * M_PI + 1.0).counts[0], cycle(1.0).counts[0]);
}

TEST_F(EncoderCardDeviceTest, SendsNothingUnlessOperational) {
  nmt(NmtCommand::kEnterPreOperational);
  EXPECT_FALSE(card_.operational());
  cycle(1.0);
  EXPECT_EQ(out_.size(), 0);
}

TEST_F(EncoderCardDeviceTest, ShowsItselfAndItsEncodersBySdo) {
  const Sample sample = cycle(1.0, 2.0, 3.0);
  EXPECT_EQ(read(canopen::kIdentity, 2).value, 0x00454E43U);
  EXPECT_EQ(read(0x2101, 3).value, sample.counts[2]);
  EXPECT_EQ(read(0x2102).value, 3U);
  EXPECT_EQ(read(0x2100).kind, canopen::SdoKind::kUploadBegin);  // 8 bytes, in segments
}

/// A SYNC that is lost on its way is a sample that was not taken.
TEST_F(EncoderCardDeviceTest, SyncThatItDoesNotHearLatchesNothing) {
  const Sample first = cycle(1.0);
  card_.outbox().set_fault(FaultKind::kFramesLost, 1.0, true);
  cycle(2.0);
  EXPECT_EQ(out_.size(), 0);
  card_.outbox().set_fault(FaultKind::kFramesLost, 0.0, false);
  EXPECT_EQ(missed_samples(first.counter, cycle(3.0).counter), 0);
}

/// One that was taken but did not arrive is seen by the counter.
TEST_F(EncoderCardDeviceTest, LostSampleIsSeenByTheCounter) {
  const Sample first = cycle(1.0);
  card_.outbox().open(nullptr);
  cycle(2.0);
  card_.outbox().open(&out_);
  EXPECT_EQ(missed_samples(first.counter, cycle(3.0).counter), 1);
}

TEST_F(EncoderCardDeviceTest, StuckEncoderCountsSamplesOn) {
  const Sample first = cycle(1.0);
  card_.set_fault(FaultKind::kEncoderStuck, 0.0, true);
  const Sample stuck = cycle(2.0);
  EXPECT_EQ(stuck.counts[0], first.counts[0]);
  EXPECT_EQ(missed_samples(first.counter, stuck.counter), 0);
  card_.set_fault(FaultKind::kEncoderStuck, 0.0, false);
  EXPECT_NE(cycle(2.0).counts[0], first.counts[0]);
}

TEST_F(EncoderCardDeviceTest, JumpStaysUntilThePowerIsCycled) {
  card_.set_fault(FaultKind::kEncoderJump, 0.5, true);
  card_.set_fault(FaultKind::kEncoderJump, 0.5, false);
  EXPECT_EQ(cycle(1.0).counts[0], static_cast<std::uint32_t>(1.5 * kCountsPerRad));
  card_.set_fault(FaultKind::kPowerCycle, 0.0, true);
  cycle(1.0);
  EXPECT_EQ(out_.size(), 0);
  EXPECT_FALSE(card_.operational());
  card_.set_fault(FaultKind::kPowerCycle, 0.0, false);
  out_.clear();
  card_.step(50000);
  ASSERT_EQ(out_.size(), 1);
  EXPECT_TRUE(out_[0].frame == canopen::heartbeat_frame(kNode, canopen::NmtState::kBootUp));
  nmt(NmtCommand::kStart);
  EXPECT_EQ(cycle(1.0).counts[0], static_cast<std::uint32_t>(1.0 * kCountsPerRad));
}

TEST_F(EncoderCardDeviceTest, NoiseHasItsRmsAndIsTheSameInEveryRun) {
  constexpr double kNoise_rad = 1e-3;
  constexpr int kCycles = 4000;
  card_.set_fault(FaultKind::kEncoderNoise, kNoise_rad, true);
  std::vector<std::uint32_t> counts;
  double square = 0.0;
  for (int i = 0; i < kCycles; ++i) {
    const Sample sample = cycle(1.0, 1.0);
    EXPECT_LT(std::abs(static_cast<double>(sample.counts[0]) - kCountsPerRad),
              4 * kNoise_rad * kCountsPerRad);
    square += std::pow(static_cast<double>(sample.counts[0]) / kCountsPerRad - 1.0, 2);
    counts.push_back(sample.counts[0]);
    if (i > 0 && i < 5) {
      EXPECT_NE(sample.counts[0], sample.counts[1]);
    }
  }
  EXPECT_NEAR(std::sqrt(square / kCycles), kNoise_rad, 0.05 * kNoise_rad);
  card_.set_fault(FaultKind::kEncoderNoise, 0.0, false);
  EXPECT_EQ(cycle(1.0).counts[0], static_cast<std::uint32_t>(kCountsPerRad));
  cycle_ = 0;
  card_.set_fault(FaultKind::kEncoderNoise, kNoise_rad, true);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(cycle(1.0).counts[0], counts[i]);
}

TEST_F(EncoderCardDeviceTest, FaultIsAnEmergency) {
  out_.clear();
  card_.raise_fault(0x7320);
  ASSERT_EQ(out_.size(), 1);
  EXPECT_EQ(out_[0].frame.id, canopen::emcy_id(kNode));
  EXPECT_EQ(read(canopen::kErrorRegister).value, 0x21U);
  EXPECT_TRUE(card_.operational());
}

}  // namespace
}  // namespace sprung::encoder_card
