#pragma once
/// model.xml as a MuJoCo model with sim.yaml's values written into it, and where in it the robot's parts are.
/// Start-up only.
#include <mujoco/mujoco.h>

#include <memory>
#include <string>
#include <vector>

#include "simulation/plant/linkage.h"
#include "simulation/plant/sim_config.h"

namespace sprung::sim {

struct ModelDeleter {
  void operator()(mjModel* model) const noexcept { mj_deleteModel(model); }
};
struct DataDeleter {
  void operator()(mjData* data) const noexcept { mj_deleteData(data); }
};
using ModelPtr = std::unique_ptr<mjModel, ModelDeleter>;
using DataPtr = std::unique_ptr<mjData, DataDeleter>;

/// Generalised mass that holds a degree of freedom still: 500 N move it by 2.5 um in 10 ms. Exact to that,
/// and unlike an equality constraint it adds no row to the solver.
inline constexpr double kLockedMass = 1e9;

/// Names that model.xml must have: a body `base`, a plane `floor` (of a robot with several legs also
/// `<leg>_floor`, which meets that leg's foot alone), a joint for each of robot.yaml's, a sphere `<leg>_foot`
/// for each leg, and a base that is fixed, or hangs on a free joint or on slides of which `rail_z` is
/// vertical.
struct PlantIndex {
  int base_body = -1;
  int floor_geom = -1;   ///< of all that is not a foot
  int height_qpos = -1;  ///< of the base; -1 = it is fixed
  int free_qpos = -1;    ///< of the base's free joint; -1 = it has none
  int free_dof = -1;
  std::vector<int> joint_qpos;  ///< of RobotConfig::joints
  std::vector<int> joint_dof;
  std::vector<Linkage> linkages;
  std::vector<int> foot_geom;       ///< of RobotConfig::legs
  std::vector<int> leg_floor_geom;  ///< `<leg>_floor`, else floor_geom
  std::vector<int> ground_geom;     ///< spheres of moving bodies that may meet a floor, feet among them
  bool others_meet_floor = false;   ///< moving bodies have shapes besides spheres that meet something
};

struct PlantModel {
  ModelPtr model;
  PlantIndex index;
};

/// model.xml as it stands, before anything is written into it. @throws ConfigError with its line and MuJoCo's
/// reason.
ModelPtr load_model_xml(const std::string& path);

/// Settings that make friction stick and a contact a real spring: facts physics 1-4.
/// @throws ConfigError when model.xml cannot be read or lacks a name.
PlantModel load_plant_model(const RobotConfig& robot, const PlantConfig& config);

}  // namespace sprung::sim
