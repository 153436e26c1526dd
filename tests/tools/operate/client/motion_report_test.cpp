#include "tools/operate/client/motion_report.h"

#include <gmock/gmock.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "signals/modes.h"
#include "signals/vec3.h"

namespace sprung {
namespace {

using testing::Contains;
using testing::Each;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsSupersetOf;
using testing::Not;

class MotionReport : public testing::Test {
 protected:
  MotionReport() {
    robot_.legs.resize(2);
    robot_.legs[0].name = "left";
    robot_.legs[1].name = "right";
    robot_.body.mass_kg = 10.0;
    robot_.gaits.resize(2);
    robot_.gaits[1].name = "hop";
    motion_.emplace();
    motion_->state = static_cast<std::int8_t>(MotionPhase::kWalking);
    motion_->state_name = "walking";
    motion_->last_transition = "walk requested";
    motion_->gait = 1;
    motion_->estimated_ground_slope_bound[0] = motion_->estimated_payload_kg = kNaN;
    motion_->gait_phase = 0.25;
    motion_->desired_speed[0] = 0.3;
    motion_->desired_speed[2] = -0.1;
    motion_->legs.resize(2);
    for (auto& leg : motion_->legs) leg = sprung_msgs::motion_leg_t{};
    motion_->legs[0].phase = static_cast<std::int8_t>(LegPhase::kSwing);
    motion_->legs[0].phase_time_s = 0.125;
    motion_->legs[1].phase = static_cast<std::int8_t>(LegPhase::kStance);
    motion_->legs[1].last_event = static_cast<std::int8_t>(LegEvent::kSlip);
    motion_->legs[1].event_counts[static_cast<int>(LegEvent::kEarlyContact)] = 3;
    motion_->legs[1].event_counts[static_cast<int>(LegEvent::kSlip)] = 1;
    joints_.emplace();
    tilt(0.1);
    joints_->body.estimated_height_m = 0.5;
    joints_->body.uses_imu = 1;
  }
  void tilt(double roll_rad) {
    double* wxyz = joints_->body.estimated_quaternion_wxyz;
    wxyz[0] = std::cos(0.5 * roll_rad);
    wxyz[1] = std::sin(0.5 * roll_rad);
    wxyz[2] = wxyz[3] = 0.0;
  }
  std::vector<std::string> lines() const {
    return motion_lines(motion_json(robot_, motion_), body_json(robot_, joints_));
  }

