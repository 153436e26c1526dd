#include "planner/operator_desk.h"

#include <gtest/gtest.h>

#include <string>

namespace sprung {
namespace {

OperatorCommand command(std::int64_t id, std::int64_t apply_at_seq = -1) {
  OperatorCommand c;
  c.request_id = id;
  c.apply_at_seq = apply_at_seq;
  c.kind = OperatorKind::kStand;
  return c;
}

TEST(OperatorDeskTest, CommandsWaitForTheirCycleInOrder) {
  OperatorDesk desk;
  desk.submit(command(1, 50));
  desk.submit(command(2));
  desk.submit(command(3, 10));
  OperatorCommand c;
  ASSERT_TRUE(desk.take_due(10, c));
  EXPECT_EQ(c.request_id, 2);
  ASSERT_TRUE(desk.take_due(10, c));
  EXPECT_EQ(c.request_id, 3);
  EXPECT_FALSE(desk.take_due(49, c));
  ASSERT_TRUE(desk.take_due(50, c));
  EXPECT_EQ(c.request_id, 1);
}

TEST(OperatorDeskTest, SixteenWaitAndTheNextIsRefused) {
  OperatorDesk desk;
  for (int i = 0; i < OperatorDesk::kMostWaiting; ++i) EXPECT_TRUE(desk.submit(command(i + 1, 100)));
  EXPECT_FALSE(desk.submit(command(99, 100)));
  OperatorCommand c;
  EXPECT_TRUE(desk.take_any(c));
  EXPECT_TRUE(desk.submit(command(99, 100)));
}

TEST(OperatorDeskTest, RepeatedIdIsAnsweredAgainAndNeverExecutedAgain) {
  OperatorDesk desk;
  OperatorCommand c;
  OperatorReply r;
  desk.submit(command(7));
  desk.submit(command(7));
  ASSERT_TRUE(desk.take_due(3, c));
  EXPECT_FALSE(desk.take_due(3, c));
  EXPECT_FALSE(desk.next_reply(r));
  desk.reply(7, OperatorOutcome::kAccepted, "", {3000, 3});
  ASSERT_TRUE(desk.next_reply(r));
  desk.submit(command(7));
  ASSERT_TRUE(desk.next_reply(r));
  EXPECT_EQ(r.outcome, OperatorOutcome::kAccepted);
  EXPECT_EQ(r.took_effect_at_seq, 3);
  EXPECT_FALSE(desk.take_due(4, c));
}

/// Ids are remembered for the session, though memory is bounded: what is forgotten is known by its size.
TEST(OperatorDeskTest, ForgottenIdIsRefusedAndNeverExecutedAgain) {
  OperatorDesk desk;
  OperatorCommand c;
  constexpr int kMany = 3 * OperatorDesk::kRemembered;
  const auto is_executed = [&](std::int64_t id) { return desk.submit(command(id)) && desk.take_due(0, c); };
  for (int id = 1; id <= kMany; ++id) ASSERT_TRUE(is_executed(id)) << id;
  for (int id = 1; id <= kMany; ++id) ASSERT_FALSE(is_executed(id)) << id;
  OperatorReply r;
  desk.submit(command(1));
  while (desk.next_reply(r)) continue;
  EXPECT_EQ(r.request_id, 1);
  EXPECT_EQ(r.outcome, OperatorOutcome::kRefused);
  EXPECT_TRUE(is_executed(kMany + 1));
}

TEST(OperatorDeskTest, DoneKeepsTheCycleInWhichTheCommandTookEffect) {
  OperatorDesk desk;
  OperatorReply r;
  desk.submit(command(7));
  desk.reply(7, OperatorOutcome::kAccepted, "", {3000, 3});
  desk.reply(7, OperatorOutcome::kDone, "stand reached", {9000, 9});
  ASSERT_TRUE(desk.next_reply(r) && desk.next_reply(r));
  EXPECT_EQ(r.outcome, OperatorOutcome::kDone);
  EXPECT_EQ(r.took_effect_at_seq, 3);
  EXPECT_EQ(r.stamp.seq, 9);
  EXPECT_STREQ(r.reason, "stand reached");
  EXPECT_STREQ(r.answered_by, "sprung-motion-planner");
}

TEST(OperatorDeskTest, RefusedNeverTookEffect) {
  OperatorDesk desk;
  OperatorReply r;
  desk.submit(command(8));
  desk.reply(8, OperatorOutcome::kRefused, "busy", {3000, 3});
  ASSERT_TRUE(desk.next_reply(r));
  EXPECT_EQ(r.took_effect_at_seq, -1);
}

TEST(OperatorDeskTest, RepliesThatNobodyTakesPushOutTheOldest) {
  OperatorDesk desk;
  OperatorReply r;
  for (int i = 1; i <= OperatorDesk::kMostReplies + 5; ++i) desk.reply(i, OperatorOutcome::kRefused, "", {});
  ASSERT_TRUE(desk.next_reply(r));
  EXPECT_EQ(r.request_id, 6);
}

}  // namespace
}  // namespace sprung
