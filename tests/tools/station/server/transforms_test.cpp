#include "tools/station/server/transforms.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "robots/robot_loader.h"
#include "tools/station/scene/scene.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;

/// The foot of the single leg by a chain of the told transforms, and by the robot's own kinematics.
class LegTransforms : public testing::Test {
 protected:
  void set(const std::string& field, double value) {
    frame_.values[static_cast<std::size_t>(find_field(frames_.fields(), field))] = static_cast<float>(value);
  }
  Eigen::Isometry3d told(const std::string& child) const {
    const Json all = Json::parse(Transforms(scene_, frames_.fields()).json(frame_, 5));
    for (const Json& each : all["transforms"]) {
      if (each["child_frame_id"] != child) continue;
      const Json &t = each["translation"], &q = each["rotation"];
      Eigen::Isometry3d here = Eigen::Isometry3d::Identity();
      here.translate(Eigen::Vector3d(t["x"], t["y"], t["z"]));
      here.rotate(Eigen::Quaterniond(q["w"], q["x"], q["y"], q["z"]));
      return (each["parent_frame_id"] == "world" ? here : told(each["parent_frame_id"]) * here);
    }
    ADD_FAILURE() << "no " << child;
    return Eigen::Isometry3d::Identity();
  }
  const RobotConfig robot_ = load_robot("single_leg");
  const Json scene_ = make_scene(robot_);
  Frames frames_{robot_};
  Frame frame_{1.0, 1, 1, std::vector<float>(frames_.fields().size(), std::nanf(""))};
};

TEST_F(LegTransforms, AChainOfThemIsTheLegsKinematics) {
  const std::vector<double> angles_rad{1.2, 0.7};
  for (std::size_t i = 0; i < 2; ++i)
    set("joints." + robot_.joints[i].name + ".estimated_position_rad", angles_rad[i]);
  const Json& leg = scene_["legs"][0];
  const std::string foot = scene_["bodies"][leg["foot_body"].get<int>()]["name"];
  const std::string base = scene_["bodies"][scene_["base"].get<int>()]["name"];
  const auto vector = [](const Json& json) { return Eigen::Vector3d(json[0], json[1], json[2]); };
  const Eigen::Vector3d foot_in_base = told(base).inverse() * told(foot) * vector(leg["foot_in_body_m"]);
  const auto kinematics = make_leg_kinematics(robot_.legs[0]);
  JointVector joints(2);
  joints << angles_rad[0], angles_rad[1];
  const Eigen::Vector3d expected = kinematics->foot_in_hip_m(kinematics->pose(joints));
  EXPECT_LT((foot_in_base - vector(leg["hip_in_base_m"]) - expected).norm(), 1e-5);
}

TEST_F(LegTransforms, WhatNobodyTellsStaysWhereTheModelHasIt) {
  const Json told = Json::parse(Transforms(scene_, frames_.fields()).json(frame_, 5));
  EXPECT_EQ(told["transforms"].size(), scene_["bodies"].size());
  EXPECT_EQ(told.dump().find("null"), std::string::npos) << "no NaN";
}

TEST(Transforms, ARobotThatCannotBeDrawnHasNone) {
  const Frames frames(load_robot("single_leg"));
  Frame frame{1.0, 1, 1, std::vector<float>(frames.fields().size())};
  EXPECT_EQ(Transforms(Json{{"missing", "why"}}, frames.fields()).json(frame, 0), R"({"transforms":[]})");
}

}  // namespace
}  // namespace sprung::station
