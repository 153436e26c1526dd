/// The signals that come now and then: motion, safety, operator, simulation control.
#include <algorithm>
#include <cmath>
#include <cstring>

#include "signals/auxiliary_state.h"
#include "signals/body_state.h"
#include "signals/bus_state.h"
#include "signals/message_fields.h"
#include "signals/messages.h"
#include "signals/motion_state.h"
#include "signals/operator.h"
#include "signals/safety_state.h"
#include "signals/sensors.h"
#include "signals/simulation.h"

namespace sprung {
namespace {

using fields::read;
using fields::write;

const auto kMotionLeg = [](auto& way, auto& m, auto& s) {
  way(m.phase, s.phase);
  way(m.phase_time_s, s.phase_time_s);
  way(m.last_event, s.last_event);
  way(m.event_counts, s.event_counts);
  way(m.estimated_ground_z_m, s.estimated_ground_z_m);
  way(m.estimated_ground_z_bound_m, s.estimated_ground_z_bound_m);
};

const auto kMotionState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n_legs, m.legs, s.legs, kMotionLeg);
  way(m.state, s.state);
  way(m.jumps_done, s.jumps_done);
  way(m.jumps_left, s.jumps_left);
  way(m.jump_height_scale, s.jump_height_scale);
  way(m.estimated_jump_height_m, s.estimated_jump_height_m);
  way(m.jump_mode, s.jump_mode);
  way(m.gait, s.gait);
  way(m.gait_phase, s.gait_phase);
  way(m.desired_speed, s.desired_speed);
  way(m.estimated_ground_slope, s.estimated_ground_slope);
  way(m.estimated_ground_slope_bound, s.estimated_ground_slope_bound);
  way(m.estimated_payload_kg, s.payload.mass_kg);
  way(m.estimated_payload_bound_kg, s.payload.mass_bound_kg);
  way(m.estimated_payload_in_trunk_m, s.payload.in_trunk_m);
};

const auto kSafetyState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.level, s.level);
  way(m.cause, s.cause);
  way(m.latched, s.latched);
  way(m.actuator, s.actuator);
  way(m.since_seq, s.since_seq);
  way(m.commands_refused, s.commands_refused);
  way(m.overruns, s.overruns);
  way(m.missed_cycles, s.missed_cycles);
};

const auto kOperatorCommand = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.request_id, s.request_id);
  way(m.apply_at_seq, s.apply_at_seq);
  way(m.kind, s.kind);
  way(m.jump_mode, s.jump_mode);
  way(m.jump_count, s.jump_count);
  way(m.jump_height_m, s.jump_height_m);
  way(m.jump_forward_m, s.jump_forward_m);
  way(m.stiffness_N_m, s.stiffness_N_m);
  way(m.damping_N_s_m, s.damping_N_s_m);
  way(m.friction_compensation, s.friction_compensation);
  way(m.touchdown_in_s, s.touchdown_in_s);
  way(m.actuator, s.actuator);
  way(m.reference_source, s.reference_source);
  way(m.joint, s.joint);
  way(m.joint_target_rad, s.joint_target_rad);
  way(m.joint_speed_rad_s, s.joint_speed_rad_s);
  way(m.joint_acceleration_rad_s2, s.joint_acceleration_rad_s2);
  way(m.gait, s.gait);
  way(m.walk_speed, s.walk_speed);
  way(m.body_height_m, s.body_height_m);
  way(m.stance_width_m, s.stance_width_m);
  way(m.gait_control, s.gait_control);
  way(m.hold_s, s.hold_s);
  way(m.parameter, s.parameter);
  way(m.parameter_value, s.parameter_value);
};

const auto kOperatorReply = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.request_id, s.request_id);
  way(m.took_effect_at_seq, s.took_effect_at_seq);
  way(m.outcome, s.outcome);
  way(m.parameter, s.parameter);
  way(m.parameter_value, s.parameter_value);
};

