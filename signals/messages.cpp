/// The signals of every cycle: drives, joints, legs, IMU, and the simulation's truth.
#include "signals/messages.h"

#include "signals/drive_command.h"
#include "signals/drive_state.h"
#include "signals/joint_state.h"
#include "signals/leg_command.h"
#include "signals/message_fields.h"
#include "signals/sensors.h"
#include "signals/simulation.h"

namespace sprung {
namespace {

using fields::read;
using fields::write;

const auto kActuatorState = [](auto& way, auto& m, auto& s) {
  way(m.measured_position_rad, s.measured_position_rad);
  way(m.measured_link_position_rad, s.measured_link_position_rad);
  way(m.measured_velocity_rad_s, s.measured_velocity_rad_s);
  way(m.measured_current_A, s.measured_current_A);
  way(m.measured_supply_V, s.measured_supply_V);
  way(m.fault_code, s.fault_code);
  way(m.age_cycles, s.age_cycles);
  way(m.power_state, s.power_state);
  way(m.shown_mode, s.shown_mode);
  way(m.referenced, s.referenced);
};

const auto kDriveState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n, m.actuators, s.actuators, kActuatorState);
  way(m.safety, s.safety);
};

const auto kActuatorCommand = [](auto& way, auto& m, auto& s) {
  way(m.commanded_torque_Nm, s.commanded_torque_Nm);
  way(m.commanded_position_rad, s.commanded_position_rad);
  way(m.commanded_velocity_rad_s, s.commanded_velocity_rad_s);
  way(m.commanded_damping_Nm_s_rad, s.commanded_damping_Nm_s_rad);
  way(m.mode, s.mode);
};

const auto kDriveCommand = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n, m.actuators, s.actuators, kActuatorCommand);
  way(m.valid_until_utime, s.valid_until_utime_us);
  way(m.used_joint_state_seq, s.used_joint_state_seq);
  way(m.used_leg_command_seq, s.used_leg_command_seq);
};

const auto kEstimatedJoint = [](auto& way, auto& m, auto& s) {
  way(m.estimated_position_rad, s.estimated_position_rad);
  way(m.estimated_velocity_rad_s, s.estimated_velocity_rad_s);
  way(m.estimated_acceleration_rad_s2, s.estimated_acceleration_rad_s2);
  way(m.measured_motor_torque_Nm, s.measured_motor_torque_Nm);
  way(m.motor_side_torque_Nm, s.motor_side_torque_Nm);
  way(m.gear_output_torque_Nm, s.gear_output_torque_Nm);
  way(m.gear_output_torque_bound_Nm, s.gear_output_torque_bound_Nm);
  way(m.friction_torque_Nm, s.friction_torque_Nm);
  way(m.external_torque_Nm, s.external_torque_Nm);
  way(m.estimated_position_bound_rad, s.estimated_position_bound_rad);
  way(m.estimated_velocity_bound_rad_s, s.estimated_velocity_bound_rad_s);
  way(m.estimated_acceleration_bound_rad_s2, s.estimated_acceleration_bound_rad_s2);
  way(m.friction_torque_bound_Nm, s.friction_torque_bound_Nm);
  way(m.external_torque_bound_Nm, s.external_torque_bound_Nm);
  way(m.torsion_torque_Nm, s.torsion_torque_Nm);
  way(m.estimated_temperature_degC, s.estimated_temperature_degC);
  way(m.model.misfit_ratio, s.misfit_ratio);
  way(m.status, s.status);
  way(m.drive_enabled, s.drive_enabled);
  way(m.identified, s.identified);
  way(m.at_rest, s.at_rest);
  way(m.model.model_fits, s.model_fits);
  way(m.model.misfit_reason, s.misfit_reason);
  way(m.model.dry_friction_factor, s.dry_friction_factor);
  way(m.model.viscous_friction_factor, s.viscous_friction_factor);
  way(m.heat.winding_share, s.winding_share);
  way(m.heat.derating_in_s, s.derating_in_s);
};

const auto kEstimatedLeg = [](auto& way, auto& m, auto& s) {
  way(m.estimated_foot_in_hip_m, s.estimated_foot_in_hip_m);
  way(m.estimated_foot_velocity_m_s, s.estimated_foot_velocity_m_s);
  way(m.foot_force_N, s.foot_force_N);
  way(m.foot_force_bound_N, s.foot_force_bound_N);
  way(m.contact_confidence, s.contact_confidence);
  way(m.contact, s.contact);
};

const auto kEstimatedBody = [](auto& way, auto& m, auto& s) {
  way(m.estimated_quaternion_wxyz, s.estimated_quaternion_wxyz);
  way(m.estimated_angular_velocity_rad_s, s.estimated_angular_velocity_rad_s);
  way(m.estimated_velocity_m_s, s.estimated_velocity_m_s);
  way(m.estimated_height_m, s.estimated_height_m);
  way(m.uses_imu, s.uses_imu);
};

