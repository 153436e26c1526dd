#include "runtime/responder.h"

#include <gtest/gtest.h>

#include <initializer_list>

namespace sprung {
namespace {

HeldSeqs held(std::initializer_list<std::int64_t> ascending) {
  HeldSeqs seqs;
  for (const std::int64_t seq : ascending) seqs.seqs[seqs.count++] = seq;
  return seqs;
}

struct Look {
  HeldSeqs inputs{};
  HeldSeqs partners{};
  std::int64_t now_us = 0;
  std::optional<std::int64_t> repeated{};
};

ResponderDecision decide(Responder& responder, const Look& look) {
  return responder.decide({look.inputs, look.partners, look.repeated, look.now_us});
}

void expect_step(Responder& responder, const Look& look, std::int64_t seq) {
  const ResponderDecision decision = decide(responder, look);
  EXPECT_EQ(decision.action, ResponderAction::kStep);
  EXPECT_EQ(decision.seq, seq);
}

/// @return until when.
std::int64_t expect_wait(Responder& responder, const Look& look) {
  const ResponderDecision decision = decide(responder, look);
  EXPECT_EQ(decision.action, ResponderAction::kWait);
  EXPECT_GT(decision.wait_until_us, look.now_us);
  return decision.wait_until_us;
}

LockstepTiming alone() { return {}; }
LockstepTiming with_partner() {
  LockstepTiming timing;
  timing.has_partner = true;
  return timing;
}

LockstepTiming with_imu() {
  LockstepTiming timing = with_partner();
  timing.partner_lag = 0;
  return timing;
}

TEST(LockstepResponder, AnswersEachCycleOnceAndInOrder) {
  LockstepResponder responder(alone());
  expect_wait(responder, {});
  expect_step(responder, {held({0, 1, 2}), {}}, 0);
  expect_step(responder, {held({0, 1, 2}), {}}, 1);
  expect_step(responder, {held({0, 1, 2}), {}}, 2);
  expect_wait(responder, {held({0, 1, 2}), {}});
  EXPECT_EQ(responder.counters().skipped_inputs, 0);
}

/// The estimator and IMU: cycle 0 waits already.
TEST(LockstepResponder, PartnerWithoutLagMustHaveTheSameCycle) {
  LockstepResponder responder(with_imu());
  expect_wait(responder, {held({0}), held({})});
  expect_step(responder, {held({0}), held({0})}, 0);
  expect_wait(responder, {held({0, 1}), held({0})});
  expect_step(responder, {held({0, 1}), held({0, 1, 2})}, 1);
  EXPECT_EQ(responder.counters().missed_partners, 0);
}

TEST(LockstepResponder, PartnerWithoutLagThatNeverCameIsDoneWithout) {
  LockstepResponder responder(with_imu());
  EXPECT_EQ(expect_wait(responder, {held({0}), held({})}), 300'000);
  expect_step(responder, {held({0}), held({}), 300'000}, 0);
  EXPECT_EQ(expect_wait(responder, {held({0, 1}), held({}), 301'000}), 303'000);
  expect_step(responder, {held({0, 1}), held({}), 303'000}, 1);
  EXPECT_EQ(responder.counters().missed_partners, 2);
}

TEST(LockstepResponder, RepeatOfAnAnsweredInputAsksForTheStoredAnswers) {
  LockstepResponder responder(alone());
  expect_step(responder, {held({0}), {}}, 0);
  const ResponderDecision decision = decide(responder, {held({0}), {}, 5, 0});
  EXPECT_EQ(decision.action, ResponderAction::kResend);
  EXPECT_EQ(decision.seq, 0);
  expect_wait(responder, {held({0}), {}});
}

TEST(LockstepResponder, RepeatOfAnInputThatIsNotAnsweredYetChangesNothing) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({0}), {}}, 0);
  expect_wait(responder, {held({0, 1}), held({})});
  expect_wait(responder, {held({0, 1}), held({}), 60'000, 1});
  expect_step(responder, {held({0, 1}), held({0})}, 1);
}

TEST(LockstepResponder, WaitsForAMissingInputThatMayBeRepeated) {
  LockstepResponder responder(alone());
  expect_step(responder, {held({0}), {}}, 0);
  const std::int64_t until_us = expect_wait(responder, {held({0, 2}), {}, 1'000});
  EXPECT_EQ(until_us, 301'000);
  expect_step(responder, {held({0, 1, 2}), {}, 60'000}, 1);
  expect_step(responder, {held({0, 1, 2}), {}, 60'000}, 2);
}

TEST(LockstepResponder, AcceptsAJumpAfterItsPatience) {
  LockstepResponder responder(alone());
  expect_step(responder, {held({0}), {}}, 0);
  expect_wait(responder, {held({0, 2}), {}, 1'000});
  expect_wait(responder, {held({0, 2}), {}, 300'999});
  expect_step(responder, {held({0, 2}), {}, 301'000}, 2);
  EXPECT_EQ(responder.counters().skipped_inputs, 1);
}

TEST(LockstepResponder, SkipsAtOnceWhatCannotBeRepeatedAnyMore) {
  LockstepResponder responder(alone());
  expect_step(responder, {held({100, 101, 102, 103}), {}}, 100);  // started late
  EXPECT_EQ(responder.counters().skipped_inputs, 100);
  expect_step(responder, {held({100, 101, 102, 103}), {}}, 101);
  expect_step(responder, {held({104, 105}), {}}, 104);
  EXPECT_EQ(responder.counters().skipped_inputs, 102);
}

TEST(LockstepResponder, CycleZeroNeedsNoPartner) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({0}), held({})}, 0);
}

TEST(LockstepResponder, WaitsForThePartnersLastCycle) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({0}), held({})}, 0);
  expect_wait(responder, {held({0, 1}), held({})});
  expect_step(responder, {held({0, 1}), held({0})}, 1);
  expect_wait(responder, {held({1, 2}), held({0}), 10});
  expect_wait(responder, {held({1, 2}), held({0, 2}), 10});  // a later one is no substitute
  expect_step(responder, {held({1, 2}), held({0, 1, 2}), 20}, 2);
  EXPECT_EQ(responder.counters().missed_partners, 0);
}

TEST(LockstepResponder, GoesOnWithoutADeadPartnerFirstSlowlyThenFast) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({0}), held({})}, 0);
  EXPECT_EQ(expect_wait(responder, {held({0, 1}), held({}), 0}), 300'000);
  expect_step(responder, {held({0, 1}), held({}), 300'000}, 1);
  EXPECT_EQ(expect_wait(responder, {held({1, 2}), held({}), 300'100}), 302'100);
  expect_step(responder, {held({1, 2}), held({}), 302'100}, 2);
  EXPECT_EQ(responder.counters().missed_partners, 2);
}

TEST(LockstepResponder, IsPatientAgainWhenThePartnerIsBackInTime) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({0}), held({})}, 0);
  expect_wait(responder, {held({0, 1}), held({}), 0});
  expect_step(responder, {held({0, 1}), held({}), 300'000}, 1);
  expect_step(responder, {held({1, 2}), held({1}), 300'100}, 2);
  EXPECT_EQ(expect_wait(responder, {held({2, 3}), held({1}), 400'000}), 700'000);
  EXPECT_EQ(responder.counters().missed_partners, 1);
}

TEST(LockstepResponder, PatienceBeginsAnewForEachThingThatIsMissing) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({0}), held({})}, 0);
  expect_wait(responder, {held({0, 2}), held({0}), 0});
  EXPECT_EQ(expect_wait(responder, {held({0, 2}), held({0}), 300'000}),
            600'000);  // jumped; now the partner's 1
  expect_step(responder, {held({0, 2}), held({0}), 600'000}, 2);
  EXPECT_EQ(responder.counters().skipped_inputs, 1);
  EXPECT_EQ(responder.counters().missed_partners, 1);
}

TEST(LockstepResponder, WaitingForNothingUsesUpNoPatience) {
  LockstepResponder responder(alone());
  expect_step(responder, {held({0}), {}}, 0);
  expect_wait(responder, {held({0, 2}), {}, 0});
  expect_wait(responder, {held({0}), {}, 250'000});  // slot was emptied meanwhile
  expect_wait(responder, {held({0, 2}), {}, 301'000});
}

TEST(LockstepResponder, StartsOverWhenTheBridgeDid) {
  LockstepResponder responder(with_partner());
  expect_step(responder, {held({50, 51, 52}), held({49})}, 50);
  EXPECT_EQ(decide(responder, {held({0}), held({49})}).action, ResponderAction::kRestart);
  expect_step(responder, {held({0}), held({49})}, 0);
  expect_wait(responder, {held({0, 1}), held({49})});
  EXPECT_EQ(responder.counters().restarts, 1);
}

TEST(LockstepResponder, FallingBackALittleIsNoNewStart) {
  LockstepResponder responder(alone());
  expect_step(responder, {held({50, 51, 52}), {}}, 50);
  expect_wait(responder, {held({50 - kRestartGap}), {}});
  EXPECT_EQ(responder.counters().restarts, 0);
}

TEST(RealTimeResponder, AnswersTheNewestAtOnceAndCountsGaps) {
  RealTimeResponder responder;
  expect_wait(responder, {});
  expect_step(responder, {held({7}), {}}, 7);
  expect_wait(responder, {held({7}), {}});
  expect_step(responder, {held({7, 8, 9, 10}), {}}, 10);
  EXPECT_EQ(responder.counters().skipped_inputs, 2);
  expect_wait(responder, {held({7, 8, 9, 10}), {}, 0, 10});  // repeats are nothing to it
}

TEST(RealTimeResponder, NeedsNoPartner) {
  RealTimeResponder responder;
  expect_step(responder, {held({7}), held({})}, 7);
}

TEST(RealTimeResponder, IsSilentBeforeTheFirstInputAndWhenInputsStop) {
  RealTimeResponder responder;
  expect_wait(responder, {held({}), {}, 10'000'000});
  expect_step(responder, {held({7}), {}, 11'000'000}, 7);
  EXPECT_GT(expect_wait(responder, {held({7}), {}, 11'020'000}), 11'020'000);
  expect_wait(responder, {held({7}), {}, 20'000'000});
  expect_step(responder, {held({7, 8}), {}, 20'000'001}, 8);
}

TEST(RealTimeResponder, StartsOverWhenTheBridgeDid) {
  RealTimeResponder responder;
  expect_step(responder, {held({700}), {}, 0}, 700);
  EXPECT_EQ(decide(responder, {held({0}), {}, 10}).action, ResponderAction::kRestart);
  expect_step(responder, {held({0}), {}, 20}, 0);
  EXPECT_EQ(responder.counters().skipped_inputs, 0);
}

}  // namespace
}  // namespace sprung
