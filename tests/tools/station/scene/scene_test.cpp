#include "tools/station/scene/scene.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "model/leg_kinematics.h"
#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"

namespace sprung::station {
namespace {

using Json = nlohmann::json;
using testing::HasSubstr;

Eigen::Isometry3d placed(const Json& thing) {
  const auto p = thing["position_m"].get<std::vector<double>>();
  const auto q = thing["quaternion_wxyz"].get<std::vector<double>>();
  return Eigen::Translation3d(p[0], p[1], p[2]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]);
}

/// Of a body in the base, joints at these angles: what the page's script does.
Eigen::Isometry3d body_in_base(const Json& scene, int body, const std::map<std::string, double>& angles) {
  if (body == scene["base"].get<int>()) return Eigen::Isometry3d::Identity();
  const Json& one = scene["bodies"][static_cast<std::size_t>(body)];
  Eigen::Isometry3d pose = placed(one);
  if (one.contains("joint")) {
    const Json& joint = one["joint"];
    const auto axis = joint["axis"].get<std::vector<double>>();
    const auto at = joint["position_m"].get<std::vector<double>>();
    const Eigen::Translation3d anchor(at[0], at[1], at[2]);
    const double angle = angles.at(joint["name"]) - joint["zero"].get<double>();
    pose = pose * anchor * Eigen::AngleAxisd(angle, Eigen::Vector3d(axis[0], axis[1], axis[2])) *
           anchor.inverse();
  }
  return body_in_base(scene, one["parent"], angles) * pose;
}

/// The scene's feet are where the stack's own kinematics has them.
TEST(Scene, FeetAreWhereTheLegKinematicsHasThem) {
  for (const char* name : {"single_leg", "pegasus", "fennec"}) {
    const RobotConfig robot = load_robot(name);
    const Json scene = make_scene(robot);
    std::map<std::string, double> angles;
    for (std::size_t i = 0; i < robot.joints.size(); ++i) {
      const JointConfig& joint = robot.joints[i];
      angles[joint.name] = joint.position_min_rad + (0.3 + 0.02 * static_cast<double>(i)) *
                                                        (joint.position_max_rad - joint.position_min_rad);
    }
    for (std::size_t i = 0; i < robot.legs.size(); ++i) {
      const LegConfig& leg = robot.legs[i];
      JointVector position(static_cast<Eigen::Index>(leg.joints.size()));
      for (std::size_t j = 0; j < leg.joints.size(); ++j)
        position[static_cast<Eigen::Index>(
            j)] = angles[robot.joints[static_cast<std::size_t>(leg.joints[j])].name];
      const Eigen::Vector3d right = to_eigen(leg.hip_in_trunk_m) +
                                    make_leg_kinematics(leg)->foot_in_hip_m(position);
      const auto in_body = scene["legs"][i]["foot_in_body_m"].get<std::vector<double>>();
      const Eigen::Vector3d foot = body_in_base(scene, scene["legs"][i]["foot_body"], angles) *
                                   Eigen::Vector3d(in_body[0], in_body[1], in_body[2]);
      EXPECT_NEAR((foot - right).norm(), 0.0, 1e-6) << name << " " << leg.name;
    }
  }
}

TEST(Scene, HasLimitsAndFrictionWithTheirSource) {
  const Json leg = make_scene(load_robot("single_leg"));
  EXPECT_EQ(leg["joints"][1]["name"], "knee");
  EXPECT_EQ(leg["joints"][1]["torque_limit_Nm"], 171.6);
  EXPECT_EQ(leg["joints"][1]["max_rad"], 2.62);
  EXPECT_EQ(leg["friction_coefficient"], 0.7);
  EXPECT_EQ(leg["friction_source"], "sim.yaml, contact");
  const RobotConfig pegasus = load_robot("pegasus");
  const Json walker = make_scene(pegasus, "best");
  EXPECT_EQ(walker["friction_coefficient"], pegasus.preset("best").walk.floor_friction);
  EXPECT_FALSE(walker["base_fixed"].get<bool>());
  EXPECT_TRUE(make_scene(load_robot("test_axis"))["base_fixed"].get<bool>());
}

TEST(Scene, ShowsWhatViewersShowAndNoMarkOfTheContact) {
  const Json scene = make_scene(load_robot("pegasus"));
  int feet = 0;
  for (const Json& body : scene["bodies"]) {
    for (const Json& shape : body["shapes"]) {
      EXPECT_NE(shape["kind"], "plane");
      EXPECT_GT(shape["size_m"][0].get<double>(), 0.003) << "a corner of the trunk, group 3";
      feet += shape.contains("foot") ? 1 : 0;
    }
  }
  EXPECT_EQ(feet, 4);
}

TEST(Scene, AModelThatLacksWhatTheRobotNeedsIsNamed) {
  const test::OwnFolder folder("scene");
  RobotConfig robot = load_robot("single_leg");
  robot.folder = folder.path().string();
  const auto refusal = [&] { return test::refusal_of<ConfigError>([&] { make_scene(robot); }); };
  EXPECT_THAT(refusal(), HasSubstr("model.xml"));
  std::ofstream(folder / "model.xml")
      << "<mujoco><worldbody><body name='base'><joint name='hip' type='hinge'/>"
         "<geom size='0.1'/></body></worldbody></mujoco>";
  EXPECT_THAT(refusal(), HasSubstr("model.xml has no joint named knee"));
}

TEST(Scene, AMeshComesWithItsTriangles) {
  const test::OwnFolder folder("scene");
  RobotConfig robot = load_robot("single_leg");
  robot.folder = folder.path().string();
  std::ofstream(folder / "model.xml")
      << "<mujoco><asset><mesh name='m' vertex='0 0 0 1 0 0 0 1 0 0 0 1'/></asset><worldbody><body "
         "name='base'>"
         "<joint name='hip' type='hinge'/><geom type='mesh' mesh='m'/><body><joint name='knee' type='hinge'/>"
         "<geom name='leg_foot' size='0.02'/></body></body></worldbody></mujoco>";
  const Json scene = make_scene(robot);
  ASSERT_EQ(scene["meshes"].size(), 1u);
  EXPECT_EQ(scene["meshes"][0]["vertices_m"].size(), 12u);
  EXPECT_EQ(scene["meshes"][0]["triangles"].size(), 12u);
  EXPECT_EQ(scene["bodies"][0]["shapes"][0]["kind"], "mesh");
}

}  // namespace
}  // namespace sprung::station
