#include "drivers/bridge/guard_watch.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

using canopen::NmtState;

constexpr std::int64_t kGuardPeriod_us = 5'000;
constexpr std::int64_t kGuardCycle_us = 2'000;

class GuardWatchTest : public testing::Test {
 protected:
  /// The next question, and the answer to it.
  bool ask_and_answer(bool toggle) {
    time_us_ += kGuardPeriod_us;
    EXPECT_TRUE(watch_.due(time_us_, kGuardCycle_us));
    return answer(toggle);
  }
  void ask_in_vain() {
    time_us_ += kGuardPeriod_us;
    EXPECT_TRUE(watch_.due(time_us_, kGuardCycle_us));
  }
  bool answer(bool toggle) { return watch_.answered({NmtState::kOperational, toggle}); }

  GuardWatch watch_{true, kGuardPeriod_us};
  std::int64_t time_us_ = 0;
};

TEST_F(GuardWatchTest, QuestionsComeRatherEarlyThanLate) {
  int asked = 0;
  for (std::int64_t time_us = 0; time_us < 1'000'000; time_us += kGuardCycle_us)
    asked += watch_.due(time_us, kGuardCycle_us) ? 1 : 0;
  EXPECT_EQ(asked, 250);  // every second cycle: 6 ms would be later than 5
}

TEST_F(GuardWatchTest, AnswersToggleFromZero) {
  EXPECT_TRUE(ask_and_answer(false));
  EXPECT_TRUE(ask_and_answer(true));
  EXPECT_TRUE(ask_and_answer(false));
  EXPECT_EQ(watch_.toggle_errors(), 0);
}

TEST_F(GuardWatchTest, FirstAnswerWithToggleOneIsWrong) {
  EXPECT_FALSE(ask_and_answer(true));
  EXPECT_TRUE(watch_.toggle_stands());
}

TEST_F(GuardWatchTest, BitThatStandsIsWrongEachTime) {
  EXPECT_TRUE(ask_and_answer(false));
  for (int i = 1; i <= 5; ++i) {
    EXPECT_FALSE(ask_and_answer(false));
    EXPECT_EQ(watch_.toggle_errors(), i);
  }
  EXPECT_TRUE(watch_.toggle_stands());
  EXPECT_TRUE(ask_and_answer(true));
  EXPECT_FALSE(watch_.toggle_stands());
}

// The question or the answer was lost; only in the second case has the node toggled.
TEST_F(GuardWatchTest, EitherBitIsRightAfterAnUnansweredQuestion) {
  for (const bool toggled : {false, true}) {
    watch_.restart();
    EXPECT_TRUE(ask_and_answer(false));
    ask_in_vain();
    EXPECT_TRUE(ask_and_answer(!toggled)) << toggled;
    EXPECT_TRUE(ask_and_answer(toggled)) << "and from there it toggles";
  }
}

TEST_F(GuardWatchTest, BootUpBeginsWithZeroAgain) {
  EXPECT_TRUE(ask_and_answer(false));
  EXPECT_TRUE(watch_.answered({NmtState::kBootUp, false}));
  EXPECT_TRUE(ask_and_answer(false));
}

TEST_F(GuardWatchTest, NodeWithHeartbeatIsNeverAskedAndAlwaysRight) {
  GuardWatch heartbeat(false, kGuardPeriod_us);
  EXPECT_FALSE(heartbeat.due(1'000'000, kGuardCycle_us));
  for (int i = 0; i < 3; ++i) EXPECT_TRUE(heartbeat.answered({NmtState::kOperational, false}));
}

}  // namespace
}  // namespace sprung
