#include "robots/landing_section.h"

namespace sprung::robot_sections {
namespace {

void read_mass(const YamlMap& map, LandingGains& gains) {
  gains.mass_x_kg = map.quantity("x", "kg", 0, 500);
  gains.mass_z_kg = map.quantity("z", "kg", 0, 500);
  map.finish();
}

LandingGains read_gains(const YamlMap& map, bool with_mass) {
  LandingGains gains;
  if (with_mass) read_mass(map.map("mass"), gains);
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

void read_jump(const YamlMap& map, AdaptiveLandingConfig& out) {
  out.jump_switch_s = map.quantity("switch", "s", 1e-3, 10);
  out.jump = read_gains(map.map("gains"), false);
  out.jump_friction_compensation = map.quantity("friction_compensation", "", 0, 1);
  map.finish();
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
  out.air = read_gains(map.map("air"), true);
  out.ground = read_gains(map.map("ground"), true);
  if (map.has("jump")) read_jump(map.map("jump"), out);
  map.finish();
  return out;
}

}  // namespace sprung::robot_sections