const auto kJointState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  kEstimatedBody(way, m.body, s.body);
  way.elements(m.n_joints, m.joints, s.joints, kEstimatedJoint);
  way.elements(m.n_legs, m.legs, s.legs, kEstimatedLeg);
  way(m.safety, s.safety);
  way(m.used_drive_state_seq, s.used_drive_state_seq);
  way(m.used_imu_seq, s.used_imu_seq);
};

const auto kDesiredLeg = [](auto& way, auto& m, auto& s) {
  way(m.desired_foot_in_hip_m, s.desired_foot_in_hip_m);
  way(m.desired_foot_velocity_m_s, s.desired_foot_velocity_m_s);
  way(m.desired_foot_acceleration_m_s2, s.desired_foot_acceleration_m_s2);
  way(m.stiffness_N_m, s.stiffness_N_m);
  way(m.damping_N_s_m, s.damping_N_s_m);
  way(m.feedforward_force_N, s.feedforward_force_N);
  way(m.friction_compensation, s.friction_compensation);
  way(m.velocity_feedforward, s.velocity_feedforward);
  way(m.inertia_compensation, s.inertia_compensation);
  way(m.desired_joint_position_rad, s.desired_joint_position_rad);
  way(m.desired_joint_velocity_rad_s, s.desired_joint_velocity_rad_s);
  way(m.phase, s.phase);
  way(m.control_mode, s.control_mode);
};

const auto kLegCommand = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n_legs, m.legs, s.legs, kDesiredLeg);
  way(m.used_joint_state_seq, s.used_joint_state_seq);
};

const auto kTrueJoint = [](auto& way, auto& m, auto& s) {
  way(m.true_position_rad, s.true_position_rad);
  way(m.true_velocity_rad_s, s.true_velocity_rad_s);
  way(m.true_acceleration_rad_s2, s.true_acceleration_rad_s2);
  way(m.true_motor_torque_Nm, s.true_motor_torque_Nm);
  way(m.true_gear_output_torque_Nm, s.true_gear_output_torque_Nm);
  way(m.true_friction_torque_Nm, s.true_friction_torque_Nm);
  way(m.true_motor_position_rad, s.true_motor_position_rad);
  way(m.true_temperature_degC, s.true_temperature_degC);
};

const auto kTrueLeg = [](auto& way, auto& m, auto& s) {
  way(m.true_foot_in_world_m, s.true_foot_in_world_m);
  way(m.true_contact_force_N, s.true_contact_force_N);
  way(m.true_ground_height_m, s.true_ground_height_m);
};

const auto kSimTruth = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n_joints, m.joints, s.joints, kTrueJoint);
  way.elements(m.n_legs, m.legs, s.legs, kTrueLeg);
  way(m.base_in_world_m, s.base_in_world_m);
  way(m.base_velocity_m_s, s.base_velocity_m_s);
  way(m.base_quaternion_wxyz, s.base_quaternion_wxyz);
  way(m.base_angular_velocity_rad_s, s.base_angular_velocity_rad_s);
  way(m.com_in_world_m, s.com_in_world_m);
  way(m.com_velocity_m_s, s.com_velocity_m_s);
  way(m.true_base_contact_force_N, s.true_base_contact_force_N);
};

const auto kImu = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.measured_angular_velocity_rad_s, s.measured_angular_velocity_rad_s);
  way(m.measured_specific_force_m_s2, s.measured_specific_force_m_s2);
  way(m.measured_quaternion_wxyz, s.measured_quaternion_wxyz);
  way(m.status, s.status);
};

}  // namespace

void to_message(const DriveState& in, std::int64_t session, sprung_msgs::drive_state_t& out) {
  write(kDriveState, in, session, out);
}
void to_message(const DriveCommand& in, std::int64_t session, sprung_msgs::drive_command_t& out) {
  write(kDriveCommand, in, session, out);
}
void to_message(const JointState& in, std::int64_t session, sprung_msgs::joint_state_t& out) {
  write(kJointState, in, session, out);
}
void to_message(const LegCommand& in, std::int64_t session, sprung_msgs::leg_command_t& out) {
  write(kLegCommand, in, session, out);
}
void to_message(const SimTruth& in, std::int64_t session, sprung_msgs::sim_truth_t& out) {
  write(kSimTruth, in, session, out);
}
void to_message(const Imu& in, std::int64_t session, sprung_msgs::imu_t& out) {
  write(kImu, in, session, out);
}

Reading from_message(const sprung_msgs::drive_state_t& in, DriveState& out) {
  return read(kDriveState, in, out);
}
Reading from_message(const sprung_msgs::drive_command_t& in, DriveCommand& out) {
  return read(kDriveCommand, in, out);
}
Reading from_message(const sprung_msgs::joint_state_t& in, JointState& out) {
  return read(kJointState, in, out);
}
Reading from_message(const sprung_msgs::leg_command_t& in, LegCommand& out) {
  return read(kLegCommand, in, out);
}
Reading from_message(const sprung_msgs::sim_truth_t& in, SimTruth& out) { return read(kSimTruth, in, out); }
Reading from_message(const sprung_msgs::imu_t& in, Imu& out) { return read(kImu, in, out); }

}  // namespace sprung
