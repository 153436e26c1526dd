#include "robots/robot_sections.h"

#include <algorithm>
#include <array>

#include "robots/identification_sections.h"
#include "robots/reading_sections.h"

namespace sprung::robot_sections {

namespace {

template <class Named>
std::vector<int> indices_of(const std::vector<Named>& things, const YamlMap& map, const std::string& key) {
  std::vector<int> indices;
  for (const std::string& wanted : map.texts(key)) {
    indices.push_back(index_of(things, wanted, map, key));
  }
  return indices;
}

constexpr double kShortestLink_m = 0.01;

LinkConfig read_link(const YamlMap& map, double shortest_m) {
  LinkConfig link;
  link.length_m = map.quantity("length", "m", shortest_m, 2.0);
  link.mass_kg = map.quantity("mass", "kg", 0.0, 100.0);
  link.com_m = map.quantity("com", "m", -1.0, 2.0);
  link.inertia_kg_m2 = map.quantity("inertia", "kg m^2", 0.0, 10.0);
  map.finish();
  return link;
}

std::vector<double> read_transmission(const YamlMap& map, std::size_t count) {
  std::vector<double> flat;
  const auto rows = map.matrix("transmission", -10.0, 10.0);
  for (const auto& row : rows) {
    flat.insert(flat.end(), row.begin(), row.end());
  }
  if (rows.size() != count || flat.size() != count * count) {
    map.fail("transmission",
             "expected " + std::to_string(count) + " rows of " + std::to_string(count) + " numbers");
  }
  return flat;
}

/// The link encoder and how the zero is found; both may be missing.
void read_reference_of(const YamlMap& map, const RobotConfig& robot, ActuatorConfig& a) {
  if (map.has("link_encoder"))
    a.link_encoder = read_link_encoder(map.map("link_encoder"), robot.encoder_cards);
  if (!map.has("reference")) return;
  a.reference = read_reference(map.map("reference"));
  if (a.reference.method == ReferenceMethod::kLink && a.link_encoder.card < 0) {
    map.fail("reference", "method link needs a link_encoder");
  }
  if (!a.reference.absolute_encoder && a.referenced) {
    map.fail("referenced",
             "an incremental encoder forgets its zero without power: say false here, and `sprung home` "
             "after each start");
  }
}

struct KinematicsShape {
  const char* kinematics;
  std::size_t joints;  ///< and as many links
  const char* joint_names;
  const char* link_names;
};

constexpr std::array<KinematicsShape, 3> kShapes{{
    {kOneLink, 1, "arm", "arm"},
    {kTwoLink, 2, "hip, knee", "thigh, shank"},
    {kThreeJoint, 3, "abduction, hip, knee", "hip, thigh, shank"},
}};

const KinematicsShape& shape_of(const YamlMap& map, const std::string& kinematics) {
  std::string known;
  for (const KinematicsShape& shape : kShapes) {
    if (kinematics == shape.kinematics) return shape;
    known += std::string(shape.kinematics) + ", ";
  }
  map.fail("kinematics",
           "expected " + known + "or " + kNoKinematics + " (joints alone), found '" + kinematics + "'");
}

void require_count(const YamlMap& map, const char* key, std::size_t found, const KinematicsShape& shape,
                   const char* names) {
  if (found == shape.joints) return;
  map.fail(key, std::string(shape.kinematics) + " needs " + std::to_string(shape.joints) + " (" + names +
                    "), found " + std::to_string(found));
}

LegSide read_side(const YamlMap& map) {
  const std::string side = map.text("side");
  if (side == "left") return LegSide::kLeft;
  if (side == "right") return LegSide::kRight;
  map.fail("side",
           "expected left or right: where the leg's plane lies, seen from its abduction axis; found '" +
               side + "'");
}

/// Geometry and contact, which joints alone do not have.
void read_geometry(const YamlMap& map, LegConfig& leg) {
  const KinematicsShape& shape = shape_of(map, leg.kinematics);
  const bool sideways = leg.kinematics == kThreeJoint;
  if (sideways) leg.side = read_side(map);
  for (const YamlMap& link : map.list("links")) {
    const bool offset = sideways && leg.links.empty();  // which may be none
    leg.links.push_back(read_link(link, offset ? 0.0 : kShortestLink_m));
  }
  require_count(map, "joints", leg.joints.size(), shape, shape.joint_names);
  require_count(map, "links", leg.links.size(), shape, shape.link_names);
  leg.foot_radius_m = map.quantity_or("foot_radius", "m", 0.0, 0.2, 0.0);
  const YamlMap contact = map.map("contact");
  leg.contact_on_N = contact.quantity("on", "N", 0.1, 1e4);
  leg.contact_off_N = contact.quantity("off", "N", 0.0, leg.contact_on_N);
  leg.contact_rise_s = contact.quantity("rise", "s", 0, 1);
  leg.contact_fall_s = contact.quantity("fall", "s", 0, 1);
  contact.finish();
}

SupplyConfig read_supply(const YamlMap& map) {
  SupplyConfig supply{map.quantity("min", "V", 5, 1000), map.quantity("max", "V", 5, 1000)};
  if (supply.max_V <= supply.min_V) map.fail("max", "must be above min");
  map.finish();
  return supply;
}

EmergencyInputConfig read_emergency_input(const YamlMap& map) {
  EmergencyInputConfig input;
  input.bit = static_cast<int>(map.integer("bit", 0, 31));
  const std::string stops = map.text("stops_at");
  if (stops != "0" && stops != "1")
    map.fail("stops_at", "expected 0 (what a cut wire gives) or 1, found '" + stops + "'");
  input.stops_high = stops == "1";
  map.finish();
  return input;
}

MotorKind read_motor_kind(const YamlMap& map) {
  const std::string motor = map.text("motor");
  if (motor == "brushless") return MotorKind::kBrushless;
  if (motor == "sinusoidal") return MotorKind::kSinusoidal;
  if (motor == "block") return MotorKind::kBlock;
  if (motor != "brushed")
    map.fail("motor", "expected brushless, sinusoidal, block or brushed, found '" + motor + "'");
  return MotorKind::kBrushed;
}

CommissioningConfig read_commissioning(const YamlMap& map) {
  CommissioningConfig c;
  if (map.has("motor")) c.motor = read_motor_kind(map);
  if (map.has("encoder_inverted")) c.encoder_inverted = map.flag("encoder_inverted");
  if (map.has("brake")) c.brake = map.flag("brake");
  if (map.has("current_gains")) {
    const YamlMap gains = map.map("current_gains");
    c.current_p = static_cast<int>(gains.integer("p", 1, 32767));
    c.current_i = static_cast<int>(gains.integer("i", 1, 32767));
    gains.finish();
  }
  map.finish();
  return c;
}

}  // namespace

BusConfig read_bus(const YamlMap& map) {
  BusConfig bus{map.text("name"), map.text("can")};
  const bool known = bus.can.rfind("socketcan:", 0) == 0 || bus.can.rfind("udp:", 0) == 0 ||
                     bus.can.rfind("memory:", 0) == 0;
  if (!known) {
    map.fail("can", "expected socketcan:IFACE, udp:GROUP:PORT or memory:NAME, found '" + bus.can + "'");
  }
  map.finish();
  return bus;
}

namespace {

void read_position_loop(const YamlMap& map, ActuatorConfig& a) {
  const bool host = map.has("closed_by") && choice(map, "closed_by", {"drive", "host"}) == 1;
  a.position_loop = host ? PositionLoopSide::kHost : PositionLoopSide::kDrive;
  a.position_stiffness_Nm_rad = map.quantity("stiffness", "Nm/rad", 0, 1e5);
  a.position_damping_Nm_s_rad = map.quantity("damping", "Nm s/rad", 0, 1e4);
  a.position_gains_object = static_cast<std::uint16_t>(map.integer_or("object", 0, 0xFFFF, 0));
  map.finish();
}

}  // namespace

ActuatorConfig read_actuator(const YamlMap& map, const RobotConfig& robot) {
  ActuatorConfig a;
  a.name = map.text("name");
  a.bus = index_of(robot.buses, map.text("bus"), map, "bus");
  a.node = static_cast<int>(map.integer("node", 1, 126));
  a.profile = map.text("profile");
  a.identity = read_identity(map.map("identity"));
  a.watch = read_node_watch(map);
  a.gear_ratio = map.quantity("gear_ratio", "", 1, 1000);
  a.direction = read_direction(map);
  a.torque_constant_Nm_A = map.quantity("torque_constant", "Nm/A", 1e-4, 10);
  a.rated_current_A = map.quantity("rated_current", "A", 0.01, 1000);
  a.encoder_counts_per_turn = static_cast<double>(map.integer("encoder_counts", 16, 1 << 24));
  a.offset_rad = map.quantity("offset", "rad", -100, 100);
  a.referenced = map.flag("referenced");
  if (map.has("referenced_on")) a.referenced_on = read_date(map, "referenced_on");
  if (!a.referenced && !a.referenced_on.empty())
    map.fail("referenced_on",
             "is of a zero that stands here, and `referenced` is false; remove one of the two");
  a.torque_limit_Nm = map.quantity("torque_limit", "Nm", 0.01, 2000);
  a.speed_limit_rad_s = map.quantity("speed_limit", "rad/s", 0.01, 200);
  a.power_limit_W = map.quantity_or("power_limit", "W", 1, 1e5, 0.0);
  a.speed_limit_object = static_cast<std::uint16_t>(map.integer("speed_limit_object", 0, 0xFFFF));
  a.position_limits_object = static_cast<std::uint16_t>(
      map.integer_or("position_limits_object", 0, 0xFFFF, 0));
  read_position_loop(map.map("position_loop"), a);
  a.safety_damping_Nm_s_rad = map.quantity("safety_damping", "Nm s/rad", 0.1, 1000);
  a.pole_pairs = static_cast<int>(map.integer_or("pole_pairs", 1, 255, 0));
  a.winding_time_constant_s = map.quantity_or("winding_time_constant", "s", 0.1, 1000, 0.0);
  a.restore_settings = map.has("restore_settings") && map.flag("restore_settings");
  if (map.has("temperature")) a.temperature = read_temperature(map.map("temperature"));
  if (map.has("supply")) a.supply = read_supply(map.map("supply"));
  if (map.has("emergency_input")) a.emergency_input = read_emergency_input(map.map("emergency_input"));
  if (map.has("commissioning")) a.commissioning = read_commissioning(map.map("commissioning"));
  read_reference_of(map, robot, a);
  map.finish();
  return a;
}

JointConfig read_joint(const YamlMap& map) {
  JointConfig joint;
  joint.name = map.text("name");
  const YamlMap position = map.map("position");
  joint.position_min_rad = position.quantity("min", "rad", -10, 10);
  joint.position_max_rad = position.quantity("max", "rad", -10, 10);
  if (joint.position_max_rad <= joint.position_min_rad) {
    position.fail("max", "must be above min");
  }
  position.finish();
  joint.armature_kg_m2 = map.quantity("armature", "kg m^2", 0, 50);
  joint.coulomb_friction_Nm = map.quantity("coulomb_friction", "Nm", 0, 500);
  joint.friction_source = map.text("friction_source");
  read_identification(map, joint);
  if (map.has("torsion")) joint.torsion = read_torsion(map.map("torsion"));
  map.finish();
  return joint;
}

LegConfig read_leg(const YamlMap& map, const RobotConfig& robot) {
  LegConfig leg;
  leg.name = map.text("name");
  leg.kinematics = map.text("kinematics");
  leg.joints = indices_of(robot.joints, map, "joints");
  leg.actuators = indices_of(robot.actuators, map, "actuators");
  if (leg.joints.size() != leg.actuators.size()) {
    map.fail("actuators", "a leg needs as many actuators as joints");
  }
  leg.transmission = read_transmission(map, leg.joints.size());
  if (leg.kinematics != kNoKinematics) {
    read_geometry(map, leg);
  }
  if (map.has("hip_in_trunk")) {
    const YamlMap hip = map.map("hip_in_trunk");
    leg.hip_in_trunk_m = {hip.quantity("x", "m", -2, 2), hip.quantity("y", "m", -2, 2),
                          hip.quantity("z", "m", -2, 2)};
    hip.finish();
  }
  map.finish();
  return leg;
}

namespace {

/// The longest that each watchdog may wait, seconds and cycles.
struct LongestWaits {
  double hold_s, stop_s, input_s, heartbeat_s, consumer_s, drive_heartbeat_s;
  int silent_cycles, overruns;
};
// [design choice] On a robot: in 100 ms of full torque a joint moves by 0.35 rad (pegasus) to 0.75
// (single_leg; docs/sources.md, facts canopen 2.6), so nothing that could give it waits longer for the first
// reaction.
constexpr LongestWaits kOnARobot{0.05, 0.5, 0.1, 0.02, 0.1, 0.5, 10, 50};
// In simulation nothing can be hurt, and emulated machines stall for seconds (tests/vm).
constexpr LongestWaits kInSimulation{1.0, 10.0, 1.0, 1.0, 10.0, 10.0, 1000, 1000};

}  // namespace

WatchdogConfig read_watchdogs(const YamlMap& map, bool simulation) {
  const LongestWaits& most = simulation ? kInSimulation : kOnARobot;
  WatchdogConfig w;
  w.command_hold_s = map.quantity("command_hold", "s", 0, most.hold_s);
  w.command_stop_s = map.quantity("command_stop", "s", w.command_hold_s, most.stop_s);
  w.leg_command_s = map.quantity("leg_command", "s", 0, most.input_s);
  w.joint_state_s = map.quantity("joint_state", "s", 0, most.input_s);
  w.silent_cycles = static_cast<int>(map.integer("silent_cycles", 0, most.silent_cycles));
  w.overruns_in_row = static_cast<int>(map.integer("overruns_in_row", 1, most.overruns));
  w.heartbeat_s = map.quantity("heartbeat", "s", 0.001, most.heartbeat_s);
  w.heartbeat_consumer_s = map.quantity("heartbeat_consumer", "s", 2 * w.heartbeat_s, most.consumer_s);
  w.drive_heartbeat_s = map.quantity("drive_heartbeat", "s", 2 * w.heartbeat_s, most.drive_heartbeat_s);
  map.finish();
  return w;
}

namespace {

RestartPolicy read_restart_policy(const YamlMap& map) {
  const std::string text = map.text("restart");
  if (text == "never") return RestartPolicy::kNever;
  if (text != "without_torque") map.fail("restart", "'" + text + "' is neither never nor without_torque");
  return RestartPolicy::kWithoutTorque;
}

}  // namespace

ProcessConfig read_process(const YamlMap& map) {
  ProcessConfig process;
  process.program = map.text("program");
  process.priority = static_cast<int>(map.integer("priority", 0, 98));
  process.cpu = static_cast<int>(map.integer("cpu", -1, 1023));
  if (map.has("restart")) process.restart = read_restart_policy(map);
  if (map.has("host")) process.host = map.text("host");
  map.finish();
  return process;
}

}  // namespace sprung::robot_sections