const auto kSimControl = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.apply_at_seq, s.apply_at_seq);
  way(m.wrench, s.wrench);
  way(m.duration_s, s.duration_s);
  way(m.kind, s.kind);
  way(m.actuator, s.actuator);
  way(m.bus, s.bus);
  way(m.fault, s.fault);
  way(m.value, s.value);
};

/// The largest emergency code; no push (N), height (m) or jump (rad) of an experiment is larger. The
/// simulation makes counts, steps and codes of these numbers, which must fit.
constexpr double kMostOfAnExperiment = 65535.0;
constexpr double kLongestExperiment_s = 1e7;  ///< what goes on until it is ended is given as 1e6 s

bool is_an_experiment(const SimControl& control) noexcept {
  const auto fits = [](double number) { return std::abs(number) <= kMostOfAnExperiment; };  // false of NaN
  return std::abs(control.duration_s) <= kLongestExperiment_s && fits(control.value) &&
         std::all_of(control.wrench.begin(), control.wrench.end(), fits);
}

const auto kTorqueSensor = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.joint, s.joint);
  way(m.measured_torque_Nm, s.measured_torque_Nm);
};

const auto kBusHealth = [](auto& way, auto& m, auto& s) {
  way(m.load_share, s.load_share);
  way(m.sent, s.sent);
  way(m.received, s.received);
  way(m.send_failed, s.send_failed);
  way(m.no_buffers, s.no_buffers);
  way(m.dropped, s.dropped);
  way(m.malformed, s.malformed);
  way(m.unexpected, s.unexpected);
  way(m.error_frames, s.error_frames);
  way(m.bus_offs, s.bus_offs);
  way(m.restarts, s.restarts);
  way(m.condition, s.condition);
};

const auto kNodeHealth = [](auto& way, auto& m, auto& s) {
  way(m.reference_offset_rad, s.reference_offset_rad);
  way(m.emergencies, s.emergencies);
  way(m.boot_ups, s.boot_ups);
  way(m.missing_samples, s.missing_samples);
  way(m.late_samples, s.late_samples);
  way(m.short_frames, s.short_frames);
  way(m.duplicate_samples, s.duplicate_samples);
  way(m.implausible_samples, s.implausible_samples);
  way(m.heartbeat_losses, s.heartbeat_losses);
  way(m.sdo_failures, s.sdo_failures);
  way(m.limited_joint_position, s.limited_joint_position);
  way(m.limited_speed, s.limited_speed);
  way(m.limited_rate, s.limited_rate);
  way(m.limited_power, s.limited_power);
  way(m.limited_winding, s.limited_winding);
  way(m.limited_by_drive, s.limited_by_drive);
  way(m.winding_share, s.winding_share);
  way(m.bus, s.bus);
  way(m.node, s.node);
  way(m.actuator, s.actuator);
  way(m.last_emergency_code, s.last_emergency_code);
  way(m.error_register, s.error_register);
  way(m.nmt_state, s.nmt_state);
  way(m.reference_source, s.reference_source);
  way(m.operational, s.operational);
  way(m.recovery, s.recovery);
};

const auto kSame = [](auto& way, auto& m, auto& s) { way(m, s); };

const auto kAuxiliaryState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n_actuators, m.measured_temperature_degC, s.measured_temperature_degC, kSame);
  way(m.battery_voltage_V, s.battery_voltage_V);
  way(m.battery_charge_share, s.battery_charge_share);
  way(m.battery_temperature_degC, s.battery_temperature_degC);
};

const auto kBodyState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way(m.estimated_position_in_world_m, s.estimated_position_in_world_m);
  way(m.estimated_quaternion_wxyz, s.estimated_quaternion_wxyz);
  way(m.estimated_velocity_m_s, s.estimated_velocity_m_s);
  way(m.estimated_rate_bias_rad_s, s.estimated_rate_bias_rad_s);
  way(m.estimated_force_bias_m_s2, s.estimated_force_bias_m_s2);
  way(m.estimated_imu_tilt_rad, s.estimated_imu_tilt_rad);
  way(m.estimated_sinking_m_N, s.estimated_sinking_m_N);
  way(m.position_covariance_m2, s.position_covariance_m2);
  way(m.attitude_covariance_rad2, s.attitude_covariance_rad2);
  way(m.imu_tilt_covariance_rad2, s.imu_tilt_covariance_rad2);
  way(m.velocity_covariance_m2_s2, s.velocity_covariance_m2_s2);
  way(m.slips, s.slips);
  way(m.uses_imu, s.uses_imu);
};

