#include "simulation/plant/robot_check.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include "robots/config_error.h"
#include "robots/yaml_reader.h"
#include "simulation/plant/model_places.h"
#include "simulation/plant/mujoco_row.h"
#include "simulation/plant/plant_model.h"

namespace sprung::sim {
namespace {

using Eigen::Vector3d;

constexpr double kTurn_rad = 6.283185307179586;

std::string quantity(double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, "%.4g%s%s", value, *unit == '\0' ? "" : " ", unit);
  return text;
}

std::string direction_text(const Vector3d& v) {
  for (int axis = 0; axis < 3; ++axis) {
    if (std::abs(v[axis]) > 0.99) return std::string(v[axis] > 0 ? "+" : "-") + "xyz"[axis];
  }
  char text[64];
  std::snprintf(text, sizeof text, "(%.2f %.2f %.2f)", v.x(), v.y(), v.z());
  return text;
}

/// What a kinematics says of its joints at zero: axes, and where each link points. model/three_joint.h,
/// two_link.h, one_link.h.
struct ZeroPose {
  std::vector<Vector3d> axes;
  std::vector<Vector3d> links;  ///< the hip link of three joints: by its side
};

ZeroPose zero_pose(const LegConfig& leg) {
  const Vector3d x = Vector3d::UnitX(), y = Vector3d::UnitY(), z = Vector3d::UnitZ();
  if (leg.kinematics == kOneLink) return {{-y}, {-z}};
  if (leg.kinematics == kTwoLink) return {{y, -y}, {x, x}};
  return {{x, y, -y}, {static_cast<double>(leg.side) * y, x, x}};
}

class Check {
 public:
  Check(const RobotConfig& robot, CheckAgainst against, const CheckTolerance& tolerance)
      : robot_(robot),
        tolerance_(tolerance),
        file_(YamlMap::load(robot.folder + "/robot.yaml")),
        places_(robot.folder + "/model.xml"),
        model_(load_model_xml(places_.path())),
        data_(mj_makeData(model_.get())) {
    if (against == CheckAgainst::kModelAndSim) {
      sim_ = load_sim_config(robot, {});
      sim_file_ = YamlMap::load(robot.folder + "/sim.yaml");
    }
    take_zero_pose();
  }

  std::vector<std::string> run() {
    find_names();
    if (!findings_.empty()) return findings_;  // geometry needs them all
    for (std::size_t i = 0; i < robot_.legs.size(); ++i) {
      if (robot_.legs[i].kinematics != kNoKinematics) check_leg(i);
    }
    check_hips();
    check_trunk();
    check_lengths_to_stand_at();
    if (sim_) check_plant();
    return findings_;
  }

 private:
  void add(const std::string& what, const std::string& here, const std::string& at, const std::string& there,
           const std::string& there_at) {
    findings_.push_back(what + ": " + here + " in " + at + ", " + there + " in " + there_at);
  }
  std::string place(const std::string& path) const { return file_.place(path); }
  std::string leg_path(std::size_t leg) const { return "legs[" + std::to_string(leg) + "]"; }
  const std::string& joint_name(int joint) const { return robot_.joints[joint].name; }
  int id(mjtObj type, const std::string& name) const { return mj_name2id(model_.get(), type, name.c_str()); }
  std::string body_name(int body) const {
    const char* const name = mj_id2name(model_.get(), mjOBJ_BODY, body);
    return name != nullptr ? name : "";
  }
  int body_of(int joint) const { return model_->jnt_bodyid[id(mjOBJ_JOINT, joint_name(joint))]; }

  void take_zero_pose();
  void find_names();
  void need(mjtObj type, const char* element, const std::string& name, const std::string& at);
  Vector3d in_base(const mjtNum* world) const;
  Vector3d turned_to_base(const mjtNum* world) const;
  Vector3d anchor(int joint) const {
    return in_base(row(data_->xanchor, id(mjOBJ_JOINT, joint_name(joint)), 3));
  }
  Vector3d foot(const LegConfig& leg) const {
    return in_base(row(data_->geom_xpos, id(mjOBJ_GEOM, leg.name + "_foot"), 3));
  }
  std::vector<Vector3d> corners(const LegConfig& leg) const;
  void check_leg(std::size_t index);
  void check_axis(std::size_t leg, std::size_t k, const Vector3d& expected);
  void check_link(std::size_t leg, std::size_t k, const Vector3d& link, const Vector3d& expected);
  void check_link_mass(std::size_t leg, std::size_t k);
  void check_foot(std::size_t index);
  void check_hips();
  void check_trunk();
  void check_lengths_to_stand_at();
  void check_reach(std::size_t leg, const std::string& what, const std::string& path, double length_m,
                   bool shortest);
  void check_plant();
  void check_drive(std::size_t index);
  void check_joint(std::size_t index);
  double mass_kg(int body) const;
  std::string mass_place(int body) const;
  bool differs(double a, double b, double share, double absolute) const {
    return std::abs(a - b) > std::max(absolute, share * std::max(std::abs(a), std::abs(b)));
  }

