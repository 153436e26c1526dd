#pragma once
/// What the simulated drives are told, and what they know. No process of the stack reads the truth. Units and
/// frames: lcmtypes/README.md.
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "signals/modes.h"
#include "signals/stamp.h"
#include "signals/vec3.h"

namespace sprung {

struct SimControl {
  Stamp stamp;
  std::int64_t apply_at_seq = -1;
  std::array<double, 6> wrench{};
  double duration_s = 0.0;
  SimControlKind kind = SimControlKind::kWrench;
  std::int32_t actuator = -1;
  std::int32_t bus = -1;
  FaultKind fault = FaultKind::kNone;
  double value = 0.0;
};

struct TrueJoint {
  double true_position_rad = kNaN;
  double true_velocity_rad_s = kNaN;
  double true_acceleration_rad_s2 = kNaN;
  double true_motor_torque_Nm = kNaN;
  double true_gear_output_torque_Nm = kNaN;
  double true_friction_torque_Nm = kNaN;
  double true_motor_position_rad = kNaN;  ///< of the rotor, output side: differs by the gear's torsion
  double true_temperature_degC = kNaN;    ///< of the gear, where the plant has one
};

struct TrueLeg {
  Vec3 true_foot_in_world_m{};
  Vec3 true_contact_force_N{};
  double true_ground_height_m = 0.0;  ///< of the floor under the foot, world
};

struct SimTruth {
  Stamp stamp;
  std::vector<TrueJoint> joints;
  std::vector<TrueLeg> legs;
  Vec3 base_in_world_m{};
  Vec3 base_velocity_m_s{};
  std::array<double, 4> base_quaternion_wxyz{1, 0, 0, 0};  ///< base axes to world axes
  Vec3 base_angular_velocity_rad_s{};                      ///< base axes
  Vec3 com_in_world_m{};                                   ///< of the whole robot
  Vec3 com_velocity_m_s{};
  Vec3 true_base_contact_force_N{};  ///< ground on the base itself, not on its legs; world axes
  SimTruth() = default;
  SimTruth(std::size_t joint_count, std::size_t leg_count) : joints(joint_count), legs(leg_count) {}
};

}  // namespace sprung
