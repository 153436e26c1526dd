/// A model.xml with a mistake in it, as somebody who makes a robot writes one.
#include "simulation/plant/plant_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "robots/robot_loader.h"
#include "simulation/plant/mujoco_row.h"
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

/// Against the same leg with those values typed into model.xml.
TEST_F(PlantModelTest, ShiftAndLengthAreAsIfModelXmlHadThem) {
  SimConfig config = load_sim_config(robot_, {});
  for (PlantBodyConfig& body : config.plant.bodies) {
    if (body.name == "base") body.shift_m = {0.01, 0.0, 0.02};
    if (body.name == "thigh") body.shift_m = {0.02, 0.01, 0.0};
    if (body.name == "thigh") body.length_factor = 1.1;
    if (body.name == "shank") body.length_factor = 0.9;
  }
  const PlantModel plant = load_plant_model(robot_, config.plant);
  const DataPtr data(mj_makeData(plant.model.get()));
  const int thigh = mj_name2id(plant.model.get(), mjOBJ_BODY, "thigh");
  mj_forward(plant.model.get(), data.get());
  const Vec3 base = vec3(row(data->xpos, plant.index.base_body, 3));
  const Vec3 base_mass = vec3(row(data->xipos, plant.index.base_body, 3));
  const Vec3 mass = vec3(row(data->xipos, thigh, 3));
  const Vec3 foot = vec3(row(data->geom_xpos, plant.index.foot_geom[0], 3));
  EXPECT_NEAR(base_mass[0] - base[0], 0.01, 1e-12);
  EXPECT_NEAR(base_mass[2] - base[2], 0.02, 1e-12);
  EXPECT_NEAR(mass[0] - base[0], 0.13 + 0.02, 1e-12);
  EXPECT_NEAR(mass[1] - base[1], 0.01, 1e-12);
  EXPECT_NEAR(foot[0] - base[0], 1.1 * 0.26 + 0.9 * 0.422, 1e-12) << "stretched forward at zero angles";
  EXPECT_NEAR(data->qfrc_bias[plant.index.joint_dof[0]], -9.81 * (0.8 * 0.15 + 0.3 * (1.1 * 0.26 + 0.211)),
              1e-9);
}

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
