#include "simulation/plant/variation.h"

#include <filesystem>
#include <utility>

#include "robots/robot_loader.h"

namespace sprung::sim {
namespace {

using Section = VariedQuantity::Section;
using Item = std::size_t;

PlantBodyConfig& body(SimConfig& config, Item item) { return config.plant.bodies[item]; }
PlantJointConfig& joint(SimConfig& config, Item item) { return config.plant.joints[item]; }
FrictionConfig& friction(SimConfig& config, Item item) { return joint(config, item).friction; }
SimDriveConfig& drive(SimConfig& config, Item item) { return config.drives[item]; }

void scale_dry(SimConfig& config, Item item, double factor) {
  friction(config, item).coulomb_Nm *= factor;
  friction(config, item).breakaway_Nm *= factor;
}

void scale_load_shares(SimConfig& config, Item item, double factor) {
  friction(config, item).driving_share *= factor;
  friction(config, item).back_driving_share *= factor;
}

void set_coulomb(SimConfig& config, Item item, double value) {
  friction(config, item).coulomb_Nm = friction(config, item).breakaway_Nm = value;
}

void scale_stiffness(SimConfig& config, Item item, double factor) {
  if (auto& torsion = joint(config, item).torsion) {
    torsion->stiffness_Nm_rad *= factor;
    torsion->second_stiffness_Nm_rad *= factor;
  }
}

void set_backlash(SimConfig& config, Item item, double value) {
  if (auto& torsion = joint(config, item).torsion) torsion->backlash_rad = value;
}

SupplyConfig& supply(SimConfig& config) {
  if (!config.supply)
    throw ConfigError(
        "variation.yaml: plant: sim.yaml has no `supply` that could differ; add it, or remove the key");
  return *config.supply;
}

void scale_winding(SimConfig& config, Item item, double factor) {
  if (auto& winding = drive(config, item).winding) winding->resistance_ohm *= factor;
}

/// To add one: a row here, and a span in the variation.yaml that want it. A row makes no other draw differ.
/// Within a section values are applied in this order.
const VariedQuantity kQuantities[] = {
    {Section::kPlant, "ambient", "degC", -50, 150,
     [](SimConfig& c, Item, double v) { c.plant.ambient_degC = v; }},
    {Section::kPlant, "ground_friction", "", 0, 10,
     [](SimConfig& c, Item, double v) { c.plant.contact.friction = v; }},
    {Section::kPlant, "ground_stiffness_factor", "", 0.01, 100,
     [](SimConfig& c, Item, double v) { c.plant.contact.stiffness_N_m *= v; }},
    {Section::kPlant, "compute_time", "s", 0, 0.1,
     [](SimConfig& c, Item, double v) { c.timing.compute_s = v; }},
    {Section::kPlant, "sync_jitter", "us", 0, 1000,
     [](SimConfig& c, Item, double v) { c.timing.sync_jitter_s = 1e-6 * v; }},
    {Section::kPlant, "compute_tail", "s", 0, 0.01,
     [](SimConfig& c, Item, double v) { c.timing.compute_tail_s = v; }},
    {Section::kPlant, "missed_cycles", "", 0, 0.5,
     [](SimConfig& c, Item, double v) { c.timing.missed_cycles = v; }},
    {Section::kPlant, "foot_radius_factor", "", 0.1, 10,
     [](SimConfig& c, Item, double v) { c.plant.foot_radius_factor = v; }},
    {Section::kPlant, "supply_voltage_factor", "", 0.5, 2,
     [](SimConfig& c, Item, double v) { supply(c).voltage_V *= v; }},
    {Section::kPlant, "supply_resistance", "ohm", 1e-4, 100,
     [](SimConfig& c, Item, double v) { supply(c).resistance_ohm = v; }},

    {Section::kBody, "mass_factor", "", 0.1, 10,
     [](SimConfig& c, Item i, double v) { body(c, i).mass_kg *= v; }},
    {Section::kBody, "shift_x", "m", -1, 1,
     [](SimConfig& c, Item i, double v) { body(c, i).shift_m[0] += v; }},
    {Section::kBody, "shift_y", "m", -1, 1,
     [](SimConfig& c, Item i, double v) { body(c, i).shift_m[1] += v; }},
    {Section::kBody, "shift_z", "m", -1, 1,
     [](SimConfig& c, Item i, double v) { body(c, i).shift_m[2] += v; }},
    {Section::kBody, "length_factor", "", 0.5, 2,
     [](SimConfig& c, Item i, double v) { body(c, i).length_factor *= v; }},

    {Section::kJoint, "armature_factor", "", 0.1, 10,
     [](SimConfig& c, Item i, double v) { joint(c, i).armature_kg_m2 *= v; }},
    {Section::kJoint, "stiffness_factor", "", 0.1, 10, scale_stiffness},
    {Section::kJoint, "backlash", "rad", 0, 0.1, set_backlash},

    {Section::kFriction, "coulomb_factor", "", 0, 10, scale_dry},
    {Section::kFriction, "viscous_factor", "", 0, 10,
     [](SimConfig& c, Item i, double v) { friction(c, i).viscous_Nm_s_rad *= v; }},
    {Section::kFriction, "load_share_factor", "", 0, 5, scale_load_shares},
    {Section::kFriction, "asymmetry", "", -0.9, 0.9,
     [](SimConfig& c, Item i, double v) { friction(c, i).asymmetry += v; }},
    {Section::kFriction, "ripple_share", "", 0, 0.9,
     [](SimConfig& c, Item i, double v) { friction(c, i).motor_ripple.share = v; }},
    {Section::kFriction, "ripple_phase", "rad", -10, 10,
     [](SimConfig& c, Item i, double v) { friction(c, i).motor_ripple.phase_rad = v; }},

    {Section::kFamily, "coulomb", "Nm", 0, 1000, set_coulomb},
    {Section::kFamily, "breakaway_factor", "", 1, 10,
     [](SimConfig& c, Item i, double v) { friction(c, i).breakaway_Nm *= v; }},
    {Section::kFamily, "stribeck_speed", "rad/s", 1e-4, 100,
     [](SimConfig& c, Item i, double v) { friction(c, i).stribeck_speed_rad_s = v; }},
    {Section::kFamily, "viscous", "Nm s/rad", 0, 1000,
     [](SimConfig& c, Item i, double v) { friction(c, i).viscous_Nm_s_rad = v; }},
    {Section::kFamily, "driving_share", "", 0, 0.9,
     [](SimConfig& c, Item i, double v) { friction(c, i).driving_share = v; }},
    {Section::kFamily, "back_driving_share", "", 0, 0.9,
     [](SimConfig& c, Item i, double v) { friction(c, i).back_driving_share = v; }},
    {Section::kFamily, "asymmetry", "", -0.9, 0.9,
     [](SimConfig& c, Item i, double v) { friction(c, i).asymmetry = v; }},
    {Section::kFamily, "temperature_coefficient", "1/K", 0, 0.2,
     [](SimConfig& c, Item i, double v) { friction(c, i).temperature.per_K = v; }},
    {Section::kFamily, "temperature_share", "", 0, 1,
     [](SimConfig& c, Item i, double v) { friction(c, i).temperature.coulomb_share = v; }},
    {Section::kFamily, "presliding", "rad", 0, 0.1,
     [](SimConfig& c, Item i, double v) { friction(c, i).presliding_rad = v; }},
    {Section::kFamily, "ripple_share", "", 0, 0.9,
     [](SimConfig& c, Item i, double v) { friction(c, i).motor_ripple.share = v; }},
    {Section::kFamily, "ripple_phase", "rad", -10, 10,
     [](SimConfig& c, Item i, double v) { friction(c, i).motor_ripple.phase_rad = v; }},

    {Section::kDrive, "torque_constant_factor", "", 0.1, 10,
     [](SimConfig& c, Item i, double v) { drive(c, i).torque_constant_Nm_A *= v; }},
    {Section::kDrive, "torque_noise_factor", "", 0, 100,
     [](SimConfig& c, Item i, double v) { drive(c, i).torque_noise_Nm *= v; }},
    {Section::kDrive, "torque_loop_factor", "", 0.01, 100,
     [](SimConfig& c, Item i, double v) { drive(c, i).torque_loop_Hz *= v; }},
    {Section::kDrive, "position_smoothing", "s", 0, 1,
     [](SimConfig& c, Item i, double v) { drive(c, i).smoothing_s = v; }},
    {Section::kDrive, "position_stiffness_share", "", 0.1, 10,
     [](SimConfig& c, Item i, double v) { drive(c, i).position_loop.stiffness_share = v; }},
    {Section::kDrive, "position_damping_share", "", 0.1, 10,
     [](SimConfig& c, Item i, double v) { drive(c, i).position_loop.damping_share = v; }},
    {Section::kDrive, "current_offset", "A", -10, 10,
     [](SimConfig& c, Item i, double v) { drive(c, i).current_sensor.offset_A = v; }},
    {Section::kDrive, "current_gain", "", 0.5, 2,
     [](SimConfig& c, Item i, double v) { drive(c, i).current_sensor.gain = v; }},
    {Section::kDrive, "winding_resistance_factor", "", 0.1, 10, scale_winding},
    {Section::kDrive, "mode_delay", "s", 0, 1,
     [](SimConfig& c, Item i, double v) { drive(c, i).mode_delay_s = v; }},
    {Section::kDrive, "kinematic_error", "rad", 0, 0.1,
     [](SimConfig& c, Item i, double v) { drive(c, i).kinematic_error.amplitude_rad = v; }},
    {Section::kDrive, "kinematic_phase", "rad", -10, 10,
     [](SimConfig& c, Item i, double v) { drive(c, i).kinematic_error.phase_rad = v; }},
    {Section::kDrive, "zero_error", "rad", -1, 1,
     [](SimConfig& c, Item i, double v) { drive(c, i).mounting.zero_error_rad += v; }},

    {Section::kImu, "roll", "rad", -1, 1, [](SimConfig& c, Item, double v) { c.imu->mounting_rad[0] += v; }},
    {Section::kImu, "pitch", "rad", -1, 1, [](SimConfig& c, Item, double v) { c.imu->mounting_rad[1] += v; }},
    {Section::kImu, "yaw", "rad", -1, 1, [](SimConfig& c, Item, double v) { c.imu->mounting_rad[2] += v; }},
    {Section::kImu, "latency", "s", 0, 0.1, [](SimConfig& c, Item, double v) { c.imu->latency_s = v; }},
    {Section::kImu, "rate_walk", "rad/s", 0, 1,
     [](SimConfig& c, Item, double v) { c.imu->rate_walk_rad_s = v; }},
    {Section::kImu, "force_walk", "m/s^2", 0, 10,
     [](SimConfig& c, Item, double v) { c.imu->force_walk_m_s2 = v; }},
};

constexpr std::pair<Section, const char*> kSections[] = {
    {Section::kPlant, "plant"},       {Section::kBody, "bodies"},  {Section::kJoint, "joints"},
    {Section::kFriction, "friction"}, {Section::kDrive, "drives"}, {Section::kImu, "imu"},
};

std::vector<VariedSpan> read_spans(const YamlMap& map, Section section) {
  std::vector<VariedSpan> spans;
  for (const VariedQuantity& quantity : kQuantities) {
    if (quantity.section != section || !map.has(quantity.key)) continue;
    const YamlMap span = map.map(quantity.key);
    const double from = span.quantity("from", quantity.unit, quantity.low, quantity.high);
    spans.push_back({&quantity, from, span.quantity("to", quantity.unit, from, quantity.high)});
    span.finish();
  }
  map.finish();
  return spans;
}

}  // namespace

Variation read_variation(const YamlMap& file, const RobotConfig& robot) {
  const std::string name = file.text("robot");
  if (name != robot.name) file.fail("robot", "found '" + name + "', expected '" + robot.name + "'");
  Variation variation;
  if (file.has("elastic_gears")) variation.elastic_gears = file.flag("elastic_gears");
  if (file.has("real_windings")) variation.real_windings = file.flag("real_windings");
  for (const auto& [section, key] : kSections) {
    if (!file.has(key)) continue;
    const std::vector<VariedSpan> spans = read_spans(file.map(key), section);
    variation.spans.insert(variation.spans.end(), spans.begin(), spans.end());
  }
  for (const auto& [family, map] : file.map("families").entries())
    variation.families[family] = read_spans(map, Section::kFamily);
  file.finish();
  return variation;
}

Variation load_variation(const RobotConfig& robot) {
  const std::string path = robot.folder + "/variation.yaml";
  if (!std::filesystem::exists(path))
    throw ConfigError(path + ": is not there, so that this robot's plant cannot be drawn (--plant draw=K, " +
                      "family=NAME): copy it from the shipped robot that is nearest and change `robot`");
  return read_variation(YamlMap::load(path), robot);
}

}  // namespace sprung::sim
