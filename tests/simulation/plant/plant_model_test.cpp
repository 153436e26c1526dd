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
  EXPECT_THAT(text, HasSubstr("/model.xml:52: MuJoCo cannot make a model of it: XML parse error"));
  EXPECT_THAT(text, HasSubstr("XML_ERROR_MISMATCHED_ELEMENT"));
  EXPECT_THAT(text, HasSubstr("XMLElement name=bdy"));
  EXPECT_THAT(text, HasSubstr("; mend that place"));
  EXPECT_THAT(text, Not(HasSubstr("\n")));
}

TEST_F(PlantModelTest, WhatIsNoMjcfIsNamedWithItsLine) {
  const std::string text = refusal("<geom name=\"floor\"", "<geom ceiling=\"3\" name=\"floor\"");
  EXPECT_THAT(text, HasSubstr("/model.xml:40: "));
  EXPECT_THAT(text, HasSubstr("unrecognized attribute: 'ceiling' Element 'geom'"));
}

TEST_F(PlantModelTest, ABodyThatCannotBeIsNamedWithItsLine) {
  const std::string text = refusal("mass=\"4.13\"", "mass=\"-4.13\"");
  EXPECT_THAT(text, HasSubstr("/model.xml:44: "));
  EXPECT_THAT(text, HasSubstr("Object name = base"));
}

/// Debian's MuJoCo; later ones: tests/mujoco/run.
class ShippedModel : public testing::TestWithParam<const char*> {
 protected:
  static inline std::string warned_;
  const std::string folder_ = test::source_dir() + "/robots/" + GetParam();
};

TEST_P(ShippedModel, LoadsAndRunsWithoutAWarning) {
  const auto before = mju_user_warning;
  warned_.clear();
  mju_user_warning = [](const char* text) { warned_ += text; };
  char said[1000] = "";
  const ModelPtr model(mj_loadXML((folder_ + "/model.xml").c_str(), nullptr, said, sizeof said));
  ASSERT_NE(model, nullptr) << said;
  const DataPtr data(mj_makeData(model.get()));
  for (int i = 0; i < 400; ++i) mj_step(model.get(), data.get());
  mju_user_warning = before;
  EXPECT_STREQ(said, "");
  EXPECT_EQ(warned_, "");
  for (const mjWarningStat& warning : data->warning) EXPECT_EQ(warning.number, 0);
}

TEST_P(ShippedModel, WhatIsOnlyToBeSeenMeetsNothingAndWeighsNothing) {
  const ModelPtr bare = load_model_xml(folder_ + "/model.xml");
  ASSERT_GT(bare->nlight, 0);
  ASSERT_GT(bare->ncam, 0);
  const RobotConfig robot = load_robot(folder_);
  const PlantModel plant = load_plant_model(robot, load_sim_config(robot, {}).plant);
  int shapes = 0;
  for (int geom = 0; geom < bare->ngeom; ++geom) {
    if (bare->geom_group[geom] != 2) continue;
    ++shapes;
    EXPECT_EQ(bare->geom_contype[geom] | bare->geom_conaffinity[geom], 0);
    EXPECT_THAT(plant.index.ground_geom, Not(testing::Contains(geom)));
    for (int pair = 0; pair < bare->npair; ++pair)
      EXPECT_TRUE(bare->pair_geom1[pair] != geom && bare->pair_geom2[pair] != geom);
  }
  EXPECT_GE(shapes, 5);
}

INSTANTIATE_TEST_SUITE_P(Robots, ShippedModel,
                         testing::Values("fennec", "pegasus", "single_leg", "test_axis"));

TEST_F(PlantModelTest, ASphereThatMeetsNothingIsNoPlaceThatTheGroundPushes) {
  EXPECT_EQ(refusal("<geom name=\"leg_foot\"",
                    "<geom class=\"shape\" type=\"sphere\" pos=\"0.5 0 0\" size=\"0.1\"/>"
                    "<geom name=\"leg_foot\""),
            "not refused");
  RobotConfig robot = robot_;
  robot.folder = testing::TempDir() + "plant_model_ASphereThatMeetsNothingIsNoPlaceThatTheGroundPushes";
  const PlantModel plant = load_plant_model(robot, load_sim_config(robot_, {}).plant);
  EXPECT_EQ(plant.index.ground_geom, plant.index.foot_geom);
}

}  // namespace
}  // namespace sprung::sim
