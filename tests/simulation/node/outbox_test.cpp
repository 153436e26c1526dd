#include "simulation/node/outbox.h"

#include <gtest/gtest.h>

#include <vector>

#include "drivers/canopen/nmt.h"

namespace sprung::sim {
namespace {

constexpr int kFrames = 2000;

class OutboxTest : public testing::Test {
 protected:
  OutboxTest() { open(outbox_); }
  void open(Outbox& outbox) {
    outbox.set_seed(1, 7);
    outbox.open(&out_);
  }
  static CanFrame frame(int number) {
    return {0x181, 8, {static_cast<std::uint8_t>(number & 0xFF), static_cast<std::uint8_t>(number >> 8)}};
  }
  /// Number of each frame that came through, of many.
  std::vector<int> through(Outbox& outbox) {
    std::vector<int> numbers;
    for (int i = 0; i < kFrames; ++i) {
      out_.clear();
      outbox.send(frame(i));
      for (const BusFrame& entry : out_) numbers.push_back(entry.frame.data[0] | entry.frame.data[1] << 8);
    }
    return numbers;
  }

  FrameBatch out_;
  Outbox outbox_{2};
};

TEST_F(OutboxTest, SendsToItsBusAsLongAsItIsOpen) {
  outbox_.send(frame(1));
  ASSERT_EQ(out_.size(), 1);
  EXPECT_EQ(out_[0].bus, 2);
  EXPECT_TRUE(out_[0].frame == frame(1));
  outbox_.open(nullptr);
  outbox_.send(frame(2));
  EXPECT_EQ(out_.size(), 1);
}

TEST_F(OutboxTest, LosesItsShareAndTheSameFramesInEveryRun) {
  outbox_.set_fault(FaultKind::kFramesLost, 0.2, true);
  Outbox same{2};
  open(same);
  same.set_fault(FaultKind::kFramesLost, 0.2, true);
  Outbox other{2};
  open(other);
  other.set_seed(1, 8);
  other.set_fault(FaultKind::kFramesLost, 0.2, true);
  const std::vector<int> kept = through(outbox_);
  EXPECT_NEAR(static_cast<double>(kept.size()), 0.8 * kFrames, 0.05 * kFrames);
  EXPECT_EQ(kept, through(same));
  EXPECT_NE(kept, through(other));
}

TEST_F(OutboxTest, EndedFaultIsOver) {
  outbox_.set_fault(FaultKind::kFramesLost, 1.0, true);
  EXPECT_TRUE(through(outbox_).empty());
  outbox_.set_fault(FaultKind::kFramesLost, 1.0, false);
  EXPECT_EQ(through(outbox_).size(), static_cast<std::size_t>(kFrames));
}

/// What comes in is counted on its own: a device that speaks more loses no other frames.
TEST_F(OutboxTest, LosesItsShareOfIncomingFramesToo) {
  outbox_.set_fault(FaultKind::kFramesLost, 0.2, true);
  Outbox talking{2};
  open(talking);
  talking.set_fault(FaultKind::kFramesLost, 0.2, true);
  int heard = 0;
  for (int i = 0; i < kFrames; ++i) {
    const bool hears = outbox_.hears();
    talking.send(frame(i));
    EXPECT_EQ(talking.hears(), hears);
    heard += hears ? 1 : 0;
    out_.clear();
  }
  EXPECT_NEAR(heard, 0.8 * kFrames, 0.05 * kFrames);
}

TEST_F(OutboxTest, LateFramesComeInOrderAfterTheirTime) {
  outbox_.set_fault(FaultKind::kFramesLate, 0.003, true);
  outbox_.release(10000);
  outbox_.send(frame(1));
  outbox_.release(11000);
  outbox_.send(frame(2));
  outbox_.release(12999);
  EXPECT_EQ(out_.size(), 0);
  outbox_.release(13000);
  ASSERT_EQ(out_.size(), 1);
  EXPECT_TRUE(out_[0].frame == frame(1));
  outbox_.set_fault(FaultKind::kFramesLate, 0.0, false);
  outbox_.send(frame(3));
  outbox_.release(14000);
  ASSERT_EQ(out_.size(), 3);
  EXPECT_TRUE(out_[1].frame == frame(3));
  EXPECT_TRUE(out_[2].frame == frame(2));
}

TEST_F(OutboxTest, MoreLateFramesThanItKeepsAreLost) {
  outbox_.set_fault(FaultKind::kFramesLate, 1.0, true);
  for (int i = 0; i < kFrames; ++i) outbox_.send(frame(i));
  outbox_.release(1'000'000);
  EXPECT_EQ(out_.size(), static_cast<int>(Outbox::kLateCapacity));
}

TEST_F(OutboxTest, DuplicatesItsShare) {
  outbox_.set_fault(FaultKind::kFramesDuplicated, 0.1, true);
  EXPECT_NEAR(static_cast<double>(through(outbox_).size()), 1.1 * kFrames, 0.03 * kFrames);
}

TEST_F(OutboxTest, FlipsOneBitOfTheData) {
  outbox_.set_fault(FaultKind::kFramesFlipped, 0.5, true);
  int flipped = 0;
  for (int i = 0; i < kFrames; ++i) {
    out_.clear();
    outbox_.send({0x181, 2, {0, 0}});
    const CanFrame& sent = out_[0].frame;
    int bits = 0;
    for (const std::uint8_t byte : sent.data) bits += __builtin_popcount(byte);
    EXPECT_EQ(sent.data[2], 0);  // beyond its length
    EXPECT_LE(bits, 1);
    flipped += bits;
  }
  EXPECT_NEAR(flipped, 0.5 * kFrames, 0.05 * kFrames);
  outbox_.send({0x080, 0, {}});  // nothing to flip
}

TEST_F(OutboxTest, ShortensTheSampleOnly) {
  outbox_.set_fault(FaultKind::kShortPdo, 0.0, true);
  outbox_.send(frame(1), FrameKind::kSample);
  outbox_.send(frame(1), FrameKind::kSdo);
  EXPECT_EQ(out_[0].frame.length, 7);
  EXPECT_EQ(out_[1].frame.length, 8);
}

TEST_F(OutboxTest, StopsTheHeartbeatOnly) {
  outbox_.set_fault(FaultKind::kHeartbeatStopped, 0.0, true);
  outbox_.send(frame(1), FrameKind::kHeartbeat);
  EXPECT_EQ(out_.size(), 0);
  outbox_.send(frame(1));
  EXPECT_EQ(out_.size(), 1);
}

TEST_F(OutboxTest, CutCableAndBusOffWorkBothWays) {
  for (const FaultKind kind : {FaultKind::kBusOff, FaultKind::kLinkDown}) {
    outbox_.set_fault(kind, 0.0, true);
    EXPECT_TRUE(outbox_.cut());
    EXPECT_FALSE(outbox_.hears());
    outbox_.send(frame(1));
    outbox_.set_fault(kind, 0.0, false);
    EXPECT_TRUE(outbox_.hears());
  }
  outbox_.set_cut(true);
  EXPECT_FALSE(outbox_.hears());
  outbox_.send(frame(1));
  EXPECT_EQ(out_.size(), 0);
}

TEST_F(OutboxTest, ASecondNodeAnswersSdoAndHasAHeartbeatOfItsOwn) {
  outbox_.set_fault(FaultKind::kDuplicateNode, 0.0, true);
  outbox_.send(frame(1), FrameKind::kSdo);
  EXPECT_EQ(out_.size(), 2);
  out_.clear();
  outbox_.send(canopen::heartbeat_frame(3, canopen::NmtState::kOperational), FrameKind::kHeartbeat);
  ASSERT_EQ(out_.size(), 2);
  EXPECT_EQ(out_[1].frame.id, 0x703U);
  EXPECT_EQ(out_[1].frame.data[0], 0x7F);
  out_.clear();
  outbox_.send(frame(1), FrameKind::kSample);
  ASSERT_EQ(out_.size(), 2);
  EXPECT_EQ(out_[1].frame.id, out_[0].frame.id);
  EXPECT_FALSE(out_[1].frame == out_[0].frame);
}

TEST_F(OutboxTest, KnowsWhichFaultsAreItsOwn) {
  EXPECT_TRUE(Outbox::handles(FaultKind::kFramesFlipped));
  EXPECT_FALSE(Outbox::handles(FaultKind::kOverCurrent));
  EXPECT_FALSE(Outbox::handles(FaultKind::kPowerCycle));
  outbox_.set_fault(FaultKind::kOverCurrent, 1.0, true);
  EXPECT_FALSE(outbox_.active(FaultKind::kOverCurrent));
}

}  // namespace
}  // namespace sprung::sim
