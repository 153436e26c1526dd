#include "robots/preset_section.h"

#include "robots/gait_section.h"

namespace sprung::robot_sections {

namespace {

void read_mass(const YamlMap& map, LandingGains& gains) {
  gains.mass_x_kg = map.quantity("x", "kg", 0, 500);
  gains.mass_z_kg = map.quantity("z", "kg", 0, 500);
  map.finish();
}

LandingGains read_gains(const YamlMap& map) {
  LandingGains gains;
  read_mass(map.map("mass"), gains);
  const YamlMap stiffness = map.map("stiffness");
  gains.stiffness_x_N_m = stiffness.quantity("x", "N/m", 0, 1e5);
  gains.stiffness_z_N_m = stiffness.quantity("z", "N/m", 0, 1e5);
  stiffness.finish();
  const YamlMap damping = map.map("damping");
  gains.damping_x_N_s_m = damping.quantity("x", "N s/m", 0, 1e4);
  gains.damping_z_N_s_m = damping.quantity("z", "N s/m", 0, 1e4);
  damping.finish();
  map.finish();
  return gains;
}

JumpCurveConfig read_jump_curve(const YamlMap& map) {
  JumpCurveConfig curve;
  curve.duration_s = map.quantity("duration", "s", 0.02, 5.0);
  curve.lengths_m = map.quantities("lengths", "m", 0.05, 3.0);
  if (curve.lengths_m.size() < 2 || curve.lengths_m.size() > 17) {
    map.fail("lengths", "expected 2 to 17 control points, found " + std::to_string(curve.lengths_m.size()));
  }
  curve.height_m = map.quantity("height", "m", 0.01, 2.0);
  if (map.has("drift")) curve.drift_m = map.quantity("drift", "m", -0.5, 0.5);
  map.finish();
  return curve;
}

CompensatedFriction read_compensated(const YamlMap& map) {
  const std::string text = map.text("compensated_friction");
  if (text != "paper" && text != "identified")
    map.fail("compensated_friction", "expected paper or identified, found '" + text + "'");
  return text == "paper" ? CompensatedFriction::kPaper : CompensatedFriction::kIdentified;
}

/// What presets may leave out: nothing of it was in the papers.
void read_compliance(const YamlMap& map, PresetConfig& p) {
  if (map.has("inertia_compensation"))
    p.inertia_compensation = map.quantity("inertia_compensation", "", 0, 1);
  if (map.has("stiffness_ramp")) p.stiffness_ramp_s = map.quantity("stiffness_ramp", "s", 0, 1);
  if (map.has("rest_friction")) {
    const YamlMap rest = map.map("rest_friction");
    p.rest_friction.speed_rad_s = rest.quantity("speed", "rad/s", 1e-4, 10);
    p.rest_friction.torque_Nm = rest.quantity("torque", "Nm", 1e-3, 100);
    if (rest.has("most")) p.rest_friction.most = rest.quantity("most", "", 0, 1);
    rest.finish();
  }
  if (map.has("compliance")) p.compliance = read_stiffness(map.map("compliance"));
}

void read_jump(const YamlMap& map, PresetConfig& p) {
  p.crouch_time_s = map.quantity("crouch_time", "s", 0.05, 30);
  p.landing_hold_s = map.quantity("landing_hold", "s", 0, 30);
  p.landing_length_m = map.quantity("landing_length", "m", 0.01, 3);
  p.flight_timeout_s = map.quantity("flight_timeout", "s", 0.01, 10);
  p.thrust_timeout_s = map.quantity("thrust_timeout", "s", 0.01, 10);
  p.hybrid_switch_s = map.quantity("hybrid_switch", "s", 0, 10);
  if (map.has("adapt_height")) p.adapt_height = map.flag("adapt_height");
  p.jump_curve = read_jump_curve(map.map("jump_curve"));
  p.torque_jump = read_stiffness(map.map("torque_jump"));
  p.hybrid_landing = read_stiffness(map.map("hybrid_landing"));
  if (map.has("adaptive_landing")) p.adaptive_landing = read_adaptive_landing(map.map("adaptive_landing"));
}

/// Of one that walks and does not jump: any curve, never played.
void read_no_jump(PresetConfig& p) {
  p.landing_length_m = p.stand_length_m;
  p.jump_curve = {1.0, {p.stand_length_m, p.stand_length_m}, 0.0};
}

}  // namespace

AdaptiveLandingConfig read_adaptive_landing(const YamlMap& map) {
  AdaptiveLandingConfig out;
  out.extended_length_m = map.quantity("extended_length", "m", 0.05, 3);
  out.extension_s = map.quantity("extension_time", "s", 0.01, 5);
  out.stretch_acceleration_m_s2 = map.quantity("stretch_acceleration", "m/s^2", 0.1, 500);
  out.foot_x_m = map.quantity("foot_x", "m", -0.3, 0.3);
  out.braking_m_s2 = map.quantity("braking", "m/s^2", 0.1, 200);
  out.braking_jerk_m_s3 = map.quantity("braking_jerk", "m/s^3", 1, 1e6);
  out.approach_m_s = map.quantity("approach_speed", "m/s", 0, 5);
  if (map.has("approach_share")) out.approach_share = map.quantity("approach_share", "", 0, 1);
  out.early_m = map.quantity("early", "m", -0.2, 0.2);
  out.fastest_m_s = map.quantity("fastest", "m/s", 0.1, 10);
  out.timing_s = map.quantity("timing", "s", 0, 1);
  out.shortest_m = map.quantity("shortest", "m", 0.05, out.extended_length_m);
  out.body_mass_kg = map.quantity("body_mass", "kg", 0, 500);
  out.force_rise_s = map.quantity("force_rise", "s", 0, 0.5);
  out.inertia_compensation = map.quantity("inertia_compensation", "", 0, 1);
  out.friction_compensation = map.quantity("friction_compensation", "", 0, 1);
  out.ground_friction_compensation = map.quantity("ground_friction_compensation", "", 0, 1);
  out.measured_force_share = map.quantity("measured_force_share", "", 0, 1);
  out.mass_s = map.quantity("mass_time", "s", 1e-3, 5);
  out.air = read_gains(map.map("air"));
  out.ground = read_gains(map.map("ground"));
  map.finish();
  return out;
}

PresetConfig read_preset(const std::string& name, const YamlMap& map) {
  PresetConfig p;
  p.name = name;
  p.compensated_friction = read_compensated(map);
  p.friction_compensation = map.quantity("friction_compensation", "", 0, 1);
  p.friction_smoothing_rad_s = map.quantity("friction_smoothing", "rad/s", 1e-4, 10);
  p.stand_length_m = map.quantity("stand_length", "m", 0.01, 3);
  p.sit_length_m = map.quantity("sit_length", "m", 0.01, p.stand_length_m);
  p.rise_time_s = map.quantity("rise_time", "s", 0.1, 30);
  p.settle_time_s = map.quantity("settle_time", "s", 0, 30);
  p.recover_time_s = map.quantity("recover_time", "s", 0.05, 30);
  read_compliance(map, p);
  if (map.has("walk")) p.walk = read_walk(map.map("walk"));
  const bool walks_only = map.has("walk") && !map.has("jump_curve");
  walks_only ? read_no_jump(p) : read_jump(map, p);
  map.finish();
  return p;
}

}  // namespace sprung::robot_sections
