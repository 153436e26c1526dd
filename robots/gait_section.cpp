#include "robots/gait_section.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "robots/robot_sections.h"

namespace sprung::robot_sections {
namespace {

std::array<double, 3> read_axes(const YamlMap& map, const std::string& unit, double low, double high) {
  const std::array<double, 3> axes{map.quantity("x", unit, low, high), map.quantity("y", unit, low, high),
                                   map.quantity("z", unit, low, high)};
  map.finish();
  return axes;
}

std::array<double, 3> read_body_gains(const YamlMap& map, const std::string& per) {
  const std::array<double, 3> gains{map.quantity("roll", "Nm" + per + "/rad", 0, 1e5),
                                    map.quantity("pitch", "Nm" + per + "/rad", 0, 1e5),
                                    map.quantity("height", "N" + per + "/m", 0, 1e6)};
  map.finish();
  return gains;
}

/// Of legs that stand at this share of the period.
int standing(const GaitConfig& gait, double phase) {
  return static_cast<int>(std::count_if(gait.offsets.begin(), gait.offsets.end(), [&](double offset) {
    const double since_swing = phase - offset - std::floor(phase - offset);
    return since_swing >= 1.0 - gait.duty;
  }));
}

/// Feet in the air change only where a swing begins: looking there suffices.
void refuse_flight(const YamlMap& map, const GaitConfig& gait) {
  constexpr int kFewest = 2;
  for (const double offset : gait.offsets) {
    const int feet = standing(gait, offset);
    if (gait.duty < 1.0 && feet < std::min<int>(kFewest, static_cast<int>(gait.offsets.size()) - 1))
      map.fail("offsets", "only " + std::to_string(feet) + " feet stand at phase " + std::to_string(offset) +
                              ": a gait needs 2 at any time");
  }
}

GaitConfig read_gait(const std::string& name, const YamlMap& map, std::size_t legs) {
  GaitConfig gait;
  gait.name = name;
  gait.period_s = map.quantity("period", "s", 0.1, 60);
  gait.duty = map.quantity("duty", "", 0.4, 1);
  gait.offsets = map.quantities("offsets", "", 0, 1);
  if (gait.offsets.size() != legs)
    map.fail("offsets", "expected one for each of " + std::to_string(legs) + " legs, found " +
                            std::to_string(gait.offsets.size()));
  gait.lift_m = map.quantity("lift", "m", 0, 0.5);
  gait.pre_stance = map.quantity("pre_stance", "", 0, 0.9);
  gait.sway_m = map.quantity("sway", "m", 0, 0.2);
  if (map.has("height")) gait.height_m = map.quantity("height", "m", 0.05, 3);
  if (map.has("approach_speed")) gait.approach_m_s = map.quantity("approach_speed", "m/s", 0.01, 2);
  const YamlMap fastest = map.map("fastest");
  gait.fastest_forward_m_s = fastest.quantity("forward", "m/s", 0, 5);
  gait.fastest_backward_m_s = fastest.quantity("backward", "m/s", 0, 5);
  gait.fastest_sideways_m_s = fastest.quantity("sideways", "m/s", 0, 5);
  gait.fastest_turning_rad_s = fastest.quantity("turning", "rad/s", 0, 5);
  fastest.finish();
  gait.to = map.texts("to");
  map.finish();
  refuse_flight(map, gait);
  return gait;
}

}  // namespace

StiffnessConfig read_stiffness(const YamlMap& map) {
  StiffnessConfig config;
  config.stiffness_N_m = read_axes(map.map("stiffness"), "N/m", 0, 1e5);
  config.damping_N_s_m = read_axes(map.map("damping"), "N s/m", 0, 1e4);
  config.velocity_feedforward = map.quantity("velocity_feedforward", "", 0, 1);
  map.finish();
  return config;
}

ImuDriverConfig read_imu_driver(const YamlMap& map) {
  ImuDriverConfig imu;
  imu.device = map.text("device");
  if (imu.device.empty() || imu.device.front() != '/')
    map.fail("device", "expected the path of a serial line, e.g. /dev/ttyUSB0, found '" + imu.device + "'");
  static const std::vector<std::string> kRates{"9600",   "19200",  "38400",  "57600",  "115200",
                                               "230400", "460800", "921600", "2000000"};
  imu.baud = std::stoi(kRates[static_cast<std::size_t>(choice(map, "baud", kRates))]);
  const YamlMap mounting = map.map("mounting");
  imu.mounting_roll_rad = mounting.quantity("roll", "rad", -3.15, 3.15);
  imu.mounting_pitch_rad = mounting.quantity("pitch", "rad", -3.15, 3.15);
  imu.mounting_yaw_rad = mounting.quantity("yaw", "rad", -3.15, 3.15);
  mounting.finish();
  imu.latency_s = map.quantity("latency", "s", 0, 0.1);
  imu.range_rad_s = map.quantity("rate_range", "rad/s", 1, 100);
  imu.range_m_s2 = map.quantity("force_range", "m/s^2", 10, 2000);
  imu.longest_silence_s = map.quantity("longest_silence", "s", 0.002, 1);
  map.finish();
  return imu;
}

BodyConfig read_body(const YamlMap& map) {
  BodyConfig body;
  body.mass_kg = map.quantity("mass", "kg", 0.1, 500);
  body.com_in_trunk_m = read_axes(map.map("com"), "m", -1, 1);
  body.inertia_kg_m2 = read_axes(map.map("inertia"), "kg m^2", 1e-4, 500);
  body.imu = map.flag("imu");
  if (map.has("imu_latency") && !body.imu)
    map.fail("imu_latency", "there is one, but imu: false says that nobody publishes IMU");
  if (map.has("imu_latency")) body.imu_latency_s = map.quantity("imu_latency", "s", 0, 0.02);
  if (map.has("imu_driver")) {
    if (!body.imu) map.fail("imu_driver", "there is one, but imu: false says that nobody publishes IMU");
    body.imu_driver = read_imu_driver(map.map("imu_driver"));
  }
  const YamlMap fallen = map.map("fallen");
  body.fallen_tilt_rad = fallen.quantity("tilt", "rad", 0.1, 3.15);
  body.fallen_height_m = fallen.quantity("height", "m", 0, 2);
  if (fallen.has("met")) body.meets_falls = fallen.flag("met");
  fallen.finish();
  map.finish();
  return body;
}

std::vector<GaitConfig> read_gaits(const YamlMap& map, std::size_t legs) {
  std::vector<GaitConfig> gaits;
  for (const auto& [name, gait] : map.entries()) gaits.push_back(read_gait(name, gait, legs));
  for (const GaitConfig& gait : gaits) {
    for (const std::string& next : gait.to) {
      const bool known = std::any_of(gaits.begin(), gaits.end(),
                                     [&](const GaitConfig& g) { return g.name == next; });
      if (!known) map.fail(gait.name, "to: there is no gait '" + next + "'");
    }
  }
  return gaits;
}

WalkConfig read_walk(const YamlMap& map) {
  WalkConfig walk;
  walk.stance = read_stiffness(map.map("stance"));
  walk.swing = read_stiffness(map.map("swing"));
  walk.pre_stance = read_stiffness(map.map("pre_stance"));
  walk.distribute_force = map.flag("distribute_force");
  walk.floor_friction = map.quantity("floor_friction", "", 0.05, 2);
  walk.stance_width_m = map.quantity("stance_width", "m", -0.1, 0.3);
  walk.force_rise_s = map.quantity("force_rise", "s", 0, 0.5);
  walk.approach_m_s = map.quantity("approach_speed", "m/s", 0.01, 2);
  walk.step_down_m = map.quantity("step_down", "m", 0, 0.2);
  walk.acceleration_m_s2 = map.quantity("acceleration", "m/s^2", 0.01, 10);
  walk.turning_acceleration_rad_s2 = map.quantity("turning_acceleration", "rad/s^2", 0.01, 10);
  walk.foothold_gain_s = map.quantity("foothold_gain", "s", 0, 1);
  walk.body_stiffness = read_body_gains(map.map("body_stiffness"), "");
  walk.body_damping = read_body_gains(map.map("body_damping"), " s");
  const YamlMap speed = map.map("speed_damping");
  walk.speed_damping = {speed.quantity("forward", "N s/m", 0, 1e5),
                        speed.quantity("sideways", "N s/m", 0, 1e5)};
  speed.finish();
  walk.stance_friction_compensation = map.quantity("stance_friction_compensation", "", 0, 1);
  walk.standing_friction_share = map.quantity_or("standing_friction_share", "", 0, 1,
                                                 walk.standing_friction_share);
  const YamlMap compensation = map.map("swing_compensation");
  walk.swing_inertia_compensation = compensation.quantity("inertia", "", 0, 1);
  walk.swing_friction_compensation = compensation.quantity("friction", "", 0, 1);
  compensation.finish();
  map.finish();
  return walk;
}

}  // namespace sprung::robot_sections
