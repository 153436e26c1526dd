/// Geometry of legs in robot.yaml: the shipped pegasus with three-joint legs and a preset, and after one mistake each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
namespace fs = std::filesystem;

std::string shipped(const std::string& robot) {
  std::ifstream in(std::string(SPRUNG_SOURCE_DIR) + "/robots/" + robot + "/robot.yaml");
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void replace(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  ASSERT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
}

/// [C6].
std::string geometry(const std::string& side) {
  return "kinematics: three_joint\n    side: " + side +
         "\n    links:\n"
         "      - {length: 0.08 m, mass: 3.3 kg, com: 0.04 m, inertia: 0.0079 kg m^2}\n"
         "      - {length: 0.30 m, mass: 0.8 kg, com: 0.13 m, inertia: 0.0060 kg m^2}\n"
         "      - {length: 0.30 m, mass: 0.4 kg, com: 0.13 m, inertia: 0.0030 kg m^2}\n"
         "    contact: {on: 25 N, off: 10 N, rise: 4 ms, fall: 6 ms}";
}

class ThreeJointPegasus : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / ("sprung_three_joint_" + std::to_string(getpid()));
    fs::create_directories(folder_);
    text_ = shipped("pegasus");
    for (const char* side : {"left", "right", "left", "right"})
      replace(text_, "kinematics: none", geometry(side));
    const std::string single_leg = shipped("single_leg");
    const std::size_t presets = single_leg.find("\npresets:");
    ASSERT_NE(presets, std::string::npos);
    text_ += single_leg.substr(presets, single_leg.find("\nprocesses:") - presets) + "\n";
  }
  void TearDown() override { fs::remove_all(folder_); }

  RobotConfig load() {
    std::ofstream(folder_ / "robot.yaml") << text_;
    return load_robot(folder_.string());
  }
  std::string complaint(const std::string& from, const std::string& to) {
    replace(text_, from, to);
    try {
      load();
    } catch (const ConfigError& error) {
      return error.what();
    }
    return "nothing was refused";
  }

  fs::path folder_;
  std::string text_;
};

TEST_F(ThreeJointPegasus, HasFourLegsWithSidesAndLinks) {
  const RobotConfig robot = load();
  EXPECT_TRUE(robot.has_feet());
  ASSERT_EQ(robot.legs.size(), 4u);
  for (const LegConfig& leg : robot.legs) {
    EXPECT_EQ(leg.kinematics, kThreeJoint);
    EXPECT_EQ(leg.side, leg.name[1] == 'l' ? LegSide::kLeft : LegSide::kRight) << leg.name;
    ASSERT_EQ(leg.links.size(), 3u);
    EXPECT_DOUBLE_EQ(leg.links[0].length_m, 0.08);
    EXPECT_DOUBLE_EQ(leg.links[2].inertia_kg_m2, 0.0030);
    EXPECT_DOUBLE_EQ(leg.contact_on_N, 25.0);
  }
}

TEST_F(ThreeJointPegasus, SideIsNeededAndIsLeftOrRight) {
  const std::string path = (folder_ / "robot.yaml").string();
  EXPECT_THAT(complaint("    side: left\n", ""), AllOf(HasSubstr(path), HasSubstr("side' is missing")));
  SetUp();
  EXPECT_THAT(complaint("side: left", "side: port"), AllOf(HasSubstr(path + ":"), HasSubstr("legs[0].side"),
                                                           HasSubstr("left or right"), HasSubstr("port")));
}

TEST_F(ThreeJointPegasus, LinksAreCountedAndNamed) {
  EXPECT_THAT(
      complaint("      - {length: 0.08 m, mass: 3.3 kg, com: 0.04 m, inertia: 0.0079 kg m^2}\n", ""),
      AllOf(HasSubstr("legs[0].links"), HasSubstr("three_joint needs 3 (hip, thigh, shank), found 2")));
}

TEST_F(ThreeJointPegasus, OnlyTheOffsetMayBeNothing) {
  replace(text_, "length: 0.08 m", "length: 0.0 m");
  EXPECT_DOUBLE_EQ(load().legs[0].links[0].length_m, 0.0);
  EXPECT_THAT(complaint("length: 0.30 m", "length: 0.0 m"), HasSubstr("links[1].length"));
}

TEST_F(ThreeJointPegasus, UnknownKinematicsAndWrongJointsAreNamed) {
  EXPECT_THAT(complaint("kinematics: three_joint", "kinematics: octopus"),
              AllOf(HasSubstr("one_link, two_link, three_joint, or none"), HasSubstr("octopus")));
  SetUp();
  EXPECT_THAT(complaint("kinematics: three_joint\n    side: left\n", "kinematics: two_link\n"),
              HasSubstr("two_link needs 2 (hip, knee), found 3"));
}

TEST_F(ThreeJointPegasus, PlanarLegsHaveNoSide) {
  text_ = shipped("single_leg");
  EXPECT_THAT(complaint("kinematics: two_link", "kinematics: two_link\n    side: left"),
              HasSubstr("legs[0].side"));
}

}  // namespace
}  // namespace sprung
