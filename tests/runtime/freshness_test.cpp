#include "runtime/freshness.h"

#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <set>

namespace sprung {
namespace {

constexpr std::nullopt_t kLockstep = std::nullopt;
constexpr std::int64_t kCycle_us = 1000;

Stamp cycle(std::int64_t seq, std::int64_t began_us = 0) { return {began_us + seq * kCycle_us, seq}; }

TEST(ByTheClock, TellsWhatIsTooOldAndWhatCannotBeYet) {
  constexpr std::int64_t kNow_us = 10'000'000;
  EXPECT_EQ(by_clock(kNow_us - kOldest_us, kNow_us), Refusal::kNone);
  EXPECT_EQ(by_clock(kNow_us - kOldest_us - 1, kNow_us), Refusal::kLate);
  EXPECT_EQ(by_clock(kNow_us + kMostAhead_us, kNow_us), Refusal::kNone);
  EXPECT_EQ(by_clock(kNow_us + kMostAhead_us + 1, kNow_us), Refusal::kFuture);
  EXPECT_EQ(by_clock(0, kLockstep), Refusal::kNone) << "lock-step's time is not the clock's";
}

TEST(CycleFreshness, EachCycleOnceInRealTime) {
  CycleFreshness fresh;
  for (std::int64_t seq = 0; seq < 100; ++seq) {
    EXPECT_EQ(fresh.admit(cycle(seq), seq * kCycle_us), Refusal::kNone) << seq;
    for (std::int64_t old = 0; old <= seq; ++old)
      ASSERT_EQ(fresh.admit(cycle(old), seq * kCycle_us), Refusal::kReplayed) << old << " after " << seq;
  }
}

TEST(CycleFreshness, OrderDoesNotMatterAmongTheNewest) {
  CycleFreshness fresh;
  for (const std::int64_t seq : {0, 3, 1, 2, 9, 4}) EXPECT_EQ(fresh.admit(cycle(seq), 9000), Refusal::kNone);
  for (const std::int64_t seq : {1, 2, 3, 4, 9}) EXPECT_EQ(fresh.admit(cycle(seq), 9000), Refusal::kReplayed);
  EXPECT_EQ(fresh.admit(cycle(30), 30'000), Refusal::kNone) << "some may be lost";
  EXPECT_EQ(fresh.admit(cycle(25), 30'000), Refusal::kNone);
}

TEST(CycleFreshness, LockstepRepeatsAreLetThroughAndOlderOnesNot) {
  CycleFreshness fresh;
  for (std::int64_t seq = 0; seq <= 20; ++seq) EXPECT_EQ(fresh.admit(cycle(seq), kLockstep), Refusal::kNone);
  EXPECT_EQ(fresh.admit(cycle(20), kLockstep), Refusal::kNone);
  EXPECT_EQ(fresh.admit(cycle(19), kLockstep), Refusal::kNone);
  EXPECT_EQ(fresh.admit(cycle(20 - kRestartGap - 1), kLockstep), Refusal::kReplayed)
      << "a slot would take it for a restart, and forget what it has";
}

TEST(CycleFreshness, SenderThatBeganAnewIsKnownByItsTime) {
  CycleFreshness fresh;
  for (std::int64_t seq = 0; seq <= 50; ++seq) (void)fresh.admit(cycle(seq), seq * kCycle_us);
  constexpr std::int64_t kAnew_us = 60'000;
  for (std::int64_t seq = 0; seq < 10; ++seq)
    EXPECT_EQ(fresh.admit(cycle(seq, kAnew_us), kAnew_us), Refusal::kNone) << seq;
  for (std::int64_t seq = 0; seq <= 50; ++seq)
    EXPECT_EQ(fresh.admit(cycle(seq), kAnew_us), Refusal::kReplayed) << seq << " of the sender before";
  EXPECT_EQ(fresh.admit(cycle(10, kAnew_us), kAnew_us), Refusal::kNone);
}

TEST(CycleFreshness, WhatTheSenderBeforeSaidFillsNoGapOfTheNewOne) {
  CycleFreshness fresh;
  EXPECT_EQ(fresh.admit(cycle(50), 50'000), Refusal::kNone);
  constexpr std::int64_t kAnew_us = 60'000;
  for (const std::int64_t seq : {0, 5}) EXPECT_EQ(fresh.admit(cycle(seq, kAnew_us), 65'000), Refusal::kNone);
  EXPECT_EQ(fresh.admit(cycle(3), 65'000), Refusal::kReplayed);
  EXPECT_EQ(fresh.admit(cycle(3, kAnew_us), 65'000), Refusal::kNone) << "it may come late";
}

TEST(CycleFreshness, ProcessThatStartsLateIsNotFooledByWhatWasSaidBefore) {
  CycleFreshness fresh;
  EXPECT_EQ(fresh.admit(cycle(100), 10'000'000), Refusal::kLate);
  EXPECT_EQ(fresh.admit(cycle(10'000), 10'000'000), Refusal::kNone);
}

TEST(CycleFreshness, WhatIsRefusedChangesNothing) {
  CycleFreshness fresh;
  EXPECT_EQ(fresh.admit(cycle(1), 1000), Refusal::kNone);
  EXPECT_EQ(fresh.admit({1'000'000, 900}, 2000), Refusal::kFuture);
  EXPECT_EQ(fresh.admit(cycle(2), 2000), Refusal::kNone);
  EXPECT_EQ(fresh.admit(cycle(3), 3000), Refusal::kNone);
}

/// Against the obvious: a set of all that was taken.
TEST(CycleFreshness, NothingIsTakenTwiceInWhateverOrder) {
  std::mt19937 random(7);
  CycleFreshness fresh;
  std::set<std::int64_t> taken;
  std::int64_t newest = 0;
  for (int n = 0; n < 100'000; ++n) {
    const std::int64_t seq = newest + static_cast<std::int64_t>(random() % 24) - 20;
    if (fresh.admit(cycle(seq), newest * kCycle_us) != Refusal::kNone) continue;
    ASSERT_TRUE(taken.insert(seq).second) << seq;
    newest = std::max(newest, seq);
  }
  EXPECT_GT(newest, 1000);
}

TEST(EventFreshness, EachMessageOnce) {
  EventFreshness fresh(false);
  EXPECT_EQ(fresh.admit(1000, 1, 1000), Refusal::kNone);
  EXPECT_EQ(fresh.admit(1000, 2, 1000), Refusal::kNone) << "two operators at once";
  EXPECT_EQ(fresh.admit(900, 3, 1000), Refusal::kNone) << "of one whose clock is behind";
  for (const std::uint64_t mac : {1U, 2U, 3U}) EXPECT_EQ(fresh.admit(1000, mac, 1000), Refusal::kReplayed);
}

TEST(EventFreshness, RepeatsPassWhereTheReceiverKnowsThem) {
  EventFreshness fresh(true);
  EXPECT_EQ(fresh.admit(1000, 1, 1000), Refusal::kNone);
  EXPECT_EQ(fresh.admit(1000, 1, 1000), Refusal::kNone);
  EXPECT_EQ(fresh.admit(1000, 1, 1000 + kOldest_us + 1), Refusal::kLate);
}

TEST(EventFreshness, WhatCannotBeRememberedIsLate) {
  EventFreshness fresh(false);
  constexpr auto kMany = static_cast<std::int64_t>(EventFreshness::kRemembered) + 10;
  for (std::int64_t n = 0; n < kMany; ++n)
    ASSERT_EQ(fresh.admit(n, static_cast<std::uint64_t>(n), kMany), Refusal::kNone);
  for (std::int64_t n = 0; n < kMany; ++n)
    ASSERT_EQ(fresh.admit(n, static_cast<std::uint64_t>(n), kMany),
              n < 10 ? Refusal::kLate : Refusal::kReplayed);
  EXPECT_EQ(fresh.admit(kMany, static_cast<std::uint64_t>(kMany), kMany), Refusal::kNone);
}

}  // namespace
}  // namespace sprung
