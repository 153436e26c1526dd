#include "simulation/plant/world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "robots/robot_loader.h"
#include "simulation/sim_core.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"

namespace sprung::sim {
namespace {

World world_of(const std::string& yaml) { return read_world(YamlMap::parse(yaml, "w.yaml")); }

std::string refused_world(const std::string& yaml) {
  return test::refusal_of<ConfigError>([&] { (void)world_of(yaml); });
}

RobotConfig pegasus() { return load_robot(test::source_dir() + "/robots/pegasus"); }

TEST(World, StairsAreStepsOnTopOfOneAnother) {
  const World world = world_of(
      "world: a flight\nground: {stairs: [{steps: 3, from: 1 m, tread: 0.3 m, rise: 0.1 m}]}\n");
  EXPECT_EQ(world.what, "a flight");
  EXPECT_FALSE(world.friction);
  const Ground ground(world.ground, 0.0, 1);
  EXPECT_EQ(ground.under(0, 0.9, 5.0).point_m[2], 0.0);
  EXPECT_NEAR(ground.under(0, 1.2, 5.0).point_m[2], 0.1, 1e-12);
  EXPECT_NEAR(ground.under(0, 1.5, 5.0).point_m[2], 0.2, 1e-12);
  EXPECT_NEAR(ground.under(0, 9.0, 5.0).point_m[2], 0.3, 1e-12);
}

TEST(World, HoldsRampsRoughnessPatchesAndAFloorsFriction) {
  const World world = world_of(
      "world: all\nfriction: 0.7\nground:\n  begins: 0.8 m\n  rough: {height: 0.02 m, grid: 0.4 m}\n"
      "  ramps: [{from: 1 m, length: 2 m, slope: 0.1 rad}]\n"
      "  patches: [{from: 3 m, length: 1 m, right: -1 m, width: 1 m, friction: 0.2}]\n");
  EXPECT_EQ(world.friction, 0.7);
  EXPECT_EQ(world.ground.begins_m, 0.8);
  EXPECT_EQ(world.ground.rough_m, 0.02);
  EXPECT_EQ(world.ground.rough_grid_m, 0.4);
  ASSERT_EQ(world.ground.ramps.size(), 1u);
  EXPECT_EQ(world.ground.ramps[0].slope_rad, 0.1);
  ASSERT_EQ(world.ground.patches.size(), 1u);
  EXPECT_EQ(world.ground.patches[0].friction, 0.2);
  EXPECT_EQ(world.ground.patches[0].area.width_m, 1.0);
}

TEST(World, WhatIsWrongIsRefusedWithItsLine) {
  EXPECT_NE(refused_world("world: a\nground: {walls: 3}\n").find("w.yaml:2"), std::string::npos);
  EXPECT_NE(refused_world("world: a\nground: {}\nsky: blue\n").find("sky"), std::string::npos);
  EXPECT_NE(refused_world("world: a\nground: {stairs: [{steps: 0, from: 1 m, tread: 0.3 m, rise: 0.1 m}]}\n")
                .find("steps"),
            std::string::npos);
  EXPECT_NE(refused_world("ground: {}\n").find("world"), std::string::npos);
}

TEST(World, EveryOneThatIsShippedHoldsARobot) {
  int worlds = 0;
  for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() + "/robots/worlds")) {
    SimOptions sim;
    sim.plant[kWorldKey + entry.path().stem().string()] = 1.0;
    EXPECT_NO_THROW(SimCore(pegasus(), sim)) << entry.path();
    ++worlds;
  }
  EXPECT_GE(worlds, 6);
}

TEST(World, OfANameThatThereIsNotSaysWhichThereAre) {
  const std::string refused = test::refusal_of<ConfigError>([] { (void)world_path(pegasus(), "mars"); });
  EXPECT_NE(refused.find("no world 'mars'"), std::string::npos) << refused;
  EXPECT_NE(refused.find("stairs"), std::string::npos) << refused;
  EXPECT_THROW((void)world_path(pegasus(), "/nowhere/x.yaml"), ConfigError);
}

TEST(World, ARobotIsInOneAndKeysChangeThatOne) {
  std::map<std::string, double> two{{std::string(kWorldKey) + "ice", 1},
                                    {std::string(kWorldKey) + "hills", 1}};
  PlantConfig plant;
  EXPECT_THROW(take_world(pegasus(), two, plant), ConfigError);
  const SimConfig config = load_sim_config(
      pegasus(), {{std::string(kWorldKey) + "ice", 1}, {"patch_friction", 0.3}, {"ground_friction", 0.5}});
  ASSERT_EQ(config.plant.ground.patches.size(), 2u);
  for (const GroundPatch& patch : config.plant.ground.patches) EXPECT_EQ(patch.friction, 0.3);
  EXPECT_EQ(config.plant.contact.friction, 0.5);
}

}  // namespace
}  // namespace sprung::sim
