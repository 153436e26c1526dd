/// What runs in every cycle around a core allocates nothing once it has its size (LCM itself aside).
#include <gtest/gtest.h>

#include <array>
#include <cstdlib>
#include <memory>
#include <vector>

#include "runtime/answer_store.h"
#include "runtime/loop_statistics.h"
#include "runtime/receive_guard.h"
#include "runtime/responder.h"
#include "runtime/slot.h"
#include "signals/joint_state.h"
#include "signals/messages.h"
#include "tests/support/allocation_count.h"

namespace sprung {
namespace {

class CycleAllocationTest : public ::testing::Test {
 protected:
  CycleAllocationTest() {
    state_.stamp.seq = 0;
    to_message(state_, 1, message_);
    bytes_.resize(static_cast<std::size_t>(message_.getEncodedSize()));
    guard_.demand(key_, true);
  }

  /// As a message of cycle `seq` would: sent, sealed, checked, decoded, stored, decided upon, taken, kept.
  void cycle(std::int64_t seq) {
    state_.stamp.seq = seq;
    to_message(state_, 1, message_);
    message_.encode(bytes_.data(), 0, static_cast<int>(bytes_.size()));
    key_->seal("JOINT_STATE", bytes_.data(), bytes_.size());
    ASSERT_EQ(guard_.decode(bytes_.data(), bytes_.size(), received_message_), Refusal::kNone);
    ASSERT_TRUE(from_message(received_message_, received_));
    slot_.push(received_);
    ASSERT_EQ(responder_.decide({slot_.held(), {}, slot_.take_repeated(), seq}).action,
              ResponderAction::kStep);
    ASSERT_TRUE(slot_.get(seq, taken_));
    answers_.keep(taken_);
    statistics_.begin_cycle(seq);
    statistics_.end_cycle(seq);
  }

  const std::shared_ptr<const MessageKey> key_ = std::make_shared<const MessageKey>(
      std::array<std::uint8_t, kKeyBytes>{});
  JointState state_{12, 4};
  JointState received_{12, 4};
  JointState taken_{12, 4};
  sprung_msgs::joint_state_t message_{};
  sprung_msgs::joint_state_t received_message_{};
  std::vector<std::uint8_t> bytes_;
  ReceiveGuard guard_{"JOINT_STATE", layout_of<sprung_msgs::joint_state_t>(), CountLimits::exactly(12, 4), 1};
  Slot<JointState> slot_{JointState(12, 4)};
  AnswerStore<JointState> answers_{JointState(12, 4)};
  LockstepResponder responder_{LockstepTiming{}};
  LoopStatistics statistics_;
};

TEST_F(CycleAllocationTest, NothingAfterTheFirstCycle) {
  cycle(0);
  const std::int64_t before = test::allocation_count();
  for (std::int64_t seq = 1; seq < 1000; ++seq) cycle(seq);
  statistics_.summarize();
  EXPECT_EQ(test::allocation_count(), before);
}

TEST_F(CycleAllocationTest, TheCounterCounts) {
  const std::int64_t before = test::allocation_count();
  cycle(0);
  const std::vector<double> some(100);
  EXPECT_GT(test::allocation_count(), before) << some.size();
}

#ifndef __SANITIZE_ADDRESS__
TEST_F(CycleAllocationTest, TheCounterCountsWhatEigenAndCLibrariesTake) {
  void* volatile kept = nullptr;  // so that nothing is optimised away
  const auto counts = [&kept](auto allocate) {
    const std::int64_t before = test::allocation_count();
    kept = allocate();
    const bool counted = test::allocation_count() == before + 1;
    std::free(kept);
    return counted;
  };
  EXPECT_TRUE(counts([] { return std::malloc(100); }));
  EXPECT_TRUE(counts([] { return std::calloc(10, 10); }));
  EXPECT_TRUE(counts([] { return std::aligned_alloc(64, 128); }));
  EXPECT_TRUE(counts([] { return std::realloc(nullptr, 100); }));
}
#endif

}  // namespace
}  // namespace sprung
