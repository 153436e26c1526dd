/// A model.xml with a mistake in it, as somebody who makes a robot writes one.
#include "simulation/plant/plant_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "robots/robot_loader.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

using testing::HasSubstr;
using testing::Not;

class PlantModelTest : public testing::Test {
 protected:
  /// The shipped model.xml with one text replaced, read from a folder of its own.
  std::string refusal(const std::string& from, const std::string& to) {
    std::ifstream shipped(robot_.folder + "/model.xml");
    std::string text{std::istreambuf_iterator<char>(shipped), {}};
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos) << from;
    text.replace(at, from.size(), to);
    RobotConfig robot = robot_;
    robot.folder = testing::TempDir() + "plant_model_" +
                   testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::create_directories(robot.folder);
    std::ofstream(robot.folder + "/model.xml") << text;
    return test::refusal_of<ConfigError>(
        [&] { (void)load_plant_model(robot, load_sim_config(robot_, {}).plant); });
  }
  RobotConfig robot_ = load_robot(test::source_dir() + "/robots/single_leg");
};

TEST_F(PlantModelTest, ATagThatIsNotClosedIsNamedWithFileLineAndRemedyInOneLine) {
  const std::string text = refusal("<body name=\"thigh\">", "<bdy name=\"thigh\">");
  EXPECT_THAT(text, HasSubstr("/model.xml:16: MuJoCo cannot make a model of it: XML parse error"));
  EXPECT_THAT(text, HasSubstr("XML_ERROR_MISMATCHED_ELEMENT"));
  EXPECT_THAT(text, HasSubstr("XMLElement name=bdy"));
  EXPECT_THAT(text, HasSubstr("; mend that place"));
  EXPECT_THAT(text, Not(HasSubstr("\n")));
}

TEST_F(PlantModelTest, WhatIsNoMjcfIsNamedWithItsLine) {
  const std::string text = refusal("<geom name=\"floor\"", "<geom ceiling=\"3\" name=\"floor\"");
  EXPECT_THAT(text, HasSubstr("/model.xml:11: "));
  EXPECT_THAT(text, HasSubstr("unrecognized attribute: 'ceiling' Element 'geom'"));
}

TEST_F(PlantModelTest, ABodyThatCannotBeIsNamedWithItsLine) {
  const std::string text = refusal("mass=\"4.13\"", "mass=\"-4.13\"");
  EXPECT_THAT(text, HasSubstr("/model.xml:12: "));
  EXPECT_THAT(text, HasSubstr("Object name = base"));
}

}  // namespace
}  // namespace sprung::sim
