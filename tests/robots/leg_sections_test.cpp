/// Geometry of legs in robot.yaml: the shipped pegasus, and after one mistake each.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/changed_robot.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ThreeJointPegasus : public testing::Test {
 protected:
  RobotConfig load() const { return folder_.load(text_); }
  std::string complaint(const std::string& from, const std::string& to) const {
    return folder_.complaint(test::replaced(text_, from, to));
  }

  test::RobotFolder folder_;
  std::string text_ = test::shipped_yaml("pegasus");
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
    EXPECT_DOUBLE_EQ(leg.contact_on_N, 40.0);
  }
}

TEST_F(ThreeJointPegasus, SideIsNeededAndIsLeftOrRight) {
  const std::string path = folder_.yaml_path();
  EXPECT_THAT(complaint("    side: left\n", ""), AllOf(HasSubstr(path), HasSubstr("side' is missing")));
  EXPECT_THAT(complaint("side: left", "side: port"), AllOf(HasSubstr(path + ":"), HasSubstr("legs[0].side"),
                                                           HasSubstr("left or right"), HasSubstr("port")));
}

TEST_F(ThreeJointPegasus, LinksAreCountedAndNamed) {
  EXPECT_THAT(
      complaint("      - {length: 0.08 m, mass: 3.3 kg, com: 0.04 m, inertia: 0.0079 kg m^2}\n", ""),
      AllOf(HasSubstr("legs[0].links"), HasSubstr("three_joint needs 3 (hip, thigh, shank), found 2")));
}

TEST_F(ThreeJointPegasus, OnlyTheOffsetMayBeNothing) {
  text_ = test::replaced(text_, "length: 0.08 m", "length: 0.0 m");
  EXPECT_DOUBLE_EQ(load().legs[0].links[0].length_m, 0.0);
  EXPECT_THAT(complaint("length: 0.30 m", "length: 0.0 m"), HasSubstr("links[1].length"));
}

TEST_F(ThreeJointPegasus, UnknownKinematicsAndWrongJointsAreNamed) {
  EXPECT_THAT(complaint("kinematics: three_joint", "kinematics: octopus"),
              AllOf(HasSubstr("one_link, two_link, three_joint, or none"), HasSubstr("octopus")));
  EXPECT_THAT(complaint("kinematics: three_joint\n    side: left\n", "kinematics: two_link\n"),
              HasSubstr("two_link needs 2 (hip, knee), found 3"));
}

TEST_F(ThreeJointPegasus, PlanarLegsHaveNoSide) {
  text_ = test::shipped_yaml("single_leg");
  EXPECT_THAT(complaint("kinematics: two_link", "kinematics: two_link\n    side: left"),
              HasSubstr("legs[0].side"));
}

}  // namespace
}  // namespace sprung
