#include "drivers/bridge/drive_position_limits.h"

#include <gtest/gtest.h>

#include <map>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

/// A drive that keeps what is written, and refuses a lowest limit above the highest.
class DrivePositionLimitsTest : public testing::Test {
 protected:
  /// @return transfers that it took until there was nothing to do, at most 20.
  int talk() {
    int transfers = 0;
    for (; transfers < 20; ++transfers) {
      const auto next = limits_.next();
      if (!next) break;
      EXPECT_EQ(next->object.index, 0x607D);
      limits_.took(!next->write || writes(*next), drive_[next->object.sub]);
    }
    return transfers;
  }
  bool writes(const LimitTransfer& transfer) {
    std::map<int, std::uint32_t> after = drive_;
    after[transfer.object.sub] = transfer.value;
    if (static_cast<std::int32_t>(after[1]) > static_cast<std::int32_t>(after[2])) return false;
    if (keeps_) drive_ = after;
    return true;
  }
  std::int32_t drive(int sub) { return static_cast<std::int32_t>(drive_[sub]); }

  DrivePositionLimits limits_{0x607D};
  std::map<int, std::uint32_t> drive_{{1, 0x80000000U}, {2, 0x7FFFFFFFU}};
  bool keeps_ = true;
};

TEST_F(DrivePositionLimitsTest, NothingIsSaidBeforeTheZeroIsKnown) {
  EXPECT_FALSE(limits_.next());
  EXPECT_FALSE(limits_.confirmed()) << "no power";
}

TEST_F(DrivePositionLimitsTest, BothAreWrittenAndReadBackLowestFirstWhicheverWayTheMotorTurns) {
  limits_.want(5000, -3000);
  EXPECT_EQ(talk(), 4);
  EXPECT_TRUE(limits_.confirmed());
  EXPECT_EQ(drive(1), -3000);
  EXPECT_EQ(drive(2), 5000);
  limits_.want(-3000, 5000);
  EXPECT_EQ(talk(), 0) << "the same";
}

TEST_F(DrivePositionLimitsTest, AnotherZeroMovesThemWhereverItIs) {
  limits_.want(-3000, 5000);
  talk();
  for (const auto& [low, high] : {std::pair(100000, 108000), std::pair(-208000, -200000)}) {
    limits_.want(low, high);
    EXPECT_FALSE(limits_.confirmed());
    talk();
    EXPECT_TRUE(limits_.confirmed());
    EXPECT_EQ(drive(1), low);
    EXPECT_EQ(drive(2), high);
  }
}

TEST_F(DrivePositionLimitsTest, DriveThatKeepsSomethingElseIsRefusedAfterThreeTries) {
  keeps_ = false;
  limits_.want(-3000, 5000);
  EXPECT_EQ(talk(), 9);
  EXPECT_TRUE(limits_.refused());
  EXPECT_FALSE(limits_.confirmed());
}

TEST_F(DrivePositionLimitsTest, DriveThatBeganAnewIsToldAgain) {
  limits_.want(-3000, 5000);
  talk();
  limits_.forget();
  EXPECT_FALSE(limits_.confirmed());
  limits_.want(-3000, 5000);
  EXPECT_EQ(talk(), 4);
}

/// NMT reset communication leaves it.
TEST_F(DrivePositionLimitsTest, DriveThatKeptOldLimitsTakesNewOnesOnWhicheverSide) {
  for (const auto& [low, high] : {std::pair(100000, 108000), std::pair(-208000, -200000)}) {
    drive_ = {{1, static_cast<std::uint32_t>(-3000)}, {2, 5000}};
    limits_.forget();
    limits_.want(low, high);
    talk();
    EXPECT_TRUE(limits_.confirmed());
    EXPECT_EQ(drive(1), low);
    EXPECT_EQ(drive(2), high);
  }
}

TEST_F(DrivePositionLimitsTest, RefusalIsTriedAgainWhenAsked) {
  keeps_ = false;
  limits_.want(-3000, 5000);
  talk();
  ASSERT_TRUE(limits_.refused());
  keeps_ = true;
  limits_.retry();
  EXPECT_FALSE(limits_.refused());
  talk();
  EXPECT_TRUE(limits_.confirmed());
}

TEST_F(DrivePositionLimitsTest, BeyondWhatTheObjectHoldsIsItsEnd) {
  limits_.want(-5'000'000'000, 5'000'000'000);
  talk();
  EXPECT_EQ(drive(1), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(drive(2), std::numeric_limits<std::int32_t>::max());
}

TEST(DrivePositionLimits, WithoutAnObjectThereIsNothingToConfirm) {
  DrivePositionLimits none(0);
  none.want(-3000, 5000);
  EXPECT_TRUE(none.confirmed());
  EXPECT_FALSE(none.next());
}

TEST(DriveRange, IsThatOfTheJointAndAMarginWhereNothingIsCoupled) {
  const RobotConfig robot = load_robot("pegasus");
  for (const LegConfig& leg : robot.legs) {
    for (std::size_t i = 0; i < leg.joints.size(); ++i) {
      const PositionRange range = drive_range(robot, leg.actuators[i]);
      EXPECT_NEAR(range.low_rad, robot.joints[leg.joints[i]].position_min_rad - 0.1, 1e-9);
      EXPECT_NEAR(range.high_rad, robot.joints[leg.joints[i]].position_max_rad + 0.1, 1e-9);
    }
  }
}

TEST(DriveRange, OfACoupledActuatorGoesAsFarAsBothJointsLetIt) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].transmission = {1, 0, 1, 1};  // joint 1 = actuator 0 + actuator 1
  const PositionRange range = drive_range(robot, robot.legs[0].actuators[1]);
  const JointConfig& hip = robot.joints[0];
  const JointConfig& knee = robot.joints[1];
  EXPECT_NEAR(range.low_rad, knee.position_min_rad - hip.position_max_rad - 0.2, 1e-9);
  EXPECT_NEAR(range.high_rad, knee.position_max_rad - hip.position_min_rad + 0.2, 1e-9);
}

}  // namespace
}  // namespace sprung
