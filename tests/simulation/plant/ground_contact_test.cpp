#include "simulation/plant/ground_contact.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "robots/robot_loader.h"
#include "simulation/plant/mujoco_row.h"
#include "simulation/plant/plant.h"
#include "tests/support/own_folder.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

Ground with_step(double from_m, double height_m) {
  GroundConfig config;
  config.steps = {{{from_m}, height_m}};
  return Ground(config, 0.0, 1);
}

TEST(UnevenFloor, DecidesForAllButFeetOnItsOwnPlaneAlone) {
  const Ground ground = with_step(1.0, 0.1);
  const std::vector<int> feet{7, 8};
  const UnevenFloor floor(ground, 3, feet);
  EXPECT_TRUE(floor.decides(3, 5));
  EXPECT_FALSE(floor.decides(3, 7));
  EXPECT_FALSE(floor.decides(4, 5));
}

TEST(UnevenFloor, SphereMeetsTheStepBelowItself) {
  const Ground ground = with_step(1.0, 0.1);
  const std::vector<int> feet;
  const UnevenFloor floor(ground, 0, feet);
  mjContact contact{};
  const mjtNum before[3] = {0.9, 0.2, 0.11}, on[3] = {1.5, 0.2, 0.11};
  EXPECT_EQ(floor.meet(before, 0.02, 0.0, contact), 0);
  ASSERT_EQ(floor.meet(on, 0.02, 0.0, contact), 1);
  EXPECT_NEAR(contact.dist, -0.01, 1e-12);
  EXPECT_NEAR(contact.pos[2], 0.09, 1e-12);
  EXPECT_EQ(contact.frame[2], 1.0);
  EXPECT_EQ(floor.meet(before, 0.02, 0.1, contact), 1) << "as near as MuJoCo wants to know of";
}

/// Where the trunk of a robot is that lies without power for a second, and where it began.
struct Lying {
  Vec3 began_m{}, ended_m{};
  double on_trunk_N = 0.0;  ///< vertical, of the ground
};

Lying lie_on(const GroundConfig& ground, const std::string& folder = test::source_dir() + "/robots/pegasus") {
  const RobotConfig robot = load_robot(folder);
  PlantConfig config = load_sim_config(robot, {{"lying", 1.0}}).plant;
  config.ground = ground;
  Plant plant(robot, config);
  SimTruth truth{robot.joints.size(), robot.legs.size()};
  plant.fill_truth(truth);
  Lying out;
  out.began_m = truth.base_in_world_m;
  const std::vector<double> none(robot.joints.size(), 0.0);
  for (double t_s = 0.0; t_s < 1.0; t_s += config.step_s) plant.step(none);
  EXPECT_FALSE(plant.failed()) << plant.failure();
  plant.fill_truth(truth);
  out.ended_m = truth.base_in_world_m;
  out.on_trunk_N = truth.true_base_contact_force_N[2];
  return out;
}

TEST(UnevenFloor, TrunkThatLiesIsCarriedByTheGround) {
  constexpr double kTrunk_N = 12.0 * 9.81, kRobot_N = 30.0 * 9.81;
  const double on_trunk_N = lie_on({}).on_trunk_N;
  EXPECT_GT(on_trunk_N, kTrunk_N);
  EXPECT_LE(on_trunk_N, kRobot_N + 1.0);
}

TEST(UnevenFloor, TrunkLiesOnABoardThatNoFootIsOn) {
  GroundConfig board;
  board.steps = {{{0.15, 0.3}, 0.04}};  // across its front skids
  const double level_m = lie_on({}).ended_m[2];
  EXPECT_GT(lie_on(board).ended_m[2], level_m + 0.01);
  EXPECT_LT(lie_on(board).ended_m[2], level_m + 0.045);
}

/// Somebody else's robot may have a hull: MuJoCo has no ground below it but the plane.
TEST(UnevenFloor, RobotWithABoxLiesOnASlope) {
  const test::OwnFolder folder("hulled");
  std::filesystem::copy(test::source_dir() + "/robots/pegasus", folder / "pegasus",
                        std::filesystem::copy_options::recursive);
  const std::string path = folder / "pegasus/model.xml";
  std::ifstream in(path);
  std::string text{std::istreambuf_iterator<char>(in), {}};
  const auto insert = [&text](const std::string& before, const std::string& what) {
    const std::size_t at = text.find(before);
    ASSERT_NE(at, std::string::npos) << before;
    text.insert(at, what);
  };
  insert("<geom name=\"trunk_fl_top\"", "<geom name=\"hull\" type=\"box\" size=\"0.2 0.1 0.02\"/>\n");
  insert("<pair geom1=\"floor\"", "<pair geom1=\"floor\" geom2=\"hull\"/>\n");
  std::ofstream(path) << text;
  GroundConfig slope;
  slope.slope_rad = 0.15;
  const Vec3 as_shipped_m = lie_on(slope).ended_m;
  const Vec3 with_hull_m = lie_on(slope, folder / "pegasus").ended_m;
  for (std::size_t i = 0; i < 3; ++i) EXPECT_NEAR(with_hull_m[i], as_shipped_m[i], 0.01);
}

TEST(SetFriction, RobotSlidesDownWhereItIsSlipperyAlone) {
  GroundConfig slope;
  slope.slope_rad = 0.15;
  const Lying holds = lie_on(slope);
  slope.patches = {{{-50.0}, 0.05}};
  const Lying slides = lie_on(slope);
  EXPECT_NEAR(holds.ended_m[0], holds.began_m[0], 0.02);
  // (g sin - mu g cos) t^2 / 2
  EXPECT_NEAR(slides.ended_m[0] - slides.began_m[0], -0.48, 0.1);
}

TEST(SetFriction, CountsInEveryPairOfThatSphere) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  PlantModel plant = load_plant_model(robot, load_sim_config(robot, {}).plant);
  const int foot = plant.index.foot_geom[1], other = plant.index.foot_geom[0];
  set_friction(*plant.model, foot, 0.11);
  int pairs = 0;
  for (int pair = 0; pair < plant.model->npair; ++pair) {
    const bool of_foot = plant.model->pair_geom1[pair] == foot || plant.model->pair_geom2[pair] == foot;
    const bool of_other = plant.model->pair_geom1[pair] == other || plant.model->pair_geom2[pair] == other;
    const mjtNum* friction = row(plant.model->pair_friction, pair, 5);
    if (of_foot) {
      EXPECT_EQ(friction[0], 0.11);
    }
    if (of_other) {
      EXPECT_NE(friction[1], 0.11);
    }
    pairs += of_foot ? 1 : 0;
  }
  EXPECT_EQ(pairs, 1);
}

}  // namespace
}  // namespace sprung::sim
