#include "drivers/sim/sim_config.h"

#include "robots/robot_loader.h"
#include "robots/yaml_reader.h"

namespace sprung::sim {
namespace {

FrictionConfig read_friction(const YamlMap& map) {
  FrictionConfig friction;
  friction.coulomb_Nm = map.quantity("coulomb", "Nm", 0, 1000);
  friction.breakaway_Nm = map.quantity("breakaway", "Nm", friction.coulomb_Nm, 1000);
  friction.stribeck_speed_rad_s = map.quantity("stribeck_speed", "rad/s", 1e-4, 100);
  friction.viscous_Nm_s_rad = map.quantity("viscous", "Nm s/rad", 0, 1000);
  friction.load_share = map.quantity("load_share", "", 0, 0.9);
  map.finish();
  return friction;
}

PlantJointConfig read_joint(const YamlMap& map) {
  PlantJointConfig joint;
  joint.name = map.text("name");
  const YamlMap stops = map.map("stops");
  joint.stop_min_rad = stops.quantity("min", "rad", -10, 10);
  joint.stop_max_rad = stops.quantity("max", "rad", joint.stop_min_rad, 10);
  stops.finish();
  joint.initial_rad = map.quantity("initial", "rad", joint.stop_min_rad, joint.stop_max_rad);
  joint.armature_kg_m2 = map.quantity("armature", "kg m^2", 1e-6, 100);
  joint.friction = read_friction(map.map("friction"));
  map.finish();
  return joint;
}

SimDriveConfig read_drive(const YamlMap& map) {
  SimDriveConfig drive;
  drive.actuator = map.text("actuator");
  drive.torque_constant_Nm_A = map.quantity("torque_constant", "Nm/A", 1e-4, 100);
  drive.torque_loop_Hz = map.quantity("torque_loop", "Hz", 1, 10000);
  drive.peak_torque_Nm = map.quantity("peak_torque", "Nm", 0.001, 10000);
  drive.torque_noise_Nm = map.quantity("torque_noise", "Nm", 0, 100);
  drive.supply_V = map.quantity("supply", "V", 0, 1000);
  drive.quick_stop_damping_Nm_s_rad = map.quantity("quick_stop_damping", "Nm s/rad", 0, 1000);
  map.finish();
  return drive;
}

PlantConfig read_plant(const YamlMap& map) {
  PlantConfig plant;
  plant.step_s = map.quantity("step", "s", 50e-6, 1e-3);
  if (map.has("rail_x")) {
    const std::string rail = map.text("rail_x");
    if (rail != "locked" && rail != "free")
      map.fail("rail_x", "found '" + rail + "', expected locked or free");
    plant.rail_x_locked = rail == "locked";
  }
  plant.suspended_m = map.quantity_or("suspended", "m", 0.01, 10, 0.0);
  plant.floor_height_m = map.quantity("floor_height", "m", -10, 10);
  for (const YamlMap& body : map.list("bodies")) {
    plant.bodies.push_back({body.text("name"), body.quantity("mass", "kg", 1e-4, 1000)});
    body.finish();
  }
  for (const YamlMap& joint : map.list("joints")) plant.joints.push_back(read_joint(joint));
  const YamlMap contact = map.map("contact");
  plant.contact.stiffness_N_m = contact.quantity("stiffness", "N/m", 1, 1e7);
  plant.contact.damping_N_s_m = contact.quantity("damping", "N s/m", 0, 1e6);
  plant.contact.friction = contact.quantity("friction", "", 0, 10);
  contact.finish();
  map.finish();
  return plant;
}

/// sim.yaml may list joints and drives in any order, but every one of robot.yaml's exactly once.
template <typename Item, typename Wanted, typename NameOf>
std::vector<Item> in_robot_order(const std::vector<Item>& found, const std::vector<Wanted>& wanted,
                                 NameOf name_of, const YamlMap& map, const std::string& key) {
  std::vector<Item> ordered;
  for (const Wanted& entry : wanted) {
    int matches = 0;
    for (const Item& item : found) {
      if (name_of(item) != entry.name) continue;
      ordered.push_back(item);
      ++matches;
    }
    if (matches != 1) map.fail(key, "robot.yaml's '" + entry.name + "' must be listed exactly once");
  }
  if (found.size() != wanted.size()) map.fail(key, "lists names that robot.yaml does not have");
  return ordered;
}

}  // namespace

SimConfig load_sim_config(const RobotConfig& robot, const std::map<std::string, double>& changes) {
  const YamlMap file = YamlMap::load(robot.folder + "/sim.yaml");
  const std::string name = file.text("robot");
  if (name != robot.name) file.fail("robot", "found '" + name + "', expected '" + robot.name + "'");
  SimConfig config;
  const YamlMap plant = file.map("plant");
  config.plant = read_plant(plant);
  for (const YamlMap& drive : file.list("drives")) config.drives.push_back(read_drive(drive));
  const YamlMap timing = file.map("timing");
  config.timing.compute_s = timing.quantity("compute_time", "s", 0, 0.1);
  config.timing.sync_jitter_s = 1e-6 * timing.quantity("sync_jitter", "us", 0, 1000);
  timing.finish();
  file.finish();
  config.plant.joints = in_robot_order(
      config.plant.joints, robot.joints, [](const PlantJointConfig& j) { return j.name; }, plant, "joints");
  config.drives = in_robot_order(
      config.drives, robot.actuators, [](const SimDriveConfig& d) { return d.actuator; }, file, "drives");
  apply_plant_changes(changes, config);
  return config;
}

}  // namespace sprung::sim
