#include "tools/station/server/steered_walk.h"

#include <gtest/gtest.h>

#include "robots/gait_speed.h"
#include "robots/robot_loader.h"

namespace sprung::station {
namespace {

class Steered : public testing::Test {
 protected:
  std::vector<OperatorCommand> said(StickState state, const StickValues& sticks, std::int64_t now_us) {
    std::vector<OperatorCommand> out;
    walk_.step(state, sticks, now_us, out);
    return out;
  }
  const RobotConfig robot_ = load_robot("pegasus");
  SteeredWalk walk_{robot_.gaits};
};

TEST_F(Steered, WalksInTheFastestGaitFromTheDeadMansPressToItsRelease) {
  EXPECT_EQ(robot_.gaits[walk_.gait()].name, "trot");
  EXPECT_TRUE(said(StickState::kReady, {}, 0).empty());
  const auto first = said(StickState::kDriving, {0.5, 0.0, 0.0}, 20'000);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].kind, OperatorKind::kWalk);
  EXPECT_EQ(first[0].hold_s, HeldMotion::kHold_s);
  EXPECT_NEAR(first[0].walk_speed[0], 0.5 * robot_.gaits[walk_.gait()].fastest_forward_m_s, 1e-12);
  EXPECT_TRUE(said(StickState::kDriving, {0.5, 0.0, 0.0}, 40'000).empty());
  EXPECT_EQ(said(StickState::kDriving, {0.5, 0.0, 0.0}, 130'000).at(0).kind, OperatorKind::kHold);
  const auto last = said(StickState::kReady, {}, 140'000);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_LT(last[0].hold_s, 0.01);
  EXPECT_EQ(said(StickState::kReady, {}, 200'000).at(0).kind, OperatorKind::kStop);
}

TEST_F(Steered, LockedSticksEndTheWalkToo) {
  said(StickState::kDriving, {1.0, 0.0, 0.0}, 0);
  said(StickState::kLocked, {}, 20'000);
  EXPECT_FALSE(walk_.active());
}

TEST_F(Steered, AnotherSpeedIsToldAtMostTwentyTimesASecond) {
  said(StickState::kDriving, {0.1, 0.0, 0.0}, 0);
  EXPECT_TRUE(said(StickState::kDriving, {0.2, 0.0, 0.0}, 20'000).empty());
  EXPECT_EQ(said(StickState::kDriving, {0.3, 0.0, 0.0}, 60'000).at(0).kind, OperatorKind::kWalk);
}

TEST_F(Steered, AllSticksAtOnceAskForNoMoreThanTheGaitGoes) {
  const auto& gait = robot_.gaits[walk_.gait()];
  EXPECT_LE(speed_share(gait, walk_.speed({1.0, -1.0, 1.0})), kMostSpeedShare);
  EXPECT_LE(speed_share(gait, walk_.speed({-1.0, 0.0, 0.0})), kMostSpeedShare);
}

TEST_F(Steered, ARefusedWalkIsNotAskedForAgainUntilTheDeadManWasLetGo) {
  said(StickState::kDriving, {1.0, 0.0, 0.0}, 0);
  walk_.ended();
  EXPECT_TRUE(said(StickState::kDriving, {1.0, 0.0, 0.0}, 100'000).empty());
  EXPECT_TRUE(said(StickState::kReady, {}, 120'000).empty());
  EXPECT_EQ(said(StickState::kDriving, {1.0, 0.0, 0.0}, 140'000).at(0).kind, OperatorKind::kWalk);
}

TEST(SteeredWalk, OfARobotWithoutGaitsSaysNothing) {
  SteeredWalk walk({});
  std::vector<OperatorCommand> out;
  walk.step(StickState::kDriving, {1.0, 0.0, 0.0}, 0, out);
  EXPECT_TRUE(out.empty());
  EXPECT_EQ(walk.gait(), -1);
}

}  // namespace
}  // namespace sprung::station
