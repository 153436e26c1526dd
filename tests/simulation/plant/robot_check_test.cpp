#include "simulation/plant/robot_check.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>

#include "robots/robot_loader.h"
#include "tests/support/changed_robot.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::Contains;
using testing::ContainsRegex;
using testing::Each;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

/// A copy of pegasus in which one text of one file is another.
class RobotCheck : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "robot_check_" +
              testing::UnitTest::GetInstance()->current_test_info()->name();
    fs::remove_all(folder_);
    fs::copy(test::source_dir() + "/robots/pegasus", folder_);
  }
  void change(const std::string& file, const std::string& from, const std::string& to) {
    std::ifstream in(folder_ / file);
    const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    lines_[file] = test::line_of(text, from);
    std::ofstream(folder_ / file) << test::replaced(text, from, to);
  }
  std::vector<std::string> found(CheckAgainst against = CheckAgainst::kModelAndSim) const {
    return check_robot(load_robot(folder_.string()), against);
  }
  /// "/robot.yaml:12", the line that was changed.
  std::string at(const std::string& file) { return "/" + file + ":" + std::to_string(lines_.at(file)); }

  fs::path folder_;
  std::map<std::string, int> lines_;
};

TEST_F(RobotCheck, AShank10cmShortIsNamed) {
  change("robot.yaml", "{length: 0.30 m, mass: 0.4 kg", "{length: 0.20 m, mass: 0.4 kg");
  EXPECT_THAT(found(),
              Contains(AllOf(HasSubstr("fl's link 2 is long: 0.2 m in "), HasSubstr(at("robot.yaml")),
                             HasSubstr(", 0.3 m in "), ContainsRegex("model.xml:[0-9]+$"))));
}

TEST_F(RobotCheck, AShank10cmShortInTheModelIsNamedWithItsLine) {
  change("model.xml", "<geom name=\"fr_foot\" class=\"foot\"/>",
         "<geom name=\"fr_foot\" class=\"foot\" pos=\"0.2 0 0\"/>");
  const auto all = found();
  EXPECT_THAT(all, Each(HasSubstr("fr's link 2")));
  EXPECT_THAT(all, Contains(AllOf(HasSubstr("0.3 m in"), HasSubstr("0.2 m in"), HasSubstr(at("model.xml")))));
}

TEST_F(RobotCheck, AFootOfAnotherRadiusIsNamed) {
  change("robot.yaml", "    foot_radius: 0.02 m", "    foot_radius: 0.03 m");
  const auto all = found();
  EXPECT_THAT(all, testing::SizeIs(4));  // the leg and its images
  EXPECT_THAT(all,
              Contains(AllOf(HasSubstr("fl's foot has a radius of: 0.03 m in "), HasSubstr(at("robot.yaml")),
                             HasSubstr(", 0.02 m in "), ContainsRegex("model.xml:[0-9]+$"))));
}

TEST_F(RobotCheck, ALegOnTheWrongSideIsNamed) {
  change("robot.yaml", "  - name: fl\n    kinematics: three_joint\n    side: left",
         "  - name: fl\n    kinematics: three_joint\n    side: right");
  EXPECT_THAT(found(),
              Contains(AllOf(HasSubstr("fl's link 0 points at zero to: -y in "), HasSubstr("/robot.yaml:"),
                             HasSubstr(", +y in "), ContainsRegex("model.xml:[0-9]+$"))));
}

TEST_F(RobotCheck, AHipOnTheWrongSideIsNamed) {
  change("robot.yaml", "\nbody: {", "  - {name: hl, hip_in_trunk: {y: -0.12 m}}\n\nbody: {");
  EXPECT_THAT(found(), testing::ElementsAre(AllOf(HasSubstr("hl's hip lies in the trunk at y: -0.12 m in "),
                                                  HasSubstr("/robot.yaml:"), HasSubstr(", 0.12 m in "),
                                                  ContainsRegex("model.xml:[0-9]+$"))));
}