const auto kBusState = [](auto& way, auto& m, auto& s) {
  fields::stamp(way, m, s);
  way.elements(m.n_buses, m.buses, s.buses, kBusHealth);
  way.elements(m.n_nodes, m.nodes, s.nodes, kNodeHealth);
  way(m.recovering, s.recovering);
};

}  // namespace

void to_message(const MotionState& in, std::int64_t session, sprung_msgs::motion_state_t& out) {
  write(kMotionState, in, session, out);
  out.state_name = name(in.state);
  out.last_transition = in.last_transition;
}
void to_message(const SafetyState& in, std::int64_t session, sprung_msgs::safety_state_t& out) {
  write(kSafetyState, in, session, out);
  out.level_name = name(in.level);
  out.cause_name = name(in.cause);
  out.detail.assign(in.detail.data(), strnlen(in.detail.data(), in.detail.size()));
}
void to_message(const OperatorCommand& in, std::int64_t session, sprung_msgs::operator_command_t& out) {
  write(kOperatorCommand, in, session, out);
}
void to_message(const OperatorReply& in, std::int64_t session, sprung_msgs::operator_reply_t& out) {
  write(kOperatorReply, in, session, out);
  out.answered_by = in.answered_by;
  out.reason = in.reason;
}
void to_message(const TorqueSensor& in, std::int64_t session, sprung_msgs::torque_sensor_t& out) {
  write(kTorqueSensor, in, session, out);
}
void to_message(const SimControl& in, std::int64_t session, sprung_msgs::sim_control_t& out) {
  write(kSimControl, in, session, out);
}
void to_message(const BusState& in, std::int64_t session, sprung_msgs::bus_state_t& out) {
  write(kBusState, in, session, out);
}
void to_message(const BodyState& in, std::int64_t session, sprung_msgs::body_state_t& out) {
  write(kBodyState, in, session, out);
}
void to_message(const AuxiliaryState& in, std::int64_t session, sprung_msgs::auxiliary_state_t& out) {
  write(kAuxiliaryState, in, session, out);
}

Reading from_message(const sprung_msgs::motion_state_t& in, MotionState& out) {
  out.last_transition = in.last_transition.c_str();
  return read(kMotionState, in, out);
}
Reading from_message(const sprung_msgs::safety_state_t& in, SafetyState& out) {
  out.detail.fill('\0');
  in.detail.copy(out.detail.data(), out.detail.size() - 1);
  return read(kSafetyState, in, out);
}
Reading from_message(const sprung_msgs::operator_command_t& in, OperatorCommand& out) {
  return read(kOperatorCommand, in, out);
}
Reading from_message(const sprung_msgs::operator_reply_t& in, OperatorReply& out) {
  out.answered_by = in.answered_by.c_str();
  out.reason = in.reason.c_str();
  return read(kOperatorReply, in, out);
}
Reading from_message(const sprung_msgs::torque_sensor_t& in, TorqueSensor& out) {
  return read(kTorqueSensor, in, out);
}
Reading from_message(const sprung_msgs::sim_control_t& in, SimControl& out) {
  Reading reading = read(kSimControl, in, out);
  reading.good = reading.good && is_an_experiment(out);
  return reading;
}
Reading from_message(const sprung_msgs::body_state_t& in, BodyState& out) {
  return read(kBodyState, in, out);
}
Reading from_message(const sprung_msgs::auxiliary_state_t& in, AuxiliaryState& out) {
  return read(kAuxiliaryState, in, out);
}
Reading from_message(const sprung_msgs::bus_state_t& in, BusState& out) { return read(kBusState, in, out); }

}  // namespace sprung
