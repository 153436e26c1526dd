#include "drivers/bridge/stuck_encoder_watch.h"

#include <gtest/gtest.h>

#include "signals/vec3.h"
#include "tests/support/bridge_fixture.h"

namespace sprung {
namespace {

class StuckEncoderWatchTest : public ::testing::Test {
 protected:
  using Signal = double (*)(int ms);
  static double still(int) { return 0.3; }
  static double none(int) { return kNaN; }
  /// @param mate position of the other joint of the leg.
  /// @return after how many of `ms` samples it was stuck; -1: never.
  int first_stuck(int ms, Signal position, Signal measured, Signal commanded = none, Signal mate = still) {
    for (int i = 0; i < ms; ++i) {
      StuckEncoderInputs in;
      in.time_us = 1000 * i;
      in.position_rad = position(i);
      in.measured_torque_Nm = measured(i);
      in.commanded_torque_Nm = commanded(i);
      in.mate_position_rad = mate(i);
      watch_.add(in);
      if (watch_.stuck()) return i;
    }
    return -1;
  }
  static double steady(int) { return 60.0; }
  static double rises(int ms) { return 5.0 * ms; }
  static double extends(int ms) { return 0.005 * ms; }

  StuckEncoderWatch watch_{100.0};
};

TEST_F(StuckEncoderWatchTest, TorqueOnAJointOfALegThatStandsIsWell) {
  EXPECT_EQ(first_stuck(5000, still, [](int i) { return 60.0 + (i % 30); }), -1);
}

TEST_F(StuckEncoderWatchTest, HighTorqueWhileTheRestOfTheLegMovesIsFound) {
  EXPECT_EQ(first_stuck(100, still, steady, none, extends), 20);
  EXPECT_EQ(watch_.still_us(), 20'000);
  EXPECT_EQ(watch_.torque_Nm(), 60.0);
}

TEST_F(StuckEncoderWatchTest, TorqueBelowHalfOfTheLimitMayBeFrictions) {
  const auto low = [](int) { return 45.0; };
  EXPECT_EQ(first_stuck(1000, still, low, none, extends), -1);
  const auto now_and_then = [](int i) { return i % 15 == 0 ? 45.0 : 90.0; };
  EXPECT_EQ(first_stuck(1000, still, now_and_then, none, extends), -1);
}

TEST_F(StuckEncoderWatchTest, SlowMotionOfTheRestOfTheLegMayLeaveOutAJointThatFrictionHolds) {
  EXPECT_EQ(first_stuck(5000, still, steady, none, [](int i) { return 0.0018 * i; }), -1);
}

TEST_F(StuckEncoderWatchTest, DriveThatRepeatsItsWholeAnswerIsFoundByWhatItWasTold) {
  const auto frozen = [](int) { return 2.0; };
  EXPECT_EQ(first_stuck(100, still, frozen, rises, extends), 30) << "from 10 on above half";
}

TEST_F(StuckEncoderWatchTest, OneCountNowAndThenIsEnough) {
  const auto creeps = [](int i) { return 1e-6 * (i / 15); };
  EXPECT_EQ(first_stuck(1000, creeps, steady, none, extends), -1);
}

TEST_F(StuckEncoderWatchTest, LegThatHasRestedForLongBeginsToMoveTogether) {
  const auto begins = [](int i) { return i < 1003 ? 0.3 : 0.3 + 0.005 * (i - 1003); };
  EXPECT_EQ(first_stuck(1200, begins, steady, none,
                        [](int i) { return i < 1000 ? 0.1 : 0.1 + 0.005 * (i - 1000); }),
            -1);
}

TEST_F(StuckEncoderWatchTest, LinkEncoderThatMovesOnFindsItUnderAnyTorque) {
  const auto after_ms = [](double link_rad_s, double motor_rad_s) {
    StuckEncoderWatch watch(100.0);
    for (int i = 0; i < 1000; ++i) {
      StuckEncoderInputs in;
      in.time_us = 1000 * i;
      in.position_rad = 0.5 + motor_rad_s * 1e-3 * i;
      in.link_position_rad = 0.7 + link_rad_s * 1e-3 * i;
      watch.add(in);
      if (watch.stuck()) return i;
    }
    return -1;
  };
  EXPECT_EQ(after_ms(4.0, 0.0), 20);
  EXPECT_NEAR(after_ms(0.1, 0.0), 41, 1);
  EXPECT_NEAR(after_ms(0.02, 0.0), 201, 1);
  EXPECT_EQ(after_ms(0.5, 0.5), -1);
  EXPECT_EQ(after_ms(kNaN, 0.0), -1);
}

/// A leg that meets the ground at speed: friction holds its hip against half of the limit while its knee
/// moves at 4 rad/s, as in sprung experiment push --robot pegasus, 60 N s forward.
TEST_F(StuckEncoderWatchTest, LinkEncoderThatSeesTheJointHeldIsBelieved) {
  const auto stuck_after_ms = [](double link_amplitude_rad, bool link_fails) {
    StuckEncoderWatch watch(100.0);
    for (int i = 0; i < 200; ++i) {
      StuckEncoderInputs in;
      in.time_us = 1000 * i;
      in.position_rad = 0.5;
      in.measured_torque_Nm = 60.0;
      in.mate_position_rad = 0.004 * i;
      in.link_position_rad = link_fails && i % 7 == 3 ? kNaN : 0.7 + link_amplitude_rad * (i % 3);
      watch.add(in);
      if (watch.stuck()) return i;
    }
    return -1;
  };
  EXPECT_EQ(stuck_after_ms(1e-4, false), -1);
  EXPECT_EQ(stuck_after_ms(0.0, false), 20) << "a card that repeats itself says nothing";
  EXPECT_EQ(stuck_after_ms(1e-4, true), 20) << "nor one that misses samples";
}

TEST_F(StuckEncoderWatchTest, GearThatGivesWayUnderItsTorqueIsWell) {
  const auto stuck = [](double motor_Nm, double stiffness_Nm_rad, double friction_Nm) {
    StuckEncoderWatch watch(100.0);
    for (int i = 0; i < 1000; ++i) {
      StuckEncoderInputs in;
      in.time_us = 1000 * i;
      in.position_rad = 0.5;
      in.measured_torque_Nm = i % 100 < 50 ? motor_Nm : -motor_Nm;
      const double gear_Nm = in.measured_torque_Nm + (i % 200 < 100 ? friction_Nm : -friction_Nm);
      in.link_position_rad = gear_Nm / stiffness_Nm_rad;
      watch.add(in);
    }
    return watch.stuck();
  };
  EXPECT_FALSE(stuck(90.0, 10e3, 10.0));
  EXPECT_FALSE(stuck(0.0, 10e3, 15.0));
  EXPECT_TRUE(stuck(90.0, 4e3, 10.0)) << "no gear is as soft as that";
}

TEST_F(StuckEncoderWatchTest, ForgetsAllWhenTold) {
  first_stuck(100, still, steady, none, extends);
  watch_.forget();
  EXPECT_FALSE(watch_.stuck());
  EXPECT_EQ(first_stuck(15, still, steady, none, extends), -1);
}

class StuckEncoder : public test::PoweredBridge {
 protected:
  void SetUp() override {
    bench_ = test::BridgeBench(test::with_leg(test::two_drive_robot()));
    test::PoweredBridge::SetUp();
  }
};

TEST_F(StuckEncoder, RobotIsDampedAndThatJointGetsNoTorqueByAVelocityThatIsNotThere) {
  for (int i = 0; i < 30; ++i) {
    bench_.drives[1].position_counts += 2086 * 4;  // the other joint moves at 3 rad/s
    bench_.command_all(DriveMode::kTorque, 100.0);
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kDamping);
  EXPECT_EQ(cause(), SafetyCause::kImplausible);
  EXPECT_EQ(bench_.bridge->safety().actuator, 0);
  EXPECT_NE(bench_.detail().find("hip_motor: encoder stuck"), std::string::npos) << bench_.detail();
  EXPECT_EQ(bench_.drives[0].target_torque_permille, 0);
  EXPECT_NE(bench_.drives[0].power, PowerState::kOperationEnabled) << "it would brake by that encoder";
  EXPECT_EQ(bench_.drives[1].power, PowerState::kOperationEnabled);
}

TEST_F(StuckEncoder, AbductionJointMayRestWhileHipAndKneeMove) {
  RobotConfig robot = test::two_drive_robot();
  ActuatorConfig third = robot.actuators.back();
  third.name = "abduction_motor";
  third.node = 3;
  robot.actuators.insert(robot.actuators.begin(), third);
  bench_ = test::BridgeBench(test::with_leg(robot));
  ASSERT_TRUE(bench_.boot());
  bench_.enable();
  for (int i = 0; i < 100; ++i) {
    for (std::size_t k = 1; k < 3; ++k) bench_.drives[k].position_counts += 2086 * 4;
    bench_.command_all(DriveMode::kTorque, 100.0);
    bench_.tick();
  }
  EXPECT_EQ(level(), SafetyLevel::kOperational) << bench_.detail();
}

}  // namespace
}  // namespace sprung