TEST_F(RobotCheck, AFlippedKneeAxisIsNamed) {
  change("model.xml", "<joint name=\"fr_knee\" type=\"hinge\" axis=\"0 -1 0\"",
         "<joint name=\"fr_knee\" type=\"hinge\" axis=\"0 1 0\"");
  EXPECT_THAT(found(), testing::ElementsAre(AllOf(
                           HasSubstr("joint fr_knee turns about: -y (three_joint) in "),
                           HasSubstr("/robot.yaml:"), HasSubstr(", +y in "), HasSubstr(at("model.xml")))));
}

TEST_F(RobotCheck, AMotorsSignIsNamed) {
  change("robot.yaml", "bus: fl, node: 2, flips: left_right,",
         "bus: fl, node: 2, flips: left_right, direction: -1,");
  EXPECT_THAT(found(), Contains(AllOf(HasSubstr("fl_hip_motor's motor and encoder have direction: -1 in "),
                                      HasSubstr(at("robot.yaml")), HasSubstr(", 1 in "),
                                      ContainsRegex("sim.yaml:[0-9]+$"))));
}

TEST_F(RobotCheck, ALinkEncodersSignIsNamed) {
  change("robot.yaml", "{card: fl_card, channel: 2,", "{card: fl_card, channel: 2, direction: 1,");
  EXPECT_THAT(found(), Contains(AllOf(HasSubstr("fl_knee_motor's link encoder has direction: 1 in "),
                                      HasSubstr(at("robot.yaml")), HasSubstr(", -1 in "),
                                      ContainsRegex("sim.yaml:[0-9]+$"))));
}

TEST_F(RobotCheck, ATrunkOfATenthOfItsMassIsNamed) {
  change("robot.yaml", "body: {mass: 12 kg", "body: {mass: 1.2 kg");
  EXPECT_THAT(found(), testing::ElementsAre(AllOf(HasSubstr("the trunk weighs: 1.2 kg in "),
                                                  HasSubstr(at("robot.yaml")), HasSubstr(", 12 kg in "),
                                                  ContainsRegex("sim.yaml:[0-9]+$"))));
  EXPECT_THAT(found(CheckAgainst::kModel),
              testing::ElementsAre(ContainsRegex("12 kg in .*model.xml:[0-9]+$")))
      << "on real buses sim.yaml is not looked at";
}

TEST_F(RobotCheck, AStandLengthBeyondReachIsNamed) {
  change("robot.yaml", "stand_length: 0.525 m", "stand_length: 0.65 m");
  EXPECT_THAT(found(), testing::ElementsAre(AllOf(HasSubstr("best's stand_length: 0.65 m in "),
                                                  HasSubstr(at("robot.yaml")), HasSubstr(", at most 0.599"),
                                                  ContainsRegex("model.xml:[0-9]+$"))));
}

TEST_F(RobotCheck, ANameThatTheModelLacksIsNamed) {
  change("model.xml", "<joint name=\"hl_hip\"", "<joint name=\"hl_hop\"");
  change("model.xml", "<joint joint=\"hl_hip\"", "<joint joint=\"hl_hop\"");
  EXPECT_THAT(found(), testing::ElementsAre(AllOf(HasSubstr("no joint 'hl_hip' in"),
                                                  HasSubstr("model.xml, which"), HasSubstr("robot.yaml:"))));
}

TEST_F(RobotCheck, ARealRobotNeedsNoPlantFile) {
  fs::remove(folder_ / "sim.yaml");
  EXPECT_THAT(found(CheckAgainst::kModel), IsEmpty());
  fs::remove(folder_ / "model.xml");
  EXPECT_FALSE(has_model(load_robot(folder_.string())));
}

class ShippedFiles : public testing::TestWithParam<const char*> {};

TEST_P(ShippedFiles, Agree) {
  const RobotConfig robot = load_robot(GetParam());
  EXPECT_TRUE(has_model(robot));
  EXPECT_THAT(check_robot(robot, CheckAgainst::kModelAndSim), IsEmpty());
  EXPECT_THAT(check_robot(robot, CheckAgainst::kModel), IsEmpty());
}

INSTANTIATE_TEST_SUITE_P(Robots, ShippedFiles,
                         testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

}  // namespace
}  // namespace sprung::sim
