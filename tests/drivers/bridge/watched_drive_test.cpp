// What a drive's own watches find stops the robot: each by itself is tested beside it.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "signals/angles.h"
#include "tests/support/bridge_bench.h"

namespace sprung {
namespace {

using test::BridgeBench;
using ::testing::HasSubstr;

/// Two joints of which motor and gear are known.
RobotConfig robot_with_inertia(const RobotConfig& drives = test::two_drive_robot()) {
  RobotConfig robot = test::with_leg(drives);
  for (JointConfig& joint : robot.joints) joint.armature_kg_m2 = 0.82;
  return robot;
}

void expect_stop(const BridgeBench& bench, SafetyCause cause, const char* text) {
  EXPECT_EQ(bench.bridge->safety().level, SafetyLevel::kDamping);
  EXPECT_EQ(bench.bridge->safety().cause, cause);
  EXPECT_TRUE(bench.bridge->safety().latched);
  EXPECT_THAT(bench.detail(), HasSubstr(text));
}

TEST(WatchedDrive, EncoderThatJittersStopsTheRobotAndHasNoPower) {
  BridgeBench bench(robot_with_inertia());
  ASSERT_TRUE(bench.boot());
  bench.enable();
  for (int i = 0; i < 25; ++i) {
    bench.drives[0].position_counts += i % 2 == 0 ? 20'000 : -20'000;  // 10 mrad
    bench.tick();
  }
  expect_stop(bench, SafetyCause::kImplausible, "hip_motor: encoder noisy: it jitters by");
  EXPECT_NE(bench.drives[0].power, PowerState::kOperationEnabled);
  EXPECT_EQ(bench.drives[1].power, PowerState::kOperationEnabled) << "it damps";
}

TEST(WatchedDrive, JointThatRunsIntoItsStopStopsTheRobot) {
  BridgeBench bench(robot_with_inertia());
  ASSERT_TRUE(bench.boot());
  bench.enable();
  for (int i = 0; i < 60; ++i) {
    bench.drives[0].position_counts += 280 * std::min(i, 50);  // 7 rad/s
    bench.tick();
  }
  ASSERT_EQ(bench.bridge->safety().level, SafetyLevel::kOperational) << bench.detail();
  bench.run(13);
  expect_stop(bench, SafetyCause::kImplausible, "hip_motor: hit something: its speed changed by -");
  EXPECT_FALSE(bench.bridge->reference(0).known) << "its gear may have slipped";
  EXPECT_EQ(bench.drives[0].power, PowerState::kOperationEnabled) << "its encoder is believed: it damps";
}

/// A foot that is stubbed, a robot that is pushed, goes on; but not against a stop, and not with a gear that
/// slipped.
TEST(WatchedDrive, JointOfALinkEncoderThatIsHitGoesOnAndOneThatPushesOrSlippedStops) {
  for (const std::string then : {"nothing", "pushes", "slips"}) {
    BridgeBench bench(robot_with_inertia(test::robot_with_card()));
    ASSERT_TRUE(bench.boot());
    bench.enable();
    const double link_counts = -1048576.0 / (2.0 * kPi) / 2e6;  // for each of the motor's, behind its gear
    std::int64_t slipped = 0;
    const auto move = [&](std::int64_t counts) {
      bench.drives[0].position_counts += static_cast<std::int32_t>(counts);
      const auto link = std::llround(link_counts * static_cast<double>(bench.drives[0].position_counts)) -
                        slipped;
      bench.cards[0].sample.counts[0] = static_cast<std::uint32_t>(link & 0xFFFFF);
      bench.tick();
    };
    for (int i = 0; i < 60; ++i) move(280 * std::min(i, 50));
    for (int i = 0; i < 20; ++i) move(0);
    ASSERT_EQ(bench.bridge->safety().level, SafetyLevel::kOperational) << bench.detail();
    EXPECT_TRUE(bench.bridge->reference(0).known);
    if (then == "nothing") continue;
    if (then == "pushes") {
      bench.drives[0].torque_permille = 4000;  // 123 of 172 Nm
      for (int i = 0; i < 70; ++i) move(0);
      expect_stop(bench, SafetyCause::kImplausible, "hip_motor: hit something");
      continue;
    }
    slipped = 10'000;  // 60 mrad
    for (int i = 0; i < 13; ++i) move(20);
    expect_stop(bench, SafetyCause::kImplausible, "hip_motor: motor encoder says");
    EXPECT_FALSE(bench.bridge->reference(0).known);
  }
}

TEST(WatchedDrive, WindingThatIsFarTooWarmStopsTheRobot) {
  RobotConfig robot = test::two_drive_robot();
  robot.actuators[0].winding_time_constant_s = 1.0;
  BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.drives[0].torque_permille = 1500;  // of the rated current: 2.25 times as warm in the end
  bench.run(700);
  EXPECT_EQ(bench.bridge->safety().level, SafetyLevel::kOperational) << bench.detail();
  bench.run(100);
  expect_stop(bench, SafetyCause::kWinding, "hip_motor: its winding is 20 % beyond");
}

TEST(WatchedDrive, DriveThatSaysThatItIsTooHotStopsTheRobotAndIsShown) {
  RobotConfig robot = test::two_drive_robot();
  robot.actuators[0].temperature = {{0x22A2, 0, 2, true, 0.1}, 85.0};
  robot.battery = {0,  20, {0x6060, 0, 4, false, 1.0}, {0x6081, 0, 1, false, 0.01}, {0x6010, 0, 2, true, 0.1},
                   0.1};
  BridgeBench bench(robot);
  bench.drives[0].objects[{0x22A2, 0}] = 600;
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.run(2000);
  EXPECT_EQ(bench.bridge->safety().level, SafetyLevel::kOperational) << bench.detail();
  EXPECT_EQ(bench.bridge->auxiliary_state().measured_temperature_degC[0], 60.0);
  EXPECT_TRUE(std::isnan(bench.bridge->auxiliary_state().measured_temperature_degC[1])) << "it has no sensor";
  EXPECT_TRUE(std::isnan(bench.bridge->auxiliary_state().battery_voltage_V)) << "there is none on the bus";
  bench.drives[0].objects[{0x22A2, 0}] = 911;
  for (int i = 0; i < 1100 && bench.bridge->safety().level == SafetyLevel::kOperational; ++i) bench.tick();
  expect_stop(bench, SafetyCause::kDriveFault, "hip_motor: 91 degC, robot.yaml allows 85 degC: let it cool");
}

TEST(WatchedDrive, OneThatDoesNotGiveTheTemperatureThatRobotYamlLimitsIsRefused) {
  RobotConfig robot = test::two_drive_robot();
  robot.actuators[0].temperature = {{0x22A2, 0, 2, false, 1.0}, 85.0};
  BridgeBench bench(robot);
  EXPECT_FALSE(bench.boot());
  EXPECT_THAT(bench.detail(),
              HasSubstr("hip_motor: robot.yaml watches 0x22A2:00, which the drive does not give"));
  EXPECT_THAT(bench.detail(), HasSubstr("type another or none"));
  EXPECT_EQ(bench.enabled(), 0);
}

TEST(WatchedDrive, OneWhoseEmergencyInputIsNotKnownKeepsEveryDriveWithoutPower) {
  RobotConfig robot = test::two_drive_robot();
  robot.actuators[0].emergency_input = {0, false};
  BridgeBench bench(robot);
  ASSERT_TRUE(bench.boot());
  bench.enable();
  bench.run(200);
  EXPECT_EQ(bench.enabled(), 0) << "the drive does not say";
  bench.drives[0].objects[{canopen::kDigitalInputs, 0}] = 1;
  bench.run(200);
  bench.enable();
  EXPECT_EQ(bench.enabled(), 2) << bench.detail();
}

TEST(WatchedDrive, OneThatKeepsOtherPositionLimitsStopsTheRobot) {
  RobotConfig robot = test::with_leg(test::two_drive_robot(), 1.0);
  robot.actuators[0].position_limits_object = 0x607D;
  BridgeBench bench(robot);
  bench.drives[0].clamped[{0x607D, 1}] = 0;
  ASSERT_TRUE(bench.boot());
  bench.run(100);
  expect_stop(bench, SafetyCause::kDriveRefused, "hip_motor: does not keep its position limits 0x607D");
}

}  // namespace
}  // namespace sprung