  const RobotConfig& robot_;
  CheckTolerance tolerance_;
  YamlMap file_;
  ModelPlaces places_;
  ModelPtr model_;
  DataPtr data_;
  std::optional<SimConfig> sim_;
  std::optional<YamlMap> sim_file_;
  std::vector<std::string> findings_;
};

void Check::take_zero_pose() {
  mj_resetData(model_.get(), data_.get());
  for (const JointConfig& joint : robot_.joints) {
    const int found = id(mjOBJ_JOINT, joint.name);
    if (found >= 0) data_->qpos[model_->jnt_qposadr[found]] = 0.0;
  }
  mj_kinematics(model_.get(), data_.get());
}

void Check::need(mjtObj type, const char* element, const std::string& name, const std::string& at) {
  if (id(type, name) < 0)
    findings_.push_back(std::string("no ") + element + " '" + name + "' in " + places_.path() + ", which " +
                        at + " needs");
}

void Check::find_names() {
  need(mjOBJ_BODY, "body", "base", place("robot"));
  for (const JointConfig& joint : robot_.joints)
    need(mjOBJ_JOINT, "joint", joint.name, place("joints[" + joint.name + "].name"));
  for (std::size_t i = 0; i < robot_.legs.size(); ++i)
    need(mjOBJ_GEOM, "geom", robot_.legs[i].name + "_foot", place(leg_path(i) + ".name"));
}

Vector3d Check::turned_to_base(const mjtNum* world) const {
  const mjtNum* const turn = row(data_->xmat, id(mjOBJ_BODY, "base"), 9);
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(turn).transpose() *
         Eigen::Map<const Vector3d>(world);
}

Vector3d Check::in_base(const mjtNum* world) const {
  const Vector3d from_base = Eigen::Map<const Vector3d>(world) -
                             Eigen::Map<const Vector3d>(row(data_->xpos, id(mjOBJ_BODY, "base"), 3));
  return turned_to_base(from_base.data());
}

/// Joint by joint, then the foot.
std::vector<Vector3d> Check::corners(const LegConfig& leg) const {
  std::vector<Vector3d> found;
  for (const int joint : leg.joints) found.push_back(anchor(joint));
  found.push_back(foot(leg));
  return found;
}

void Check::check_leg(std::size_t index) {
  const LegConfig& leg = robot_.legs[index];
  const ZeroPose zero = zero_pose(leg);
  const std::vector<Vector3d> at = corners(leg);
  for (std::size_t k = 0; k < leg.links.size(); ++k) {
    check_axis(index, k, zero.axes[k]);
    check_link(index, k, at[k + 1] - at[k], zero.links[k]);
    check_link_mass(index, k);
  }
  check_foot(index);
}

void Check::check_foot(std::size_t index) {
  const LegConfig& leg = robot_.legs[index];
  const double there_m = row(model_->geom_size, id(mjOBJ_GEOM, leg.name + "_foot"), 3)[0];
  if (std::abs(there_m - leg.foot_radius_m) > tolerance_.length_m)
    add(leg.name + "'s foot has a radius of", quantity(leg.foot_radius_m, "m"),
        place(leg_path(index) + ".foot_radius"), quantity(there_m, "m"),
        places_.of("geom", leg.name + "_foot"));
}

void Check::check_axis(std::size_t leg, std::size_t k, const Vector3d& expected) {
  const std::string& name = joint_name(robot_.legs[leg].joints[k]);
  const Vector3d axis = turned_to_base(row(data_->xaxis, id(mjOBJ_JOINT, name), 3));
  if ((axis - expected).norm() <= tolerance_.angle_rad) return;
  add("joint " + name + " turns about", direction_text(expected) + " (" + robot_.legs[leg].kinematics + ")",
      place(leg_path(leg) + ".kinematics"), direction_text(axis), places_.of("joint", name));
}

/// Along the leg; three joints: the first one sideways.
void Check::check_link(std::size_t leg, std::size_t k, const Vector3d& link, const Vector3d& expected) {
  const LegConfig& config = robot_.legs[leg];
  const std::string what = config.name + "'s link " + std::to_string(k);
  const bool last = k + 1 == config.links.size();
  const std::string there = last ? places_.of("geom", config.name + "_foot")
                                 : places_.of("body", body_name(body_of(config.joints[k + 1])));
  const bool sideways = config.kinematics == kThreeJoint && k == 0;
  const double length_m = sideways ? std::abs(link.y()) : link.norm();
  if (std::abs(length_m - config.links[k].length_m) > tolerance_.length_m)
    add(what + " is long", quantity(config.links[k].length_m, "m"),
        place(leg_path(leg) + ".links[" + std::to_string(k) + "].length"), quantity(length_m, "m"), there);
  if (length_m <= tolerance_.length_m) return;
  const Vector3d points = (sideways ? Vector3d(0, link.y(), 0) : link).normalized();
  if ((points - expected).norm() > tolerance_.angle_rad)
    add(what + " points at zero to", direction_text(expected),
        place(leg_path(leg) + (sideways ? ".side" : ".kinematics")), direction_text(points), there);
}

/// Of all that is welded to the body; sim.yaml's masses are written over model.xml's.
double Check::mass_kg(int body) const {
  double sum_kg = 0.0;
  for (int other = 0; other < model_->nbody; ++other) {
    if (model_->body_weldid[other] != model_->body_weldid[body]) continue;
    double own_kg = model_->body_mass[other];
    for (const PlantBodyConfig& given : sim_ ? sim_->plant.bodies : std::vector<PlantBodyConfig>{}) {
      if (given.name == body_name(other)) own_kg = given.mass_kg;
    }
    sum_kg += own_kg;
  }
  return sum_kg;
}

std::string Check::mass_place(int body) const {
  const std::string name = body_name(body);
  for (const PlantBodyConfig& given : sim_ ? sim_->plant.bodies : std::vector<PlantBodyConfig>{}) {
    if (given.name == name) return sim_file_->place("plant.bodies[" + name + "].mass");
  }
  return places_.of("body", name);
}

void Check::check_link_mass(std::size_t leg, std::size_t k) {
  const LegConfig& config = robot_.legs[leg];
  const LinkConfig& link = config.links[k];
  const int body = body_of(config.joints[k]);
  const std::string what = config.name + "'s link " + std::to_string(k) + " (" + body_name(body) + ")";
  const std::string path = leg_path(leg) + ".links[" + std::to_string(k) + "].";
  if (differs(link.mass_kg, mass_kg(body), tolerance_.mass_share, tolerance_.mass_kg))
    add(what + " weighs", quantity(link.mass_kg, "kg"), place(path + "mass"), quantity(mass_kg(body), "kg"),
        mass_place(body));
  const double com_m = (in_base(row(data_->xipos, body, 3)) - anchor(config.joints[k])).norm();
  if (std::abs(com_m - std::abs(link.com_m)) > tolerance_.com_m)
    add(what + " has its centre of mass at", quantity(link.com_m, "m"), place(path + "com"),
        quantity(com_m, "m"), places_.of("body", body_name(body)));
}

/// From the middle of the hips, wherever model.xml's base has its origin.
void Check::check_hips() {
  if (robot_.legs.size() < 2) return;
  Vector3d middle = Vector3d::Zero();
  for (const LegConfig& leg : robot_.legs)
    middle += anchor(leg.joints[0]) / static_cast<double>(robot_.legs.size());
  for (std::size_t i = 0; i < robot_.legs.size(); ++i) {
    const LegConfig& leg = robot_.legs[i];
    const Vector3d there = anchor(leg.joints[0]) - middle;
    for (int axis = 0; axis < 3; ++axis) {
      const double here_m = leg.hip_in_trunk_m[axis];
      if (std::abs(here_m - there[axis]) <= tolerance_.length_m) continue;
      add(leg.name + "'s hip lies in the trunk at " + "xyz"[axis], quantity(here_m, "m"),
          place(leg_path(i) + ".hip_in_trunk." + "xyz"[axis]), quantity(there[axis], "m"),
          places_.of("body", body_name(body_of(leg.joints[0]))));
    }
  }
}

void Check::check_trunk() {
  if (!(robot_.body.mass_kg > 0.0)) return;
  const int base = id(mjOBJ_BODY, "base");
  if (differs(robot_.body.mass_kg, mass_kg(base), tolerance_.mass_share, tolerance_.mass_kg))
    add("the trunk weighs", quantity(robot_.body.mass_kg, "kg"), place("body.mass"),
        quantity(mass_kg(base), "kg"), mass_place(base));
}

void Check::check_reach(std::size_t leg, const std::string& what, const std::string& path, double length_m,
                        bool shortest) {
  const LegConfig& config = robot_.legs[leg];
  const std::vector<Vector3d> at = corners(config);
  const std::size_t knee = config.joints.size() - 1;
  const double thigh_m = (at[knee] - at[knee - 1]).norm(), shank_m = (at[knee + 1] - at[knee]).norm();
  const JointConfig& joint = robot_.joints[config.joints[knee]];
  const double bend_rad = shortest ? joint.position_max_rad : std::max(0.0, joint.position_min_rad);
  const double reach_m = std::sqrt(thigh_m * thigh_m + shank_m * shank_m +
                                   2 * thigh_m * shank_m * std::cos(bend_rad));
  if (shortest ? length_m >= reach_m - tolerance_.length_m : length_m <= reach_m + 1e-4) return;
  add(what, quantity(length_m, "m"), place(path),
      std::string(shortest ? "at least " : "at most ") + quantity(reach_m, "m") +
          " with the knee at its limit of " + quantity(bend_rad, "rad"),
      places_.of("geom", config.name + "_foot"));
}

void Check::check_lengths_to_stand_at() {
  if (!robot_.has_feet() || robot_.legs.empty()) return;
  for (const PresetConfig& preset : robot_.presets) {
    const std::string path = "presets." + preset.name + ".";
    check_reach(0, preset.name + "'s stand_length", path + "stand_length", preset.stand_length_m, false);
    check_reach(0, preset.name + "'s sit_length", path + "sit_length", preset.sit_length_m, true);
  }
  for (const GaitConfig& gait : robot_.gaits) {
    if (gait.height_m > 0.0)
      check_reach(0, "gait " + gait.name + "'s height", "gaits." + gait.name + ".height", gait.height_m,
                  false);
  }
}

void Check::check_drive(std::size_t index) {
  const ActuatorConfig& here = robot_.actuators[index];
  const SimDriveConfig& there = sim_->drives[index];
  const auto at = [&](const std::string& key) { return place("actuators[" + here.name + "]." + key); };
  const auto sim_at = [&](const std::string& key) {
    return sim_file_->place("drives[" + here.name + "]." + key);
  };
  if (there.mounting.direction && *there.mounting.direction != here.direction)
    add(here.name + "'s motor and encoder have direction", quantity(here.direction, ""), at("direction"),
        quantity(*there.mounting.direction, ""), sim_at("direction"));
  if (there.mounting.link_direction && here.link_encoder.card >= 0) {
    if (*there.mounting.link_direction != here.link_encoder.direction)
      add(here.name + "'s link encoder has direction", quantity(here.link_encoder.direction, ""),
          at("link_encoder.direction"), quantity(*there.mounting.link_direction, ""),
          sim_at("link_encoder.direction"));
    const double off_rad = std::remainder(here.link_encoder.offset_rad - *there.mounting.link_offset_rad,
                                          kTurn_rad);
    if (std::abs(off_rad) > tolerance_.angle_rad)
      add(here.name + "'s link encoder has its zero at", quantity(here.link_encoder.offset_rad, "rad"),
          at("link_encoder.offset"), quantity(*there.mounting.link_offset_rad, "rad"),
          sim_at("link_encoder.offset"));
  }
  if (differs(here.torque_constant_Nm_A, there.torque_constant_Nm_A, tolerance_.constant_share, 0.0))
    add(here.name + "'s torque constant is", quantity(here.torque_constant_Nm_A, "Nm/A"),
        at("torque_constant"), quantity(there.torque_constant_Nm_A, "Nm/A"), sim_at("torque_constant"));
}

void Check::check_joint(std::size_t index) {
  const JointConfig& here = robot_.joints[index];
  const PlantJointConfig& there = sim_->plant.joints[index];
  const auto at = [&](const std::string& key) { return place("joints[" + here.name + "]." + key); };
  const auto sim_at = [&](const std::string& key) {
    return sim_file_->place("plant.joints[" + here.name + "]." + key);
  };
  if (here.position_min_rad < there.stop_min_rad - tolerance_.angle_rad)
    add("joint " + here.name + " goes down to", quantity(here.position_min_rad, "rad"), at("position.min"),
        "a stop at " + quantity(there.stop_min_rad, "rad"), sim_at("stops.min"));
  if (here.position_max_rad > there.stop_max_rad + tolerance_.angle_rad)
    add("joint " + here.name + " goes up to", quantity(here.position_max_rad, "rad"), at("position.max"),
        "a stop at " + quantity(there.stop_max_rad, "rad"), sim_at("stops.max"));
  if (differs(here.armature_kg_m2, there.armature_kg_m2, tolerance_.inertia_share, 0.0))
    add("joint " + here.name + "'s armature is", quantity(here.armature_kg_m2, "kg m^2"), at("armature"),
        quantity(there.armature_kg_m2, "kg m^2"), sim_at("armature"));
}

void Check::check_plant() {
  for (std::size_t i = 0; i < robot_.actuators.size(); ++i) check_drive(i);
  for (std::size_t i = 0; i < robot_.joints.size(); ++i) check_joint(i);
}

}  // namespace

bool has_model(const RobotConfig& robot) {
  std::error_code none;
  return std::filesystem::exists(robot.folder + "/model.xml", none);
}

std::vector<std::string> check_robot(const RobotConfig& robot, CheckAgainst against,
                                     const CheckTolerance& tolerance) {
  return Check(robot, against, tolerance).run();
}

}  // namespace sprung::sim
