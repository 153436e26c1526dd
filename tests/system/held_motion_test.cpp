/// Motions that last while somebody is there, as an operator types them.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::HasSubstr;
using Clock = std::chrono::steady_clock;

/// Real time: a hold is renewed by the wall clock.
class RealTimeHeld : public SystemTest {
 protected:
  std::string state() const {
    return nlohmann::json::parse(sprung("status --json").output)["motion"]["state"].get<std::string>();
  }
  bool comes_to(const std::string& wanted, double timeout_s) const {
    const auto end = Clock::now() + std::chrono::duration<double>(timeout_s);
    while (Clock::now() < end)
      if (state() == wanted) return true;
    return false;
  }
  /// `sprung comply` in the foreground of another terminal, complying.
  std::unique_ptr<ChildProcess> comply() {
    up("realtime");
    EXPECT_EQ(sprung("stand").status, 0);
    auto child = std::make_unique<ChildProcess>(test::bin_dir() + "/sprung",
                                                std::vector<std::string>{"comply"}, Output::kCaptured);
    EXPECT_TRUE(comes_to("complying", kTimeout_s));
    std::this_thread::sleep_for(std::chrono::seconds(2));  // more than one hold
    EXPECT_EQ(state(), "complying") << "while the command runs";
    EXPECT_FALSE(child->ended());
    return child;
  }
};

TEST_F(RealTimeHeld, MotionEndsInAStandWhenWhoHeldItIsGone) {
  const auto child = comply();
  child->signal(SIGKILL);
  EXPECT_TRUE(comes_to("standing", 2.0 + 1.0)) << "1 s for the commands that look";
  EXPECT_THAT(sprung("status").output, HasSubstr("the operator's hold was not renewed"));
}

TEST_F(RealTimeHeld, InterruptEndsInAStandAndIsWaitedFor) {
  const auto child = comply();
  child->signal(SIGINT);
  EXPECT_TRUE(child->wait(kTimeout_s));
  EXPECT_EQ(child->ended(), 0) << child->output();
  EXPECT_EQ(state(), "standing");
}

TEST_F(RealTimeHeld, StopOfSomebodyElseEndsTheCommandThatHeld) {
  const auto child = comply();
  EXPECT_EQ(sprung("stop").status, 0);
  EXPECT_TRUE(child->wait(kTimeout_s));
  EXPECT_THAT(child->output(), HasSubstr("comply: has ended"));
}

TEST_F(RealTimeHeld, MotionForATimeReturnsAtOnceAndEndsByItself) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  EXPECT_EQ(sprung("comply --for 4").status, 0);
  EXPECT_EQ(state(), "complying");
  EXPECT_TRUE(comes_to("standing", kTimeout_s));
  for (const char* wrong : {"comply --for 0", "comply --for -1", "comply --for 4000", "comply --no-wait"})
    EXPECT_EQ(sprung(wrong).status, 2) << wrong;
}

/// An enabling device: what `sprung hold` in another terminal is.
class RealTimeMaintenance : public RealTimeHeld {
 protected:
  void SetUp() override {
    RealTimeHeld::SetUp();
    up("realtime", "--maintenance");
    holder_ = std::make_unique<ChildProcess>(test::bin_dir() + "/sprung", std::vector<std::string>{"hold"},
                                             Output::kCaptured);
    std::this_thread::sleep_for(std::chrono::seconds(1));
    ASSERT_FALSE(holder_->ended()) << holder_->output();
  }
  std::unique_ptr<ChildProcess> holder_;
};

TEST_F(RealTimeMaintenance, NothingMovesUnlessSomebodyHolds) {
  EXPECT_THAT(sprung("status").output, HasSubstr("maintenance mode"));
  EXPECT_EQ(sprung("stand").status, 0);
  EXPECT_THAT(sprung("jump").output, HasSubstr("maintenance mode: the robot neither jumps nor walks"));
  holder_->signal(SIGKILL);
  std::this_thread::sleep_for(std::chrono::seconds(1));
  EXPECT_EQ(state(), "standing");
  EXPECT_THAT(sprung("comply --for 2").output, HasSubstr("nobody holds"));
  EXPECT_EQ(sprung("sit").status, 0) << "to sit down needs nobody";
}

class HoldCommand : public SystemTest {};

TEST_F(HoldCommand, WithoutMaintenanceIsRefusedAndSoIsMaintenanceInLockStep) {
  up("lockstep");
  const auto hold = sprung("hold");
  EXPECT_EQ(hold.status, 1);
  EXPECT_THAT(hold.output, HasSubstr("is not in maintenance mode"));
  EXPECT_THAT(sprung("up single_leg --sim --clock lockstep --maintenance --instance other").output,
              HasSubstr("without --clock lockstep"));
}

}  // namespace
}  // namespace sprung
