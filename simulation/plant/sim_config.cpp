#include "simulation/plant/sim_config.h"

#include <algorithm>

#include "drivers/canopen/lss_frames.h"
#include "robots/robot_loader.h"
#include "robots/yaml_reader.h"
#include "simulation/plant/plant_draw.h"
#include "simulation/plant/world.h"

namespace sprung::sim {
namespace {

/// Whether an optional key says `yes`, where it may say `no`.
bool chosen(const YamlMap& map, const std::string& key, const std::string& yes, const std::string& no,
            bool otherwise) {
  if (!map.has(key)) return otherwise;
  const std::string found = map.text(key);
  if (found != yes && found != no) map.fail(key, "found '" + found + "', expected " + yes + " or " + no);
  return found == yes;
}

KinematicErrorConfig read_kinematic_error(const YamlMap& map) {
  KinematicErrorConfig error;
  error.amplitude_rad = map.quantity("amplitude", "rad", 0, 0.1);
  error.order = map.quantity_or("order", "", 0, 1000, error.order);
  error.phase_rad = map.quantity_or("phase", "rad", -10, 10, 0.0);
  map.finish();
  return error;
}

double read_sign(const YamlMap& map) {
  const auto sign = static_cast<double>(map.integer("direction", -1, 1));
  if (sign == 0.0) map.fail("direction", "expected 1 or -1, found 0");
  return sign;
}

MountingConfig read_mounting(const YamlMap& map) {
  MountingConfig mounting;
  mounting.zero_error_rad = map.quantity_or("zero_error", "rad", -1, 1, 0.0);
  if (map.has("direction")) mounting.direction = read_sign(map);
  if (!map.has("link_encoder")) return mounting;
  const YamlMap link = map.map("link_encoder");
  mounting.link_direction = read_sign(link);
  mounting.link_offset_rad = link.quantity("offset", "rad", -100, 100);
  link.finish();
  return mounting;
}

void read_optional(const YamlMap& map, SimDriveConfig& drive) {
  drive.supply_min_V = map.quantity_or("supply_min", "V", 0, drive.supply_V, drive.supply_min_V);
  drive.supply_max_V = map.quantity_or("supply_max", "V", drive.supply_V, 1000, drive.supply_max_V);
  drive.absolute_encoder = chosen(map, "encoder", "absolute", "incremental", drive.absolute_encoder);
  drive.index_angle_rad = map.quantity_or("index_angle", "rad", -10, 10, drive.index_angle_rad);
  drive.smoothing_s = map.quantity_or("position_smoothing", "s", 0, 1, drive.smoothing_s);
  drive.mode_delay_s = map.quantity_or("mode_delay", "s", 0, 1, drive.mode_delay_s);
  drive.factory_node = static_cast<int>(map.integer_or("factory_node", 0, 255, drive.factory_node));
  if (drive.factory_node > canopen::kMaxNode && drive.factory_node != canopen::kNoNode)
    map.fail("factory_node", "is no node id: expected 1..127, or 255 for none");
  if (map.has("starts_in_fault")) drive.starts_in_fault = map.flag("starts_in_fault");
  if (map.has("communication_faults"))
    drive.latches_communication_faults = chosen(map, "communication_faults", "latched", "passing", false);
  if (map.has("kinematic_error")) drive.kinematic_error = read_kinematic_error(map.map("kinematic_error"));
  drive.mounting = read_mounting(map);
  if (map.has("winding")) drive.winding = read_winding(map.map("winding"));
  if (map.has("current_sensor")) drive.current_sensor = read_current_sensor(map.map("current_sensor"));
  if (map.has("position_loop")) drive.position_loop = read_position_loop(map.map("position_loop"));
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
  read_optional(map, drive);
  map.finish();
  return drive;
}

SimCardConfig read_card(const YamlMap& map) {
  SimCardConfig card;
  card.name = map.text("card");
  card.noise_rad = map.quantity_or("noise", "rad", 0, 1, 0.0);
  map.finish();
  return card;
}

ContactConfig read_contact(const YamlMap& map) {
  ContactConfig contact;
  contact.stiffness_N_m = map.quantity("stiffness", "N/m", 1, 1e7);
  contact.damping_N_s_m = map.quantity("damping", "N s/m", 0, 1e6);
  contact.friction = map.quantity("friction", "", 0, 10);
  map.finish();
  return contact;
}

PlantBodyConfig read_body(const YamlMap& map) {
  PlantBodyConfig body;
  body.name = map.text("name");
  body.mass_kg = map.quantity("mass", "kg", 1e-4, 1000);
  body.length_factor = map.quantity_or("length_factor", "", 0.5, 2, 1.0);
  if (map.has("shift")) {
    const YamlMap shift = map.map("shift");
    body.shift_m = {shift.quantity_or("x", "m", -1, 1, 0.0), shift.quantity_or("y", "m", -1, 1, 0.0),
                    shift.quantity_or("z", "m", -1, 1, 0.0)};
    shift.finish();
  }
  map.finish();
  return body;
}

PlantConfig read_plant(const YamlMap& map) {
  PlantConfig plant;
  plant.step_s = map.quantity("step", "s", 50e-6, 1e-3);
  plant.rail_x_locked = chosen(map, "rail_x", "locked", "free", false);
  plant.torsion = chosen(map, "gears", "elastic", "rigid", true);
  plant.suspended_m = map.quantity_or("suspended", "m", 0.01, 10, 0.0);
  plant.lies = chosen(map, "starts", "lying", "standing", false);
  plant.floor_height_m = map.quantity("floor_height", "m", -10, 10);
  if (map.has("ground")) plant.ground = read_ground(map.map("ground"));
  plant.ambient_degC = map.quantity_or("ambient", "degC", -50, 150, plant.ambient_degC);
  for (const YamlMap& body : map.list("bodies")) {
    plant.bodies.push_back(read_body(body));
  }
  for (const YamlMap& joint : map.list("joints")) plant.joints.push_back(read_plant_joint(joint));
  plant.contact = read_contact(map.map("contact"));
  map.finish();
  return plant;
}

TorqueSensorConfig read_torque_sensor(const YamlMap& map, const RobotConfig& robot) {
  TorqueSensorConfig sensor;
  const std::string name = map.text("joint");
  const auto found = std::find_if(robot.joints.begin(), robot.joints.end(),
                                  [&](const JointConfig& joint) { return joint.name == name; });
  if (found == robot.joints.end()) map.fail("joint", "robot.yaml has no joint '" + name + "'");
  sensor.joint = static_cast<int>(found - robot.joints.begin());
  sensor.rate_Hz = map.quantity("rate", "Hz", 1, 1000);
  sensor.noise_Nm = map.quantity("noise", "Nm", 0, 100);
  sensor.resolution_Nm = map.quantity("resolution", "Nm", 0, 100);
  map.finish();
  return sensor;
}

Vec3 read_turn(const YamlMap& map) {
  const Vec3 turn = {map.quantity_or("roll", "rad", -3.2, 3.2, 0.0),
                     map.quantity_or("pitch", "rad", -3.2, 3.2, 0.0),
                     map.quantity_or("yaw", "rad", -3.2, 3.2, 0.0)};
  map.finish();
  return turn;
}

ImuConfig read_imu(const YamlMap& map) {
  ImuConfig imu;
  const YamlMap rate = map.map("angular_velocity");
  imu.rate_noise_rad_s = rate.quantity("noise", "rad/s", 0, 10);
  imu.rate_bias_rad_s = rate.quantity("bias", "rad/s", 0, 10);
  imu.rate_walk_rad_s = rate.quantity_or("walk", "rad/s", 0, 1, 0.0);
  rate.finish();
  const YamlMap force = map.map("specific_force");
  imu.force_noise_m_s2 = force.quantity("noise", "m/s^2", 0, 100);
  imu.force_bias_m_s2 = force.quantity("bias", "m/s^2", 0, 100);
  imu.force_walk_m_s2 = force.quantity_or("walk", "m/s^2", 0, 10, 0.0);
  force.finish();
  const YamlMap attitude = map.map("attitude");
  imu.attitude_noise_rad = attitude.quantity("noise", "rad", 0, 1);
  imu.tilt_bias_rad = attitude.quantity("tilt_bias", "rad", 0, 1);
  imu.yaw_drift_rad_s = attitude.quantity("yaw_drift", "rad/s", 0, 1);
  attitude.finish();
  if (map.has("mounting")) imu.mounting_rad = read_turn(map.map("mounting"));
  imu.latency_s = map.quantity_or("latency", "s", 0, 0.1, 0.0);
  map.finish();
  return imu;
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

/// All or none of robot.yaml's.
std::vector<SimCardConfig> read_cards(const YamlMap& file, const RobotConfig& robot) {
  std::vector<SimCardConfig> cards;
  if (file.has("encoder_cards")) {
    for (const YamlMap& card : file.list("encoder_cards")) cards.push_back(read_card(card));
  } else {
    for (const EncoderCardConfig& card : robot.encoder_cards) cards.push_back({card.name});
  }
  return in_robot_order(
      cards, robot.encoder_cards, [](const SimCardConfig& c) { return c.name; }, file, "encoder_cards");
}

}  // namespace

SimConfig read_sim_config(const YamlMap& file, const RobotConfig& robot) {
  const std::string name = file.text("robot");
  if (name != robot.name) file.fail("robot", "found '" + name + "', expected '" + robot.name + "'");
  SimConfig config;
  const YamlMap plant = file.map("plant");
  config.plant = read_plant(plant);
  for (const YamlMap& drive : file.list("drives")) config.drives.push_back(read_drive(drive));
  config.cards = read_cards(file, robot);
  if (file.has("torque_sensor")) config.torque_sensor = read_torque_sensor(file.map("torque_sensor"), robot);
  if (file.has("imu")) config.imu = read_imu(file.map("imu"));
  config.timing = read_timing(file.map("timing"));
  config.real_windings = chosen(file, "windings", "real", "ideal", false);
  if (file.has("supply")) config.supply = read_supply(file.map("supply"));
  file.finish();
  config.plant.joints = in_robot_order(
      config.plant.joints, robot.joints, [](const PlantJointConfig& j) { return j.name; }, plant, "joints");
  config.drives = in_robot_order(
      config.drives, robot.actuators, [](const SimDriveConfig& d) { return d.actuator; }, file, "drives");
  return config;
}

SimConfig load_sim_config(const RobotConfig& robot, const std::map<std::string, double>& changes) {
  SimConfig config = read_sim_config(YamlMap::load(robot.folder + "/sim.yaml"), robot);
  std::map<std::string, double> others = changes;
  if (const auto draw = take_draw(others)) draw_plant(robot, load_variation(robot), *draw, config);
  take_world(robot, others, config.plant);
  apply_plant_changes(others, config);
  return config;
}

}  // namespace sprung::sim
