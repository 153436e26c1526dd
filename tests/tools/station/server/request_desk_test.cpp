#include "tools/station/server/request_desk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::station {
namespace {

using testing::HasSubstr;

OperatorCommand order(OperatorKind kind) {
  OperatorCommand command;
  command.kind = kind;
  return command;
}

class Desk : public testing::Test {
 protected:
  std::vector<OperatorCommand> sent(std::int64_t now_us) {
    std::vector<OperatorCommand> out;
    news_.clear();
    desk_.step(now_us, out, news_);
    return out;
  }
  RequestDesk desk_{7};
  std::vector<RequestNews> news_;
};

TEST_F(Desk, SaysARequestAtOnceAndAgainUntilItIsAnswered) {
  const auto id = desk_.add(order(OperatorKind::kStand), {1, 5}, 0);
  ASSERT_EQ(sent(0).size(), 1u);
  EXPECT_TRUE(sent(90'000).empty());
  ASSERT_EQ(sent(100'000).size(), 1u);
  const auto news = desk_.answer({*id, OperatorOutcome::kAccepted, "", "planner", 7}, 150'000);
  ASSERT_TRUE(news);
  EXPECT_EQ(news->asker.number, 5);
  EXPECT_FALSE(news->over);
  EXPECT_TRUE(sent(500'000).empty());
  EXPECT_EQ(sent(650'000).size(), 1u) << "the last answer may have been lost";
  EXPECT_FALSE(desk_.answer({*id, OperatorOutcome::kAccepted, "", "planner", 7}, 660'000)) << "told already";
  EXPECT_TRUE(desk_.answer({*id, OperatorOutcome::kDone, "", "planner", 7}, 700'000)->over);
  EXPECT_EQ(desk_.under_way(), 0u);
}

TEST_F(Desk, RefusalIsTheEndAndHasItsReason) {
  const auto id = desk_.add(order(OperatorKind::kJump), {1, 5}, 0);
  const auto news = desk_.answer({*id, OperatorOutcome::kRefused, "not standing", "planner", -1}, 1);
  EXPECT_EQ(news->reason, "not standing");
  EXPECT_FALSE(news->went_well());
  EXPECT_TRUE(news->over);
}

TEST_F(Desk, GivesUpWhereNobodyAnswersAndSaysWho) {
  desk_.add(order(OperatorKind::kStand), {1, 5}, 0);
  EXPECT_TRUE(sent(RequestDesk::kFirstAnswer_us).empty());
  ASSERT_EQ(news_.size(), 1u);
  EXPECT_EQ(news_[0].outcome, "no answer");
  EXPECT_THAT(news_[0].reason, HasSubstr("motion planner"));
}

TEST_F(Desk, AStopMakesVoidWhatMovesAndWasNotAnswered) {
  const auto walk = desk_.add(order(OperatorKind::kWalk), {1, 1}, 0);
  const auto jump = desk_.add(order(OperatorKind::kJump), {1, 2}, 1);
  desk_.answer({*jump, OperatorOutcome::kAccepted, "", "planner", 7}, 2);
  desk_.add(order(OperatorKind::kClear), {1, 3}, 3);
  desk_.add(order(OperatorKind::kStop), {1, 4}, 4);
  EXPECT_EQ(desk_.under_way(), 3u) << "the jump that was accepted is asked after";
  for (const OperatorCommand& command : sent(5)) EXPECT_NE(command.request_id, *walk);
  ASSERT_EQ(news_.size(), 1u);
  EXPECT_THAT(news_[0].reason, HasSubstr("stop came after it"));
}

TEST_F(Desk, ALaterSpeedMakesTheOneBeforeVoidAndAHoldDoesNot) {
  desk_.add(order(OperatorKind::kWalk), {}, 0);
  desk_.add(order(OperatorKind::kHold), {}, 1);
  EXPECT_EQ(desk_.under_way(), 2u);
  const auto second = desk_.add(order(OperatorKind::kWalk), {}, 2);
  const auto out = sent(3);
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].request_id, *second);
}

TEST_F(Desk, AHoldThatLetsGoMakesAWalkVoidThatWasNotAnswered) {
  desk_.add(order(OperatorKind::kWalk), {}, 0);
  OperatorCommand last = order(OperatorKind::kHold);
  last.hold_s = 0.001;
  desk_.add(last, {}, 1);
  const auto out = sent(2);
  ASSERT_EQ(out.size(), 1u) << "a walk that comes after the sticks were let go";
  EXPECT_EQ(out[0].kind, OperatorKind::kHold);
}

TEST_F(Desk, HoldsAndEnablesAreSaidOnce) {
  for (const OperatorKind kind : {OperatorKind::kHold, OperatorKind::kEnable}) {
    desk_.add(order(kind), {}, 0);
    EXPECT_EQ(sent(0).size(), 1u);
    EXPECT_TRUE(sent(500'000).empty());
    sent(RequestDesk::kFirstAnswer_us);
    EXPECT_EQ(desk_.under_way(), 0u);
  }
}

TEST_F(Desk, RequestIdsGrowAlsoWithinAMicrosecond) {
  const auto first = desk_.add(order(OperatorKind::kStand), {}, 9);
  EXPECT_GT(*desk_.add(order(OperatorKind::kClear), {}, 9), *first);
}

TEST_F(Desk, TooManyAreRefusedButNeverAnEmergencyStop) {
  for (std::size_t i = 0; i < RequestDesk::kMost; ++i)
    EXPECT_TRUE(desk_.add(order(OperatorKind::kClear), {}, static_cast<std::int64_t>(i)));
  EXPECT_FALSE(desk_.add(order(OperatorKind::kClear), {}, 99));
  EXPECT_TRUE(desk_.add(order(OperatorKind::kEstop), {}, 99));
}

}  // namespace
}  // namespace sprung::station
