#include "drivers/bridge/drive_position_limits.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
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

  /// Of a range from -3 to 5 rad, at 1000 counts a radian.
  void zero_at(double zero_rad) { limits_.follow(zero_rad, kInside_rad, false); }

  static constexpr double kInside_rad = 1.0;
  DrivePositionLimits limits_{0x607D, {-3.0, 5.0}, 1000.0};
  std::map<int, std::uint32_t> drive_{{1, 0x80000000U}, {2, 0x7FFFFFFFU}};
  bool keeps_ = true;
};

TEST_F(DrivePositionLimitsTest, NothingIsSaidBeforeTheZeroIsKnown) {
  EXPECT_FALSE(limits_.next());
  EXPECT_FALSE(limits_.confirmed()) << "no power";
}

TEST_F(DrivePositionLimitsTest, BothAreWrittenAndReadBackLowestFirst) {
  zero_at(0.0);
  EXPECT_EQ(talk(), 4);
  EXPECT_TRUE(limits_.confirmed());
  EXPECT_EQ(drive(1), -3000);
  EXPECT_EQ(drive(2), 5000);
  zero_at(0.0);
  EXPECT_EQ(talk(), 0) << "the same";
}

TEST_F(DrivePositionLimitsTest, MotorThatTurnsTheOtherWayHasThemTheOtherWayRound) {
  limits_ = DrivePositionLimits(0x607D, {-3.0, 5.0}, -1000.0);
  zero_at(0.0);
  talk();
  EXPECT_EQ(drive(1), -5000);
  EXPECT_EQ(drive(2), 3000);
}

TEST_F(DrivePositionLimitsTest, AnotherZeroMovesThemWhereverItIs) {
  zero_at(0.0);
  talk();
  for (const double zero_rad : {-103.0, 205.0}) {
    zero_at(zero_rad);
    EXPECT_FALSE(limits_.confirmed());
    talk();
    EXPECT_TRUE(limits_.confirmed());
    EXPECT_EQ(drive(1), -3000 - std::lround(1000 * zero_rad));
    EXPECT_EQ(drive(2), 5000 - std::lround(1000 * zero_rad));
  }
}

TEST_F(DrivePositionLimitsTest, JointThatLiesFurtherOutMayComeBackAndThenIsHeldAgain) {
  zero_at(0.0);
  talk();
  limits_.follow(0.0, 5.5, true);
  EXPECT_EQ(talk(), 0) << "not while it has power: it is the drive's to stop it";
  limits_.follow(0.0, 5.5, false);
  EXPECT_EQ(talk(), 4);
  EXPECT_EQ(drive(2), 5600);
  EXPECT_EQ(drive(1), -3000);
  limits_.follow(0.0, 5.3, true);
  EXPECT_EQ(talk(), 0) << "on its way back";
  limits_.follow(0.0, 4.9, true);
  EXPECT_EQ(talk(), 4);
  EXPECT_EQ(drive(2), 5000);
}

TEST_F(DrivePositionLimitsTest, DriveThatKeepsSomethingElseIsRefusedAfterThreeTries) {
  keeps_ = false;
  zero_at(0.0);
  EXPECT_EQ(talk(), 9);
  EXPECT_TRUE(limits_.refused());
  EXPECT_FALSE(limits_.confirmed());
}

TEST_F(DrivePositionLimitsTest, RefusalIsTriedAgainWhenAsked) {
  keeps_ = false;
  zero_at(0.0);
  talk();
  ASSERT_TRUE(limits_.refused());
  keeps_ = true;
  limits_.retry();
  EXPECT_FALSE(limits_.refused());
  talk();
  EXPECT_TRUE(limits_.confirmed());
}

TEST_F(DrivePositionLimitsTest, DriveThatBeganAnewIsToldAgain) {
  zero_at(0.0);
  talk();
  limits_.forget();
  EXPECT_FALSE(limits_.confirmed());
  zero_at(0.0);
  EXPECT_EQ(talk(), 4);
}

/// NMT reset communication leaves it.
TEST_F(DrivePositionLimitsTest, DriveThatKeptOldLimitsTakesNewOnesOnWhicheverSide) {
  for (const double zero_rad : {-103.0, 205.0}) {
    drive_ = {{1, static_cast<std::uint32_t>(-3000)}, {2, 5000}};
    limits_.forget();
    zero_at(zero_rad);
    talk();
    EXPECT_TRUE(limits_.confirmed());
    EXPECT_EQ(drive(1), -3000 - std::lround(1000 * zero_rad));
  }
}

TEST_F(DrivePositionLimitsTest, BeyondWhatTheObjectHoldsIsItsEnd) {
  limits_ = DrivePositionLimits(0x607D, {-5.0, 5.0}, 1e9);
  zero_at(0.0);
  talk();
  EXPECT_EQ(drive(1), std::numeric_limits<std::int32_t>::min());
  EXPECT_EQ(drive(2), std::numeric_limits<std::int32_t>::max());
}

TEST(DrivePositionLimits, WithoutAnObjectOrARangeThereIsNothingToConfirm) {
  for (DrivePositionLimits none :
       {DrivePositionLimits(0, {-3.0, 5.0}, 1e3), DrivePositionLimits(0x607D, {}, 1e3)}) {
    none.follow(0.0, 0.0, false);
    EXPECT_TRUE(none.confirmed());
    EXPECT_FALSE(none.next());
  }
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
