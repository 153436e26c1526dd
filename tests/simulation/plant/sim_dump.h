#pragma once
/// Every value of a loaded sim.yaml as text.
#include <string>

#include "simulation/plant/sim_config.h"
#include "tests/support/value_dump.h"

namespace sprung::sim {

using test::ValueDump;

inline void dump_value(ValueDump& dump, const std::string& at, const PlantBodyConfig& value) {
  const auto& [name, mass_kg, shift, length_factor] = value;
  dump.fields(at, "name mass_kg shift_x_m shift_y_m shift_z_m length_factor", name, mass_kg, shift[0],
              shift[1], shift[2], length_factor);
}

inline void dump_value(ValueDump& dump, const std::string& at, const ContactConfig& value) {
  const auto& [stiffness_N_m, damping_N_s_m, friction] = value;
  dump.fields(at, "stiffness_N_m damping_N_s_m friction", stiffness_N_m, damping_N_s_m, friction);
}

inline void dump_value(ValueDump& dump, const std::string& at, const GroundArea& value) {
  const auto& [from_m, length_m, right_m, width_m] = value;
  dump.fields(at, "from_m length_m right_m width_m", from_m, length_m, right_m, width_m);
}

inline void dump_value(ValueDump& dump, const std::string& at, const GroundStep& value) {
  const auto& [area, height_m] = value;
  dump.fields(at, "area height_m", area, height_m);
}

inline void dump_value(ValueDump& dump, const std::string& at, const GroundRamp& value) {
  const auto& [from_m, length_m, slope_rad] = value;
  dump.fields(at, "from_m length_m slope_rad", from_m, length_m, slope_rad);
}

inline void dump_value(ValueDump& dump, const std::string& at, const GroundPatch& value) {
  const auto& [area, friction] = value;
  dump.fields(at, "area friction", area, friction);
}

inline void dump_value(ValueDump& dump, const std::string& at, const GroundConfig& value) {
  const auto& [slope_rad, side_slope_rad, begins_m, wave_m, wave_length_m, rough_m, rough_grid_m, error_m,
               error_seed, steps, ramps, patches] = value;
  dump.fields(
      at,
      "slope_rad side_slope_rad begins_m wave_m wave_length_m rough_m rough_grid_m error_m error_seed "
      "steps ramps patches",
      slope_rad, side_slope_rad, begins_m, wave_m, wave_length_m, rough_m, rough_grid_m, error_m, error_seed,
      steps, ramps, patches);
}

inline void dump_value(ValueDump& dump, const std::string& at, const FrictionTemperatureConfig& value) {
  const auto& [per_K, reference_degC, coulomb_share] = value;
  dump.fields(at, "per_K reference_degC coulomb_share", per_K, reference_degC, coulomb_share);
}

inline void dump_value(ValueDump& dump, const std::string& at, const RippleConfig& value) {
  const auto& [share, order, phase_rad] = value;
  dump.fields(at, "share order phase_rad", share, order, phase_rad);
}

inline void dump_value(ValueDump& dump, const std::string& at, const FrictionConfig& value) {
  const auto& [coulomb, breakaway, speed, viscous, driving, back_driving, asymmetry, temperature,
               motor_ripple, joint_ripple, presliding] = value;
  dump.fields(
      at,
      "coulomb_Nm breakaway_Nm stribeck_speed_rad_s viscous_Nm_s_rad driving_share back_driving_share "
      "asymmetry temperature motor_ripple joint_ripple presliding_rad",
      coulomb, breakaway, speed, viscous, driving, back_driving, asymmetry, temperature, motor_ripple,
      joint_ripple, presliding);
}

inline void dump_value(ValueDump& dump, const std::string& at, const ThermalConfig& value) {
  const auto& [resistance_K_W, time_constant_s] = value;
  dump.fields(at, "resistance_K_W time_constant_s", resistance_K_W, time_constant_s);
}

inline void dump_value(ValueDump& dump, const std::string& at, const TorsionConfig& value) {
  const auto& [stiffness, second_stiffness, second_from, damping, backlash] = value;
  dump.fields(at, "stiffness_Nm_rad second_stiffness_Nm_rad second_from_Nm damping_Nm_s_rad backlash_rad",
              stiffness, second_stiffness, second_from, damping, backlash);
}

inline void dump_value(ValueDump& dump, const std::string& at, const PlantJointConfig& value) {
  const auto& [name, initial, lying, armature, min, max, friction, thermal, torsion] = value;
  dump.fields(at,
              "name initial_rad lying_rad armature_kg_m2 stop_min_rad stop_max_rad friction thermal torsion",
              name, initial, lying, armature, min, max, friction, thermal, torsion);
}

inline void dump_value(ValueDump& dump, const std::string& at, const PayloadConfig& value) {
  const auto& [mass_kg, place_m] = value;
  dump.fields(at, "mass_kg place_m", mass_kg, place_m);
}

inline void dump_value(ValueDump& dump, const std::string& at, const PlantConfig& value) {
  const auto& [step_s, suspended_m, lies, foot_weight_kg, payload, foot_radius_factor, roll_rad,
               rail_x_locked, floor_height_m, ground, ambient_degC, torsion, bodies, joints, contact] = value;
  dump.fields(at,
              "step_s suspended_m lies foot_weight_kg payload foot_radius_factor roll_rad rail_x_locked "
              "floor_height_m ground "
              "ambient_degC torsion bodies "
              "joints contact",
              step_s, suspended_m, lies, foot_weight_kg, payload, foot_radius_factor, roll_rad, rail_x_locked,
              floor_height_m, ground, ambient_degC, torsion, bodies, joints, contact);
}

inline void dump_value(ValueDump& dump, const std::string& at, const KinematicErrorConfig& value) {
  const auto& [amplitude_rad, order, phase_rad] = value;
  dump.fields(at, "amplitude_rad order phase_rad", amplitude_rad, order, phase_rad);
}

inline void dump_value(ValueDump& dump, const std::string& at, const MountingConfig& value) {
  const auto& [direction, link_direction, link_offset_rad, zero_error_rad] = value;
  dump.fields(at, "direction link_direction link_offset_rad zero_error_rad", direction, link_direction,
              link_offset_rad, zero_error_rad);
}

inline void dump_value(ValueDump& dump, const std::string& at, const WindingConfig& value) {
  const auto& [resistance, back_emf, voltage_share] = value;
  dump.fields(at, "resistance_ohm back_emf_V_s_rad voltage_share", resistance, back_emf, voltage_share);
}

inline void dump_value(ValueDump& dump, const std::string& at, const CurrentSensorConfig& value) {
  const auto& [offset_A, gain] = value;
  dump.fields(at, "offset_A gain", offset_A, gain);
}

inline void dump_value(ValueDump& dump, const std::string& at, const PositionLoopConfig& value) {
  const auto& [stiffness, damping, following] = value;
  dump.fields(at, "stiffness_share damping_share following_error_rad", stiffness, damping, following);
}

inline void dump_value(ValueDump& dump, const std::string& at, const SupplyConfig& value) {
  const auto& [voltage, resistance, capacity, takes_back, chopper_V, chopper_ohm] = value;
  dump.fields(at, "voltage_V resistance_ohm capacity_F takes_back chopper_V chopper_ohm", voltage, resistance,
              capacity, takes_back, chopper_V, chopper_ohm);
}

inline void dump_value(ValueDump& dump, const std::string& at, const SimDriveConfig& value) {
  const auto& [actuator, torque_constant, torque_loop, peak_torque, torque_noise, supply, quick_stop,
               supply_min, supply_max, absolute, index_angle, smoothing, mode_delay, factory_node,
               starts_in_fault, latches, error, mounting, winding, sensor, position_loop] = value;
  dump.fields(at,
              "actuator torque_constant_Nm_A torque_loop_Hz peak_torque_Nm torque_noise_Nm supply_V "
              "quick_stop_damping_Nm_s_rad supply_min_V supply_max_V absolute_encoder index_angle_rad "
              "smoothing_s mode_delay_s factory_node starts_in_fault latches_communication_faults "
              "kinematic_error mounting winding current_sensor position_loop",
              actuator, torque_constant, torque_loop, peak_torque, torque_noise, supply, quick_stop,
              supply_min, supply_max, absolute, index_angle, smoothing, mode_delay, factory_node,
              starts_in_fault, latches, error, mounting, winding, sensor, position_loop);
}

inline void dump_value(ValueDump& dump, const std::string& at, const SimCardConfig& value) {
  const auto& [name, noise_rad] = value;
  dump.fields(at, "name noise_rad", name, noise_rad);
}

inline void dump_value(ValueDump& dump, const std::string& at, const TorqueSensorConfig& value) {
  const auto& [joint, rate_Hz, noise_Nm, resolution_Nm] = value;
  dump.fields(at, "joint rate_Hz noise_Nm resolution_Nm", joint, rate_Hz, noise_Nm, resolution_Nm);
}

inline void dump_value(ValueDump& dump, const std::string& at, const ImuConfig& value) {
  const auto& [rate_noise, rate_bias, force_noise, force_bias, attitude_noise, tilt_bias, yaw_drift,
               rate_walk, force_walk, mounting, latency] = value;
  dump.fields(at,
              "rate_noise_rad_s rate_bias_rad_s force_noise_m_s2 force_bias_m_s2 attitude_noise_rad "
              "tilt_bias_rad yaw_drift_rad_s rate_walk_rad_s force_walk_m_s2 mounting_x_rad mounting_y_rad "
              "mounting_z_rad latency_s",
              rate_noise, rate_bias, force_noise, force_bias, attitude_noise, tilt_bias, yaw_drift, rate_walk,
              force_walk, mounting[0], mounting[1], mounting[2], latency);
}

inline void dump_value(ValueDump& dump, const std::string& at, const TimingConfig& value) {
  const auto& [compute_s, sync_jitter_s, compute_tail_s, missed_cycles] = value;
  dump.fields(at, "compute_s sync_jitter_s compute_tail_s missed_cycles", compute_s, sync_jitter_s,
              compute_tail_s, missed_cycles);
}

inline std::string dump_of(const SimConfig& config) {
  const auto& [plant, drives, cards, torque_sensor, imu, timing, real_windings, supply] = config;
  ValueDump dump;
  dump.fields("", "plant drives cards torque_sensor imu timing real_windings supply", plant, drives, cards,
              torque_sensor, imu, timing, real_windings, supply);
  return dump.text();
}

}  // namespace sprung::sim
