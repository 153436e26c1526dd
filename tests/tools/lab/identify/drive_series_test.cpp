#include "tools/lab/identify/drive_series.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "tests/support/refusal.h"

namespace sprung::identify {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

constexpr double kDriveSeriesCycle_s = 0.005;

/// Hip and knee of single_leg; what a test wants otherwise it changes.
struct Scene {
  double hip_rad = 1.0;
  double knee_rad = 1.0;
  double knee_A = 2.0;
  PowerState power = PowerState::kOperationEnabled;
  int knee_age = 0;
};

DriveState state_of(const Scene& scene, std::int64_t seq) {
  DriveState out(2);
  out.stamp.seq = seq;
  out.stamp.utime_us = seq * 5000;
  for (ActuatorState& a : out.actuators) {
    a.power_state = scene.power;
    a.shown_mode = DriveMode::kTorque;
    a.referenced = true;
    a.age_cycles = 0;
    a.measured_current_A = 0.0;
  }
  out.actuators[0].measured_position_rad = scene.hip_rad;
  out.actuators[1].measured_position_rad = scene.knee_rad;
  out.actuators[1].measured_current_A = scene.knee_A;
  out.actuators[1].age_cycles = scene.knee_age;
  return out;
}

/// The knee swings for `seconds`; `change` sees each scene with its time.
template <class Change>
std::vector<DriveState> swing(double seconds, const Change& change) {
  std::vector<DriveState> out;
  for (std::int64_t k = 0; k < std::llround(seconds / kDriveSeriesCycle_s); ++k) {
    const double t = static_cast<double>(k) * kDriveSeriesCycle_s;
    Scene scene;
    scene.knee_rad = 1.0 + 0.5 * std::sin(t);
    change(scene, t);
    out.push_back(state_of(scene, k));
  }
  return out;
}

const auto kAsItIs = [](Scene&, double) {};

double counted(const DriveSeries& found) {
  double sum = 0.0;
  for (const double w : found.series.weight) sum += w;
  return sum * kDriveSeriesCycle_s;
}

TEST(DriveSeries, TorqueIsCurrentTimesConstantTimesRatioAtTheJoint) {
  const RobotConfig robot = load_robot("single_leg");
  const DriveSeries found = drive_series(robot, 1, swing(5.0, kAsItIs));
  ASSERT_EQ(found.series.time_s.size(), 1000u);
  const ActuatorConfig& a = robot.actuators[1];
  EXPECT_NEAR(found.series.measured_torque[10], 2.0 * a.torque_constant_Nm_A * a.gear_ratio, 1e-12);
  EXPECT_NEAR(found.series.position_rad[200], 1.0 + 0.5 * std::sin(1.0), 1e-12);
  EXPECT_NEAR(found.series.time_s[200], 1.0, 1e-9);
  EXPECT_EQ(found.series.gear_ratio, a.gear_ratio);
  EXPECT_EQ(found.series.torque_unit, "Nm");
  EXPECT_TRUE(found.series.link_position_rad.empty());
  EXPECT_TRUE(found.notes.empty());
  EXPECT_NEAR(found.pose_rad[0], 1.0, 1e-12);
}

TEST(DriveSeries, BeltCouplingIsTakenFromRobotYaml) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].transmission = {1.0, 0.0, 0.5, 1.0};
  const DriveSeries found = drive_series(robot, 1, swing(5.0, kAsItIs));
  EXPECT_NEAR(found.series.position_rad[0], 0.5 * 1.0 + 1.0, 1e-12);
}

TEST(DriveSeries, WhatIsLeftOutIsSaid) {
  const RobotConfig robot = load_robot("single_leg");
  const auto states = swing(20.0, [](Scene& s, double t) {
    if (t < 2.0) s.power = PowerState::kSwitchedOn;
    if (t > 10.0 && t < 13.0) s.hip_rad = 1.3;
    if (t > 15.0 && t < 17.0) s.knee_rad = 1.0;
  });
  const DriveSeries found = drive_series(robot, 1, states);
  EXPECT_NEAR(counted(found), 13.0, 0.3);
  EXPECT_NEAR(found.moving_s, 13.0, 0.3);
  EXPECT_THAT(found.notes, Contains(AllOf(HasSubstr("10 %"), HasSubstr("not enabled"))));
  EXPECT_THAT(found.notes, Contains(HasSubstr("at rest")));
  EXPECT_THAT(found.notes, Contains(AllOf(HasSubstr("15 %"), HasSubstr("another pose"))));
}

