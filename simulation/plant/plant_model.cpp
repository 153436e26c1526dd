#include "simulation/plant/plant_model.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>
#include <mutex>

#include "robots/robot_loader.h"
#include "simulation/plant/ground_contact.h"
#include "simulation/plant/mujoco_row.h"
#include "simulation/plant/point_mass.h"

namespace sprung::sim {

namespace {

/// Impedance of a spring-like contact, facts physics 3: 0.1 is 8 % soft, 0.005 triples the cost.
constexpr double kContactImpedance = 0.02;
/// Share of a foot's slip that a contact may take away in one step. More than 2 makes it jump to and fro, as
/// the damping of facts C6 does (300 N s/m) where the rotor is behind a gear's spring and the foot some 0.1
/// kg.
constexpr double kFastestContact = 1.0;
/// Impedance of dry friction that sticks, facts physics 1.
constexpr double kStickImpedance = 0.9999;
/// End stops: 5 ms instead of MuJoCo's 20 ms, critically damped [design choice].
constexpr double kStopTime_s = 0.005;

int require(const mjModel& model, mjtObj type, const std::string& name) {
  const int id = mj_name2id(&model, type, name.c_str());
  if (id < 0) throw ConfigError("model.xml: no " + std::string(mju_type2Str(type)) + " '" + name + "'");
  return id;
}

/// MuJoCo's text in one line: what shows only the first line of an error would show "XML parse error 15:" and
/// nothing after.
std::string in_one_line(const std::string& text) {
  std::string out;
  for (const char c : text) {
    const bool gap = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!gap) out += c;
    if (gap && !out.empty() && out.back() != ' ') out += ' ';
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  return out;
}

/// ":20" where MuJoCo says "Line number=20", "line 20" or "line = 20"; "" where it names none.
std::string line_of(const std::string& text) {
  for (const char* const before : {"Line number=", "line = ", "line "}) {
    const std::size_t at = text.find(before);
    const int line = at == std::string::npos ? 0 : std::atoi(text.c_str() + at + std::strlen(before));
    if (line > 0) return ":" + std::to_string(line);
  }
  return "";
}

[[noreturn]] void refuse_xml(const std::string& path, const std::string& says) {
  const std::string text = in_one_line(says);
  throw ConfigError(path + line_of(text) +
                    ": MuJoCo cannot make a model of it: " + (text.empty() ? "it does not say why" : text) +
                    "; mend that place, or take the file back as it was (git diff shows what was changed)");
}

int height_qpos(const mjModel& model, int base_body) {
  if (model.body_weldid[base_body] == 0) return -1;
  const int first = model.body_jntadr[base_body];
  if (first >= 0 && model.jnt_type[first] == mjJNT_FREE) return model.jnt_qposadr[first] + 2;
  return model.jnt_qposadr[require(model, mjOBJ_JOINT, "rail_z")];
}

/// What is only to be seen meets nothing: contype and conaffinity 0, and no pair names it.
bool meets_anything(const mjModel& model, int geom) {
  if (model.geom_contype[geom] != 0 || model.geom_conaffinity[geom] != 0) return true;
  for (int pair = 0; pair < model.npair; ++pair) {
    if (model.pair_geom1[pair] == geom || model.pair_geom2[pair] == geom) return true;
  }
  return false;
}

PlantIndex find_parts(const mjModel& model, const RobotConfig& robot) {
  PlantIndex index;
  index.base_body = require(model, mjOBJ_BODY, "base");
  index.floor_geom = require(model, mjOBJ_GEOM, "floor");
  index.height_qpos = height_qpos(model, index.base_body);
  const int base_joint = model.body_jntadr[index.base_body];
  if (base_joint >= 0 && model.jnt_type[base_joint] == mjJNT_FREE) {
    index.free_qpos = model.jnt_qposadr[base_joint];
    index.free_dof = model.jnt_dofadr[base_joint];
  }
  for (const JointConfig& joint : robot.joints) {
    const int id = require(model, mjOBJ_JOINT, joint.name);
    index.joint_qpos.push_back(model.jnt_qposadr[id]);
    index.joint_dof.push_back(model.jnt_dofadr[id]);
  }
  for (const LegConfig& leg : robot.legs) {
    index.foot_geom.push_back(require(model, mjOBJ_GEOM, leg.name + "_foot"));
    const int own = mj_name2id(&model, mjOBJ_GEOM, (leg.name + "_floor").c_str());
    index.leg_floor_geom.push_back(own >= 0 ? own : index.floor_geom);
  }
  for (int geom = 0; geom < model.ngeom; ++geom) {
    const bool moves = model.body_weldid[model.geom_bodyid[geom]] != 0;
    if (!moves || !meets_anything(model, geom)) continue;
    const bool is_sphere = model.geom_type[geom] == mjGEOM_SPHERE;
    if (is_sphere) index.ground_geom.push_back(geom);
    index.others_meet_floor = index.others_meet_floor || !is_sphere;
  }
  return index;
}

/// Flags of frames that are the same go, else MuJoCo ignores the places (facts physics 9).
void shift_mass(mjModel& model, int body, const Vec3& shift_m) {
  if (shift_m == Vec3{}) return;
  mju_addTo3(row(model.body_ipos, body, 3), shift_m.data());
  model.body_sameframe[body] = model.body_simple[body] = 0;
  for (int i = 0; i < model.body_dofnum[body]; ++i) model.dof_simplenum[model.body_dofadr[body] + i] = 0;
  for (int i = 0; i < model.body_geomnum[body]; ++i) model.geom_sameframe[model.body_geomadr[body] + i] = 0;
}

void lengthen(mjModel& model, int body, double factor) {
  if (factor == 1.0) return;
  for (int child = body + 1; child < model.nbody; ++child) {
    if (model.body_parentid[child] == body)
      mju_scl3(row(model.body_pos, child, 3), row(model.body_pos, child, 3), factor);
  }
  for (int i = 0; i < model.body_geomnum[body]; ++i) {
    const int geom = model.body_geomadr[body] + i;
    if (model.geom_type[geom] != mjGEOM_SPHERE) continue;
    mju_scl3(row(model.geom_pos, geom, 3), row(model.geom_pos, geom, 3), factor);
    model.geom_sameframe[geom] = 0;
  }
}

void write_bodies(mjModel& model, const PlantConfig& config) {
  for (const PlantBodyConfig& body : config.bodies) {
    const int id = require(model, mjOBJ_BODY, body.name);
    const double scale = body.mass_kg / model.body_mass[id];
    model.body_mass[id] = body.mass_kg;
    for (int axis = 0; axis < 3; ++axis) row(model.body_inertia, id, 3)[axis] *= scale;
    shift_mass(model, id, body.shift_m);
    lengthen(model, id, body.length_factor);
  }
}

void size_feet(mjModel& model, const PlantIndex& index, double factor) {
  if (factor == 1.0) return;
  for (const int foot : index.foot_geom) {
    row(model.geom_size, foot, 3)[0] *= factor;
    model.geom_rbound[foot] *= factor;
  }
}

void load_weights(mjModel& model, const PlantIndex& index, const PlantConfig& config) {
  if (config.payload.mass_kg > 0.0)
    add_point_mass(model, index.base_body, config.payload.place_m.data(), config.payload.mass_kg);
  if (config.foot_weight_kg <= 0.0) return;
  for (const int foot : index.foot_geom)
    add_point_mass(model, model.geom_bodyid[foot], row(model.geom_pos, foot, 3), config.foot_weight_kg);
}

void write_joints(mjModel& model, const PlantIndex& index, const PlantConfig& config) {
  for (std::size_t i = 0; i < config.joints.size(); ++i) {
    const PlantJointConfig& joint = config.joints[i];
    const int dof = index.joint_dof[i];
    const int id = model.dof_jntid[dof];
    const bool rotor_apart = config.torsion && joint.torsion;  // with its friction: elastic_gear.h
    model.dof_armature[dof] = rotor_apart ? 0.0 : joint.armature_kg_m2;
    model.dof_damping[dof] = rotor_apart ? 0.0 : joint.friction.viscous_Nm_s_rad;
    model.dof_frictionloss[dof] = rotor_apart ? 0.0 : joint.friction.breakaway_Nm;
    row(model.dof_solref, dof, mjNREF)[0] = -1.0;
    row(model.dof_solref, dof, mjNREF)[1] = -1.0 / config.step_s;
    row(model.dof_solimp, dof, mjNIMP)[0] = row(model.dof_solimp, dof, mjNIMP)[1] = kStickImpedance;
    model.jnt_limited[id] = 1;
    row(model.jnt_range, id, 2)[0] = joint.stop_min_rad;
    row(model.jnt_range, id, 2)[1] = joint.stop_max_rad;
    row(model.jnt_solref, id, mjNREF)[0] = kStopTime_s;
    row(model.jnt_solref, id, mjNREF)[1] = 1.0;
  }
}

void write_rail(mjModel& model, const PlantConfig& config) {
  if (!config.rail_x_locked) return;
  const int id = require(model, mjOBJ_JOINT, "rail_x");
  model.dof_armature[model.jnt_dofadr[id]] = kLockedMass;
}

/// Planes are where the plant puts them.
void free_floors(mjModel& model, const PlantIndex& index) {
  model.geom_sameframe[index.floor_geom] = 0;  // else geom_pos is ignored: facts physics 9
  for (const int floor : index.leg_floor_geom) model.geom_sameframe[floor] = 0;
}

/// What makes contact with a body a spring and damper: facts physics 3.
struct ContactSpring {
  double stiffness = 0.0;  ///< solref[0] and [1], negative: in MuJoCo's direct form
  double damping = 0.0;
};

/// Needs the final masses' body_invweight0.
ContactSpring contact_spring(const mjModel& model, int geom, const ContactConfig& contact) {
  const double inverse_mass = row(model.body_invweight0, model.geom_bodyid[geom], 2)[0];
  const double scale = (1.0 - kContactImpedance) * inverse_mass;
  const double fastest = kFastestContact * kContactImpedance / model.opt.timestep;
  return {-contact.stiffness_N_m * scale, -std::min(contact.damping_N_s_m * scale, fastest)};
}

void write_spring(const ContactSpring& spring, mjtNum* solref, mjtNum* solimp) {
  solref[0] = spring.stiffness;
  solref[1] = spring.damping;
  solimp[0] = solimp[1] = kContactImpedance;
}

/// The spheres' values alone count (priority), whatever the floor has.
void write_contact(mjModel& model, const PlantIndex& index, const ContactConfig& contact) {
  for (const int geom : index.ground_geom) {
    model.geom_priority[geom] = 1;
    row(model.geom_friction, geom, 3)[0] = contact.friction;
    write_spring(contact_spring(model, geom, contact), row(model.geom_solref, geom, mjNREF),
                 row(model.geom_solimp, geom, mjNIMP));
  }
}

/// Pairs that model.xml lists have values of their own.
void write_pairs(mjModel& model, const ContactConfig& contact) {
  for (int pair = 0; pair < model.npair; ++pair) {
    const int first = model.pair_geom1[pair];
    const int sphere = model.geom_type[first] == mjGEOM_SPHERE ? first : model.pair_geom2[pair];
    mjtNum* friction = row(model.pair_friction, pair, 5);
    friction[0] = friction[1] = contact.friction;
    write_spring(contact_spring(model, sphere, contact), row(model.pair_solref, pair, mjNREF),
                 row(model.pair_solimp, pair, mjNIMP));
  }
}

}  // namespace

/// One at a time: MuJoCo keeps the last XML of the process.
ModelPtr load_model_xml(const std::string& path) {
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  std::array<char, 1000> error{};
  ModelPtr model(mj_loadXML(path.c_str(), nullptr, error.data(), static_cast<int>(error.size())));
  if (!model) refuse_xml(path, error.data());
  return model;
}

PlantModel load_plant_model(const RobotConfig& robot, const PlantConfig& config) {
  use_foot_contact();
  PlantModel plant;
  plant.model = load_model_xml(robot.folder + "/model.xml");
  mjModel& model = *plant.model;
  plant.index = find_parts(model, robot);
  model.opt.timestep = config.step_s;
  write_bodies(model, config);
  size_feet(model, plant.index, config.foot_radius_factor);
  load_weights(model, plant.index, config);
  write_joints(model, plant.index, config);
  plant.index.linkages = link_rotors(model, plant.index.joint_dof, robot, config);
  write_rail(model, config);
  free_floors(model, plant.index);
  const DataPtr scratch(mj_makeData(&model));
  mj_setConst(&model, scratch.get());
  write_contact(model, plant.index, config.contact);
  write_pairs(model, config.contact);
  return plant;
}

}  // namespace sprung::sim
