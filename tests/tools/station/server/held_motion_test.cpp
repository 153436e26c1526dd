#include "tools/station/server/held_motion.h"

#include <gtest/gtest.h>

namespace sprung::station {
namespace {

std::vector<OperatorCommand> said(HeldMotion& held, std::int64_t now_us) {
  std::vector<OperatorCommand> out;
  held.step(now_us, out);
  return out;
}

TEST(HeldMotion, IsRenewedTenTimesASecondWhileSomebodyIsThere) {
  HeldMotion held;
  held.begin(0);
  int renewals = 0;
  for (std::int64_t now_us = 0; now_us <= 1'000'000; now_us += 20'000) {
    held.touch(now_us);
    for (const OperatorCommand& command : said(held, now_us)) {
      EXPECT_EQ(command.kind, OperatorKind::kHold);
      EXPECT_EQ(command.hold_s, HeldMotion::kHold_s);
      ++renewals;
    }
  }
  EXPECT_EQ(renewals, 10);
}

TEST(HeldMotion, EndsAtOnceWhenItIsLetGo) {
  HeldMotion held;
  held.begin(0);
  held.let_go(10'000);
  const auto last = said(held, 10'000);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(last[0].kind, OperatorKind::kHold);
  EXPECT_LT(last[0].hold_s, 0.01);
  EXPECT_TRUE(said(held, 40'000).empty());
  const auto stop = said(held, 60'000);
  ASSERT_EQ(stop.size(), 1u);
  EXPECT_EQ(stop[0].kind, OperatorKind::kStop);
  EXPECT_TRUE(said(held, 200'000).empty());
}

TEST(HeldMotion, EndsWhenNobodyIsHeardOfAnyMore) {
  HeldMotion held;
  held.begin(0);
  for (std::int64_t now_us = 0; now_us <= HeldMotion::kGone_us; now_us += 20'000) said(held, now_us);
  EXPECT_TRUE(held.active());
  const auto last = said(held, HeldMotion::kGone_us + 20'000);
  EXPECT_FALSE(held.active());
  ASSERT_EQ(last.size(), 1u);
  EXPECT_LT(last[0].hold_s, 0.01);
}

TEST(HeldMotion, ThatEndedByItselfIsStoppedByNobody) {
  HeldMotion held;
  held.begin(0);
  held.forget();
  held.let_go(0);
  EXPECT_TRUE(said(held, 1'000'000).empty());
}

}  // namespace
}  // namespace sprung::station