TEST(DriveSeries, RepeatedAndStaleSamplesAreLeftOut) {
  const RobotConfig robot = load_robot("single_leg");
  auto states = swing(5.0, [](Scene& s, double t) { s.knee_age = t > 1.0 && t < 2.0 ? 1 : 0; });
  states.insert(states.begin() + 100, states[50]);  // sent again
  const DriveSeries found = drive_series(robot, 1, states);
  EXPECT_NEAR(static_cast<double>(found.series.time_s.size()), 801.0, 1.0);
  for (std::size_t i = 1; i < found.series.time_s.size(); ++i)
    ASSERT_GT(found.series.time_s[i], found.series.time_s[i - 1]);
}

std::string refusal(const std::vector<DriveState>& states, int joint) {
  return test::refusal_of<std::runtime_error>([&] { drive_series(load_robot("single_leg"), joint, states); });
}

TEST(DriveSeries, AJointThatHardlyMovesAloneIsRefusedWithAdvice) {
  EXPECT_THAT(refusal(swing(5.0, kAsItIs), 0),
              AllOf(HasSubstr("joint hip moves alone for only 0"), HasSubstr("at rest"),
                    HasSubstr("sprung identify --record single_leg hip")));
  const auto both = swing(5.0, [](Scene& s, double t) { s.hip_rad = 1.0 + 0.5 * std::sin(3.0 * t); });
  EXPECT_THAT(refusal(both, 1), HasSubstr("another pose"));
  EXPECT_THAT(refusal({}, 1), HasSubstr("no sample"));
}

TEST(DriveSeries, WeightAtTheFootLoadsTheKneeByItsLeverAndIsAcceleratedWithIt) {
  const RobotConfig robot = load_robot("single_leg");
  const auto states = swing(5.0, kAsItIs);
  const DriveSeries found = drive_series(robot, 1, states, 5.0);
  ASSERT_EQ(found.series.load_Nm.size(), found.series.time_s.size());
  EXPECT_TRUE(found.series.load_beside_own);
  // The shank hangs at hip - knee from +x; the knee's flexion turns it the other way (docs/control.md).
  const double shank_m = robot.legs[0].links[1].length_m;
  const double shank_rad = 1.0 - found.series.position_rad[200];
  EXPECT_NEAR(found.series.load_Nm[200], 5.0 * 9.81 * shank_m * std::cos(shank_rad), 1e-9);
  EXPECT_NEAR(found.series.load_inertia_kg_m2[200], 5.0 * shank_m * shank_m, 1e-9);
  EXPECT_TRUE(drive_series(robot, 1, states).series.load_Nm.empty());
}

TEST(DriveSeries, JoinedRecordingsLieApartAndOneWithoutAWeightHasNoLoad) {
  const RobotConfig robot = load_robot("single_leg");
  const auto states = swing(5.0, kAsItIs);
  const DriveSeries both = joined({drive_series(robot, 1, states), drive_series(robot, 1, states, 5.0)});
  ASSERT_EQ(both.series.time_s.size(), 2000u);
  EXPECT_GT(both.series.time_s[1000] - both.series.time_s[999], 0.5);
  EXPECT_EQ(both.series.load_Nm[999], 0.0);
  EXPECT_NE(both.series.load_Nm[1000], 0.0);
  EXPECT_NEAR(both.moving_s, 2.0 * drive_series(robot, 1, states).moving_s, 1e-9);
  EXPECT_EQ(both.series.weight.size(), 2000u);
}

TEST(DriveSeries, RecordingsFromDifferentPosesAreNotJoined) {
  const RobotConfig robot = load_robot("single_leg");
  const auto elsewhere = swing(5.0, [](Scene& s, double t) {
    s.hip_rad = 1.5;
    s.knee_rad = 1.3 + 0.5 * std::sin(t);
  });
  EXPECT_THAT(
      test::refusal_of<std::runtime_error>([&] {
        (void)joined({drive_series(robot, 1, swing(5.0, kAsItIs)), drive_series(robot, 1, elsewhere)});
      }),
      HasSubstr("different poses"));
}

TEST(DriveSeries, WeightAtALegWithoutLinksIsRefused) {
  RobotConfig robot = load_robot("single_leg");
  robot.legs[0].kinematics = kNoKinematics;
  EXPECT_THAT(test::refusal_of<std::invalid_argument>(
                  [&] { (void)drive_series(robot, 1, swing(5.0, kAsItIs), 5.0); }),
              HasSubstr("without --weight"));
}

TEST(DriveSeries, EveryJointHasItsPlaceInALeg) {
  const RobotConfig robot = load_robot("pegasus");
  for (std::size_t j = 0; j < robot.joints.size(); ++j) {
    const LegPlace at = place_of(robot, static_cast<int>(j));
    EXPECT_EQ(robot.legs[at.leg].joints[at.place], static_cast<int>(j));
  }
  EXPECT_THROW(place_of(robot, 99), std::runtime_error);
}

}  // namespace
}  // namespace sprung::identify