  RobotConfig robot_;
  std::optional<sprung_msgs::motion_state_t> motion_;
  std::optional<sprung_msgs::joint_state_t> joints_;
};

TEST_F(MotionReport, WalkingRobotSaysGaitBodyAndWhatBefellItsLegs) {
  EXPECT_THAT(
      lines(),
      ElementsAre(
          "motion  walking: walk requested",
          "gait    hop, phase 0.25; wanted 0.300 m/s forward, 0.000 m/s to the left, turning -0.100 rad/s",
          "body    roll 5.7 deg, pitch 0.0 deg, yaw 0.0 deg, height 0.500 m; attitude from the IMU",
          "leg     left       swing for 0.12 s",
          "leg     right      stance for 0.00 s; so far 3 early contact, 1 slip"));
}

TEST_F(MotionReport, WalkingRobotSaysHowTheGroundLiesAndWhatItCarries) {
  motion_->estimated_ground_slope[0] = 0.1;
  motion_->estimated_ground_slope[1] = -0.05;
  motion_->estimated_ground_slope_bound[0] = 0.01;
  motion_->estimated_ground_slope_bound[1] = 0.02;
  motion_->estimated_payload_kg = 6.0;
  motion_->estimated_payload_bound_kg = 1.5;
  motion_->estimated_payload_in_trunk_m[0] = 0.2;
  motion_->estimated_payload_in_trunk_m[1] = -0.06;
  EXPECT_THAT(lines(),
              IsSupersetOf({"ground  rises 5.7 deg forward, within 0.6; -2.9 deg to the left, within 1.1",
                            "load    6.0 kg, within 1.5, 0.20 m before and 0.06 m right of the "
                            "middle of the hips"}));
  motion_->estimated_payload_kg = -1.0;
  EXPECT_THAT(lines(), Contains("load    none that is felt, within 1.5 kg"));
  motion_->estimated_payload_kg = -2.0;
  EXPECT_THAT(lines(), Contains("load    -2.0 kg, within 1.5: lighter than robot.yaml says"));
}

TEST_F(MotionReport, SaysWhereItIsOnceItKnows) {
  sprung_msgs::body_state_t odometry{};
  odometry.estimated_position_in_world_m[0] = kNaN;
  EXPECT_TRUE(body_json(robot_, joints_, 0.0, odometry)["place"].is_null());
  odometry.estimated_position_in_world_m[0] = 3.25;
  odometry.estimated_position_in_world_m[1] = -0.5;
  odometry.position_covariance_m2[0] = 0.0025;
  odometry.position_covariance_m2[4] = 0.0001;
  odometry.slips = 2;
  EXPECT_THAT(motion_lines(motion_json(robot_, motion_), body_json(robot_, joints_, 0.0, odometry)),
              Contains("place   3.25 m forward, 0.50 m to the right of where it began, within 0.10 m; 2 feet "
                       "slipped"));
}

TEST_F(MotionReport, StandingRobotHasNoGaitAndOnlyLegsThatSomethingBefell) {
  motion_->state = static_cast<std::int8_t>(MotionPhase::kStanding);
  motion_->state_name = "standing";
  const auto json = motion_json(robot_, motion_);
  EXPECT_TRUE(json["gait"].is_null()) << "a walk that ended by itself leaves its number";
  EXPECT_THAT(lines(), ElementsAre(HasSubstr("standing"), HasSubstr("body"), HasSubstr("right")));
}

TEST_F(MotionReport, WithoutAnImuItSaysWhereTheAttitudeComesFromAndUnknownIsNull) {
  joints_->body.uses_imu = 0;
  joints_->body.estimated_height_m = kNaN;
  for (double& q : joints_->body.estimated_quaternion_wxyz) q = kNaN;
  const auto body = body_json(robot_, joints_);
  EXPECT_TRUE(body["height_m"].is_null());
  EXPECT_TRUE(body["roll_rad"].is_null());
  EXPECT_EQ(lines()[2],
            "body    roll unknown, pitch unknown, yaw unknown, height unknown; no IMU: attitude from the "
            "standing feet");
}

TEST_F(MotionReport, EventsAreCountedByName) {
  const auto leg = motion_json(robot_, motion_)["legs"][1];
  EXPECT_EQ(leg["name"], "right");
  EXPECT_EQ(leg["last_event"], "slip");
  EXPECT_EQ(leg["events"]["early contact"], 3);
  EXPECT_EQ(leg["events"]["no ground"], 0);
  EXPECT_EQ(leg["events"].size(), kLegEventCount - 1);
}

TEST_F(MotionReport, RobotWithoutBodyOrGaitsSaysItsStateAlone) {
  robot_.body.mass_kg = 0.0;
  robot_.gaits.clear();
  EXPECT_TRUE(body_json(robot_, joints_).is_null());
  EXPECT_FALSE(motion_json(robot_, motion_).contains("gait"));
  EXPECT_THAT(lines(), ElementsAre("motion  walking: walk requested"));
}

TEST_F(MotionReport, WhatWasHeardLongAgoIsCalledStaleWithItsAge) {
  robot_.gaits.clear();
  const auto told = [&](double motion_s, double joints_s) {
    return motion_lines(motion_json(robot_, motion_, motion_s), body_json(robot_, joints_, joints_s));
  };
  EXPECT_THAT(told(0.1, 0.1), Each(Not(HasSubstr("STALE"))));
  EXPECT_EQ(told(0.94, 0.1)[0],
            "motion  walking: walk requested; STALE: nothing heard of the motion planner for 0.9 s");
  EXPECT_THAT(told(0.1, 0.94)[1], HasSubstr("; STALE: nothing heard of the torque estimator for 0.9 s"));
  EXPECT_TRUE(motion_json(robot_, motion_, 0.94)["stale"].get<bool>());
  EXPECT_FALSE(motion_json(robot_, motion_, 0.1)["stale"].get<bool>());
}

TEST_F(MotionReport, NothingHeardIsUnknown) {
  EXPECT_THAT(motion_lines(motion_json(robot_, std::nullopt), body_json(robot_, std::nullopt)),
              ElementsAre("motion  unknown: nothing heard of the motion planner"));
}

}  // namespace
}  // namespace sprung
