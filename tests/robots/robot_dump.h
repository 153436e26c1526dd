#pragma once
/// Every value of a loaded robot.yaml as text, but for the folder and the hash of the file's bytes.
#include <string>

#include "robots/robot_config.h"
#include "tests/support/value_dump.h"

namespace sprung {

inline void dump_value(test::ValueDump& dump, const std::string& at, const BusConfig& value) {
  const auto& [name, can] = value;
  dump.fields(at, "name can", name, can);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const IdentityConfig& value) {
  const auto& [vendor, product, revision, serial] = value;
  dump.fields(at, "vendor product revision serial", vendor, product, revision, serial);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const EncoderCardConfig& value) {
  const auto& [name, bus, node, profile, identity, watch] = value;
  dump.fields(at, "name bus node profile identity watch", name, bus, node, profile, identity,
              static_cast<int>(watch));
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const LinkEncoderConfig& value) {
  const auto& [card, channel, counts_per_turn, direction, offset_rad] = value;
  dump.fields(at, "card channel counts_per_turn direction offset_rad", card, channel, counts_per_turn,
              direction, offset_rad);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const ReferenceConfig& value) {
  const auto& [method, absolute_encoder, jig_position_rad, index_position_rad, max_age_days] = value;
  dump.fields(at, "method absolute_encoder jig_position_rad index_position_rad max_age_days", method,
              absolute_encoder, jig_position_rad, index_position_rad, max_age_days);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const SupplyConfig& value) {
  dump.fields(at, "min_V max_V", value.min_V, value.max_V);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const EmergencyInputConfig& value) {
  dump.fields(at, "bit stops_high", value.bit, value.stops_high);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const CommissioningConfig& value) {
  dump.fields(at, "motor encoder_inverted current_p current_i brake", static_cast<int>(value.motor),
              value.encoder_inverted, value.current_p, value.current_i, value.brake);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const ReadingConfig& value) {
  const auto& [index, sub, bytes, is_signed, scale] = value;
  dump.fields(at, "index sub bytes is_signed scale", index, sub, bytes, is_signed, scale);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const TemperatureConfig& value) {
  dump.fields(at, "reading max_degC", value.reading, value.max_degC);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const BatteryConfig& value) {
  const auto& [bus, node, voltage, charge, temperature, min_charge_share] = value;
  dump.fields(at, "bus node voltage charge temperature min_charge_share", bus, node, voltage, charge,
              temperature, min_charge_share);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const ActuatorConfig& value) {
  const auto& [name, bus, node, profile, identity, watch, ratio, direction, torque_constant, rated_current,
               counts, offset, referenced, referenced_on, torque_limit, speed_limit, power_limit,
               speed_object, limits_object, loop, stiffness, damping, gains_object, safety_damping,
               pole_pairs, winding, supply, emergency_input, commissioning, temperature, restore_settings,
               link_encoder, reference] = value;
  dump.fields(
      at,
      "name bus node profile identity watch gear_ratio direction torque_constant_Nm_A rated_current_A "
      "encoder_counts_per_turn offset_rad referenced referenced_on torque_limit_Nm speed_limit_rad_s "
      "power_limit_W "
      "speed_limit_object position_limits_object position_loop position_stiffness_Nm_rad "
      "position_damping_Nm_s_rad "
      "position_gains_object "
      "safety_damping_Nm_s_rad pole_pairs winding_time_constant_s supply emergency_input "
      "commissioning temperature restore_settings link_encoder reference",
      name, bus, node, profile, identity, static_cast<int>(watch), ratio, direction, torque_constant,
      rated_current, counts, offset, referenced, referenced_on, torque_limit, speed_limit, power_limit,
      speed_object, limits_object, static_cast<int>(loop), stiffness, damping, gains_object, safety_damping,
      pole_pairs, winding, supply, emergency_input, commissioning, temperature, restore_settings,
      link_encoder, reference);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const FrictionParameters& value) {
  const auto& [coulomb, stribeck, speed, exponent, viscous, viscous_exponent, driving, driven, asymmetry,
               presliding, viscous_temperature, coulomb_temperature, reference] = value;
  dump.fields(
      at,
      "coulomb_Nm stribeck_Nm stribeck_speed_rad_s stribeck_exponent viscous_Nm_s_rad viscous_exponent "
      "load_share_driving load_share_driven asymmetry presliding_rad viscous_temperature_1_K "
      "coulomb_temperature_1_K reference_temperature_C",
      coulomb, stribeck, speed, exponent, viscous, viscous_exponent, driving, driven, asymmetry, presliding,
      viscous_temperature, coulomb_temperature, reference);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const IdentificationRecord& value) {
  const auto& [robot, date, log, sha256, samples, held_out_r2, held_out_rms_Nm, command, temperature_C,
               supply_V, max_age_days] = value;
  dump.fields(
      at,
      "robot date log sha256 samples held_out_r2 held_out_rms_Nm command temperature_C supply_V max_age_days",
      robot, date, log, sha256, samples, held_out_r2, held_out_rms_Nm, command, temperature_C, supply_V,
      max_age_days);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const IdentifiedFriction& value) {
  const auto& [model, parameters, record] = value;
  dump.fields(at, "model parameters record", model, parameters, record);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const JointUncertainty& value) {
  const auto& [friction, torque_constant, armature, mass] = value;
  dump.fields(at, "friction torque_constant armature mass", friction, torque_constant, armature, mass);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const ThermalParameters& value) {
  const auto& [resistance, time_constant, ambient, ambient_std] = value;
  dump.fields(at, "resistance_K_W time_constant_s ambient_C ambient_std_K", resistance, time_constant,
              ambient, ambient_std);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const KinematicErrorTerm& value) {
  const auto& [order, cosine_rad, sine_rad] = value;
  dump.fields(at, "order cosine_rad sine_rad", order, cosine_rad, sine_rad);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const GearTorsion& value) {
  const auto& [stiffness, second_stiffness, second_from, angle_std, error, terms] = value;
  dump.fields(at,
              "stiffness_Nm_rad second_stiffness_Nm_rad second_from_Nm angle_std_rad kinematic_error "
              "kinematic_terms",
              stiffness, second_stiffness, second_from, angle_std, error, terms);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const JointConfig& value) {
  const auto& [name, min, max, armature, coulomb, source, friction, uncertainty, thermal, torsion] = value;
  dump.fields(at,
              "name position_min_rad position_max_rad armature_kg_m2 coulomb_friction_Nm friction_source "
              "friction uncertainty thermal torsion",
              name, min, max, armature, coulomb, source, friction, uncertainty, thermal, torsion);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const LinkConfig& value) {
  const auto& [length_m, mass_kg, com_m, inertia_kg_m2] = value;
  dump.fields(at, "length_m mass_kg com_m inertia_kg_m2", length_m, mass_kg, com_m, inertia_kg_m2);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const LegConfig& value) {
  const auto& [name, kinematics, side, joints, actuators, transmission, links, hip, radius, on, off, rise,
               fall] = value;
  dump.fields(at,
              "name kinematics side joints actuators transmission links hip_in_trunk_m foot_radius_m "
              "contact_on_N contact_off_N contact_rise_s contact_fall_s",
              name, kinematics, side, joints, actuators, transmission, links, hip, radius, on, off, rise,
              fall);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const EstimationConfig& value) {
  const auto& [loop, jitter, noise, walk, floor, adapts] = value;
  dump.fields(at,
              "drive_loop_kHz sampling_jitter_us current_noise_Nm load_walk_Nm_sqrt_s floor_force_N "
              "adapts_friction",
              loop, jitter, noise, walk, floor, adapts);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const WatchdogConfig& value) {
  const auto& [hold, stop, leg_command, joint_state, silent, overruns, heartbeat, consumer, drive] = value;
  dump.fields(at,
              "command_hold_s command_stop_s leg_command_s joint_state_s silent_cycles overruns_in_row "
              "heartbeat_s heartbeat_consumer_s drive_heartbeat_s",
              hold, stop, leg_command, joint_state, silent, overruns, heartbeat, consumer, drive);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const JumpCurveConfig& value) {
  const auto& [duration_s, lengths_m, height_m, drift_m] = value;
  dump.fields(at, "duration_s lengths_m height_m drift_m", duration_s, lengths_m, height_m, drift_m);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const StiffnessConfig& value) {
  const auto& [stiffness, damping, feedforward] = value;
  dump.fields(at, "stiffness_N_m damping_N_s_m velocity_feedforward", stiffness, damping, feedforward);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const RestFrictionConfig& value) {
  const auto& [speed_rad_s, torque_Nm, most] = value;
  dump.fields(at, "speed_rad_s torque_Nm most", speed_rad_s, torque_Nm, most);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const LandingGains& value) {
  const auto& [mass_x, mass_z, stiffness_x, stiffness_z, damping_x, damping_z] = value;
  dump.fields(at, "mass_x_kg mass_z_kg stiffness_x_N_m stiffness_z_N_m damping_x_N_s_m damping_z_N_s_m",
              mass_x, mass_z, stiffness_x, stiffness_z, damping_x, damping_z);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const AdaptiveLandingConfig& value) {
  const auto& [extended, extension, stretch, foot_x, braking, jerk, share, approach, early, fastest, timing,
               shortest, body_mass, rise, inertia, friction, ground_friction, measured, mass_s, air,
               ground] = value;
  dump.fields(
      at,
      "extended_length_m extension_s stretch_acceleration_m_s2 foot_x_m braking_m_s2 braking_jerk_m_s3 "
      "approach_share approach_m_s early_m fastest_m_s timing_s shortest_m body_mass_kg force_rise_s "
      "inertia_compensation friction_compensation ground_friction_compensation measured_force_share "
      "mass_s air ground",
      extended, extension, stretch, foot_x, braking, jerk, share, approach, early, fastest, timing, shortest,
      body_mass, rise, inertia, friction, ground_friction, measured, mass_s, air, ground);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const WalkConfig& value) {
  const auto& [stance, swing, pre_stance, distribute, floor_friction, width, rise, approach, step_down,
               acceleration, turning, foothold, stiffness, damping, speed_damping, stance_friction,
               standing_friction, swing_inertia, swing_friction] = value;
  dump.fields(at,
              "stance swing pre_stance distribute_force floor_friction stance_width_m force_rise_s "
              "approach_m_s step_down_m acceleration_m_s2 turning_acceleration_rad_s2 foothold_gain_s "
              "body_stiffness body_damping speed_damping stance_friction_compensation "
              "standing_friction_share swing_inertia_compensation swing_friction_compensation",
              stance, swing, pre_stance, distribute, floor_friction, width, rise, approach, step_down,
              acceleration, turning, foothold, stiffness, damping, speed_damping, stance_friction,
              standing_friction, swing_inertia, swing_friction);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const PresetConfig& value) {
  const auto& [name, compensated, friction, smoothing, rest, inertia, ramp, compliance, stand, sit, rise,
               crouch, settle, recover, hold, landing, flight, thrust, hybrid, curve, adapt, torque_jump,
               hybrid_landing, adaptive_landing, walk] = value;
  dump.fields(
      at,
      "name compensated_friction friction_compensation friction_smoothing_rad_s rest_friction "
      "inertia_compensation stiffness_ramp_s compliance stand_length_m sit_length_m rise_time_s "
      "crouch_time_s settle_time_s recover_time_s landing_hold_s landing_length_m flight_timeout_s "
      "thrust_timeout_s hybrid_switch_s jump_curve adapt_height torque_jump hybrid_landing adaptive_landing "
      "walk",
      name, compensated, friction, smoothing, rest, inertia, ramp, compliance, stand, sit, rise, crouch,
      settle, recover, hold, landing, flight, thrust, hybrid, curve, adapt, torque_jump, hybrid_landing,
      adaptive_landing, walk);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const ImuDriverConfig& value) {
  const auto& [device, baud, roll, pitch, yaw, latency, rate, force, silence] = value;
  dump.fields(
      at,
      "device baud mounting_roll_rad mounting_pitch_rad mounting_yaw_rad latency_s range_rad_s range_m_s2 "
      "longest_silence_s",
      device, baud, roll, pitch, yaw, latency, rate, force, silence);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const BodyConfig& value) {
  const auto& [mass_kg, com, inertia, imu, imu_latency_s, imu_driver, fallen_tilt_rad, fallen_height_m,
               meets_falls] = value;
  dump.fields(at,
              "mass_kg com_in_trunk_m inertia_kg_m2 imu imu_latency_s imu_driver fallen_tilt_rad "
              "fallen_height_m meets_falls",
              mass_kg, com, inertia, imu, imu_latency_s, imu_driver, fallen_tilt_rad, fallen_height_m,
              meets_falls);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const GaitConfig& value) {
  const auto& [name, period, duty, offsets, lift, pre_stance, sway, height, approach, forward, backward,
               sideways, turning, to] = value;
  dump.fields(at,
              "name period_s duty offsets lift_m pre_stance sway_m height_m approach_m_s fastest_forward_m_s "
              "fastest_backward_m_s fastest_sideways_m_s fastest_turning_rad_s to",
              name, period, duty, offsets, lift, pre_stance, sway, height, approach, forward, backward,
              sideways, turning, to);
}

inline void dump_value(test::ValueDump& dump, const std::string& at, const ProcessConfig& value) {
  const auto& [program, priority, cpu, restart, host] = value;
  dump.fields(at, "program priority cpu restart host", program, priority, cpu, restart, host);
}

inline std::string dump_of(const RobotConfig& robot) {
  const auto& [name, folder, cycle_s, buses, bit_rate_bit_s, actuators, encoder_cards, battery, joints, legs,
               estimation, watchdogs, simulation_watchdogs, presets, body, gaits, processes, hold_to_run,
               lowering_s, hash, overlay, overlay_hash] = robot;
  test::ValueDump dump;
  dump.fields(
      "",
      "name cycle_s buses bit_rate_bit_s actuators encoder_cards battery joints legs estimation watchdogs "
      "simulation_watchdogs presets body gaits processes",
      name, cycle_s, buses, bit_rate_bit_s, actuators, encoder_cards, battery, joints, legs, estimation,
      watchdogs, simulation_watchdogs, presets, body, gaits, processes);
  static_cast<void>(folder);
  static_cast<void>(hold_to_run);  // no key of the file
  static_cast<void>(lowering_s);
  static_cast<void>(hash);
  static_cast<void>(overlay);  // a file of its own
  static_cast<void>(overlay_hash);
  return dump.text();
}

}  // namespace sprung
