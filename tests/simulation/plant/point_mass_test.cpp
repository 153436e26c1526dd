#include "simulation/plant/point_mass.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "robots/robot_loader.h"
#include "simulation/plant/mujoco_row.h"
#include "simulation/plant/plant_model.h"
#include "tests/support/paths.h"

namespace sprung::sim {
namespace {

/// Torques that hold a robot's joints where they stand at the start.
std::vector<double> holding_Nm(const RobotConfig& robot, const std::map<std::string, double>& changes) {
  const SimConfig config = load_sim_config(robot, changes);
  const PlantModel plant = load_plant_model(robot, config.plant);
  const DataPtr data(mj_makeData(plant.model.get()));
  for (std::size_t i = 0; i < robot.joints.size(); ++i)
    data->qpos[plant.index.joint_qpos[i]] = config.plant.joints[i].initial_rad;
  mj_forward(plant.model.get(), data.get());
  std::vector<double> out;
  for (const int dof : plant.index.joint_dof) out.push_back(data->qfrc_bias[dof]);
  return out;
}

TEST(PointMass, AtAFootLoadsJointsByItsLevers) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/single_leg");
  const SimConfig config = load_sim_config(robot, {});
  const std::vector<double> without = holding_Nm(robot, {}), with = holding_Nm(robot, {{"foot_weight", 5.0}});
  const auto& links = robot.legs[0].links;
  const double hip_rad = config.plant.joints[0].initial_rad;
  const double shank_rad = hip_rad - config.plant.joints[1].initial_rad;
  // Angles from +x, positive downward: a weight pulls a link that lies forward down, so holding is negative.
  const double thigh_m = links[0].length_m * std::cos(hip_rad),
               shank_m = links[1].length_m * std::cos(shank_rad);
  EXPECT_NEAR(with[0] - without[0], -5.0 * 9.81 * (thigh_m + shank_m), 0.05);
  EXPECT_NEAR(with[1] - without[1], 5.0 * 9.81 * shank_m, 0.05);
}

TEST(PointMass, BodyAndWeightHaveTheInertiaOfBoth) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/single_leg");
  const PlantModel plant = load_plant_model(robot, load_sim_config(robot, {}).plant);
  mjModel& model = *plant.model;
  const int body = model.geom_bodyid[plant.index.foot_geom[0]];
  const double mass_kg = model.body_mass[body];
  const mjtNum* foot = row(model.geom_pos, plant.index.foot_geom[0], 3);
  mjtNum apart[3];
  mju_sub3(apart, foot, row(model.body_ipos, body, 3));
  const double distance_m = mju_norm3(apart);
  const double before = model.body_inertia[3 * body] + model.body_inertia[3 * body + 1] +
                        model.body_inertia[3 * body + 2];
  add_point_mass(model, body, foot, 2.0);
  const double after = model.body_inertia[3 * body] + model.body_inertia[3 * body + 1] +
                       model.body_inertia[3 * body + 2];
  EXPECT_DOUBLE_EQ(model.body_mass[body], mass_kg + 2.0);
  // The trace grows by twice the reduced mass times the distance squared, whatever the axes.
  EXPECT_NEAR(after - before, 2.0 * mass_kg * 2.0 / (mass_kg + 2.0) * distance_m * distance_m, 1e-9);
  mju_sub3(apart, foot, row(model.body_ipos, body, 3));
  EXPECT_NEAR(mju_norm3(apart), distance_m * mass_kg / (mass_kg + 2.0), 1e-12);
}

TEST(PointMass, PayloadIsCarriedByTheTrunkWhereItWasPut) {
  const RobotConfig robot = load_robot(test::source_dir() + "/robots/pegasus");
  const auto trunk = [&](const std::map<std::string, double>& changes) {
    const PlantModel plant = load_plant_model(robot, load_sim_config(robot, changes).plant);
    const int body = plant.index.base_body;
    const mjtNum* centre = row(plant.model->body_ipos, body, 3);
    return std::array<double, 4>{plant.model->body_mass[body], centre[0], centre[1], centre[2]};
  };
  const auto empty = trunk({});
  const auto loaded = trunk({{"payload", 4.0}, {"payload_x", 0.2}, {"payload_y", -0.1}, {"payload_z", 0.12}});
  EXPECT_DOUBLE_EQ(loaded[0], empty[0] + 4.0);
  const double place[] = {0.2, -0.1, 0.12};
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(loaded[i + 1], (empty[0] * empty[i + 1] + 4.0 * place[i]) / loaded[0], 1e-12);
}

}  // namespace
}  // namespace sprung::sim
