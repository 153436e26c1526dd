#pragma once
/// Rotors that turn with more than one joint: a knee whose motor sits at the hip and drives it through a
/// parallelogram. Their inertia and their gear's friction belong to the motor's speed, a sum of joint speeds,
/// so that the joints' equations are coupled (facts physics 14).
#include <mujoco/mujoco.h>

#include <cstddef>
#include <vector>

#include "robots/robot_config.h"
#include "simulation/plant/sim_config.h"

namespace sprung::sim {

struct Linkage {
  struct Part {
    std::size_t joint = 0;  ///< index into RobotConfig::joints
    int dof = -1;
    double share = 0.0;  ///< motor speed (output side of its gear) for each rad/s of the joint
  };
  std::size_t gear = 0;  ///< index into RobotConfig::joints: whose gear values sim.yaml has; the first part
  int tendon = -1;       ///< carries the dry friction
  double armature_kg_m2 = 0.0;
  std::vector<Part> parts;

  const Part& own() const noexcept { return parts.front(); }
  /// Sum of the joints' values, e.g. their speeds, as the motor has it. @param values of degrees of freedom.
  double of_motor(const mjtNum* values) const noexcept;
};

/// One for each actuator of robot.yaml's transmission that turns with several joints; model.xml has a fixed
/// tendon `<joint>_linkage` over the same ones. Writes shares, armature and friction into the model, which
/// has them by joint.
/// @param joint_dof of RobotConfig::joints. @throws ConfigError also on torsion, which goes with plain gears
/// only.
std::vector<Linkage> link_rotors(mjModel& model, const std::vector<int>& joint_dof, const RobotConfig& robot,
                                 const PlantConfig& config);

/// As mj_step, with the rotors' coupled inertia.
void step_linked(const mjModel* model, mjData* data, const std::vector<Linkage>& linkages) noexcept;

}  // namespace sprung::sim
