#include "tools/station/foxglove/robot_messages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "tools/station/scene/scene.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

class LegMessages : public testing::Test {
 protected:
  void set(const std::string& field, double value) {
    frame_.values[static_cast<std::size_t>(find_field(frames_.fields(), field))] = static_cast<float>(value);
  }
  void set_vector(const std::string& field, const Eigen::Vector3d& v) {
    set(field + ".x", v.x());
    set(field + ".y", v.y());
    set(field + ".z", v.z());
  }
  Eigen::Isometry3d in_world(const std::string& child) const {
    for (const FoxgloveTransform& each : messages_.transforms(frame_))
      if (each.child == child) return each.parent == "world" ? each.pose : in_world(each.parent) * each.pose;
    ADD_FAILURE() << "no " << child;
    return Eigen::Isometry3d::Identity();
  }
  std::string message(RobotTopic topic) const { return messages_.message(topic, frame_, 5'000'000'007); }

  const RobotConfig robot_ = load_robot("single_leg");
  const Json scene_ = make_scene(robot_);
  Frames frames_{robot_};
  RobotMessages messages_{robot_, scene_, frames_.fields()};
  Frame frame_{1.0, 1, 1, std::vector<float>(frames_.fields().size(), std::nanf(""))};
};

/// By a chain of the told transforms, and by the robot's own kinematics.
TEST_F(LegMessages, AChainOfTransformsIsTheLegsKinematics) {
  const std::vector<double> angles_rad{1.2, 0.7};
  for (std::size_t i = 0; i < 2; ++i)
    set("joints." + robot_.joints[i].name + ".estimated_position_rad", angles_rad[i]);
  const Json& leg = scene_["legs"][0];
  const std::string foot = scene_["bodies"][leg["foot_body"].get<int>()]["name"];
  const std::string base = scene_["bodies"][scene_["base"].get<int>()]["name"];
  const auto vector = [](const Json& json) { return Eigen::Vector3d(json[0], json[1], json[2]); };
  const Eigen::Vector3d foot_in_base = in_world(base).inverse() * in_world(foot) *
                                       vector(leg["foot_in_body_m"]);
  const auto kinematics = make_leg_kinematics(robot_.legs[0]);
  JointVector joints(2);
  joints << angles_rad[0], angles_rad[1];
  const Eigen::Vector3d expected = kinematics->foot_in_hip_m(kinematics->pose(joints));
  EXPECT_LT((foot_in_base - vector(leg["hip_in_base_m"]) - expected).norm(), 1e-5);
}

TEST_F(LegMessages, WhatNobodyTellsStaysWhereTheModelHasIt) {
  const auto told = messages_.transforms(frame_);
  ASSERT_EQ(told.size(), scene_["bodies"].size());
  for (const FoxgloveTransform& each : told) EXPECT_TRUE(each.pose.matrix().allFinite()) << each.child;
}

TEST_F(LegMessages, AnImuThatNobodyHasIsNoMessage) {
  EXPECT_EQ(message(RobotTopic::kImu), "");
  set_vector("imu.measured_angular_velocity_rad_s", {0.1, 0.2, 0.3});
  set_vector("imu.measured_specific_force_m_s2", {0.0, 0.0, 9.81});
  EXPECT_EQ(message(RobotTopic::kImu),
            imu_sample("base", Eigen::Vector3f(0.1F, 0.2F, 0.3F).cast<double>(),
                       Eigen::Vector3f(0.0F, 0.0F, 9.81F).cast<double>(), 5'000'000'007));
}

TEST_F(LegMessages, AFootInTheAirHasAWrenchOfZeroAndOneThatNobodyFeelsHasNone) {
  EXPECT_EQ(message(RobotTopic::kWrenches), "");
  set_vector("legs.leg.foot_force_N", {1.0, 2.0, 300.0});
  set("legs.leg.contact", 0.0);
  const std::string in_the_air = message(RobotTopic::kWrenches);
  EXPECT_NE(in_the_air, "");
  set("legs.leg.contact", 1.0);
  EXPECT_NE(message(RobotTopic::kWrenches), in_the_air);
}

TEST_F(LegMessages, EveryTopicHasASchemaOfItsType) {
  for (const RobotTopic topic : kRobotTopics) {
    const std::string type = type_of(topic);
    EXPECT_THAT(foxglove_schema(type), testing::HasSubstr(type.substr(type.find('.') + 1))) << type;
  }
}

}  // namespace
}  // namespace sprung::station
