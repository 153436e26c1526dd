#include "tools/station/scene/scene.h"

#include <mujoco/mujoco.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>

#include "robots/config_error.h"
#include "simulation/plant/mujoco_row.h"
#include "simulation/plant/plant_model.h"
#include "simulation/plant/sim_config.h"

namespace sprung::station {

namespace {

using Json = nlohmann::json;

constexpr int kFirstHiddenGroup = 3;  // MuJoCo's viewers show groups 0 to 2

Json numbers(const mjtNum* from, int count) { return std::vector<double>(from, from + count); }

const char* kind_of(int geom_type) {
  switch (geom_type) {
    case mjGEOM_SPHERE:
      return "sphere";
    case mjGEOM_CAPSULE:
      return "capsule";
    case mjGEOM_CYLINDER:
      return "cylinder";
    case mjGEOM_BOX:
      return "box";
    case mjGEOM_ELLIPSOID:
      return "ellipsoid";
    case mjGEOM_MESH:
      return "mesh";
    default:
      return nullptr;  // planes are the page's own ground; height fields are not drawn
  }
}

class SceneMaker {
 public:
  SceneMaker(const RobotConfig& robot, const std::string& path)
      : robot_(robot), path_(path), owner_(sim::load_model_xml(path)), model_(*owner_) {}

  Json make() const {
    Json scene{{"robot", robot_.name}, {"bodies", bodies()}, {"world_shapes", shapes_of(0)}};
    const int base = find(mjOBJ_BODY, "base");
    scene["base"] = base - 1;
    scene["base_fixed"] = model_.body_weldid[base] == 0;
    scene["meshes"] = meshes();
    scene["joints"] = Json::array();
    for (std::size_t i = 0; i < robot_.joints.size(); ++i) scene["joints"].push_back(joint_limits(i));
    scene["legs"] = Json::array();
    for (const LegConfig& leg : robot_.legs) scene["legs"].push_back(leg_of(leg));
    return scene;
  }

 private:
  int find(mjtObj type, const std::string& name) const {
    const int id = mj_name2id(&model_, type, name.c_str());
    if (id < 0) throw ConfigError(path_ + " has no " + mju_type2Str(type) + " named " + name);
    return id;
  }
  std::string name_of(mjtObj type, int id) const {
    const char* const name = mj_id2name(&model_, type, id);
    return name == nullptr ? "" : name;
  }

  Json bodies() const {
    Json out = Json::array();
    for (int body = 1; body < model_.nbody; ++body) {
      Json one{{"name", name_of(mjOBJ_BODY, body)},
               {"parent", model_.body_parentid[body] - 1},
               {"position_m", numbers(sim::row(model_.body_pos, body, 3), 3)},
               {"quaternion_wxyz", numbers(sim::row(model_.body_quat, body, 4), 4)},
               {"shapes", shapes_of(body)}};
      const int joint = hinge_of(body);
      if (joint >= 0) one["joint"] = joint_of(joint);
      out.push_back(std::move(one));
    }
    return out;
  }
  /// Only those that robot.yaml has are turned; rails are in the base's place.
  int hinge_of(int body) const {
    for (int i = 0; i < model_.body_jntnum[body]; ++i) {
      const int joint = model_.body_jntadr[body] + i;
      if (model_.jnt_type[joint] == mjJNT_HINGE) return joint;
    }
    return -1;
  }
  Json joint_of(int joint) const {
    return {{"name", name_of(mjOBJ_JOINT, joint)},
            {"type", "hinge"},
            {"axis", numbers(sim::row(model_.jnt_axis, joint, 3), 3)},
            {"position_m", numbers(sim::row(model_.jnt_pos, joint, 3), 3)},
            {"zero", model_.qpos0[model_.jnt_qposadr[joint]]}};
  }

  Json shapes_of(int body) const {
    Json out = Json::array();
    for (int i = 0; i < model_.body_geomnum[body]; ++i) {
      const int geom = model_.body_geomadr[body] + i;
      const char* const kind = kind_of(model_.geom_type[geom]);
      if (kind != nullptr && model_.geom_group[geom] < kFirstHiddenGroup) out.push_back(shape_of(geom, kind));
    }
    return out;
  }
  Json shape_of(int geom, const char* kind) const {
    const int material = model_.geom_matid[geom];
    const float* const rgba = material >= 0 ? sim::row(model_.mat_rgba, material, 4)
                                            : sim::row(model_.geom_rgba, geom, 4);
    Json shape{{"kind", kind},
               {"size_m", numbers(sim::row(model_.geom_size, geom, 3), 3)},
               {"position_m", numbers(sim::row(model_.geom_pos, geom, 3), 3)},
               {"quaternion_wxyz", numbers(sim::row(model_.geom_quat, geom, 4), 4)},
               {"rgba", std::vector<float>(rgba, rgba + 4)}};
    if (model_.geom_type[geom] == mjGEOM_MESH) shape["mesh"] = model_.geom_dataid[geom];
    for (const LegConfig& leg : robot_.legs)
      if (name_of(mjOBJ_GEOM, geom) == leg.name + "_foot") shape["foot"] = leg.name;
    return shape;
  }
  Json meshes() const {
    Json out = Json::array();
    for (int mesh = 0; mesh < model_.nmesh; ++mesh) {
      const float* const vertices = sim::row(model_.mesh_vert, model_.mesh_vertadr[mesh], 3);
      const int* const faces = sim::row(model_.mesh_face, model_.mesh_faceadr[mesh], 3);
      out.push_back(
          {{"vertices_m", std::vector<float>(vertices, sim::row(vertices, model_.mesh_vertnum[mesh], 3))},
           {"triangles", std::vector<int>(faces, sim::row(faces, model_.mesh_facenum[mesh], 3))}});
    }
    return out;
  }

  Json joint_limits(std::size_t index) const {
    const JointConfig& joint = robot_.joints[index];
    const int id = find(mjOBJ_JOINT, joint.name);
    return {{"name", joint.name},
            {"body", model_.jnt_bodyid[id] - 1},
            {"min_rad", joint.position_min_rad},
            {"max_rad", joint.position_max_rad},
            {"torque_limit_Nm", torque_limit_Nm(static_cast<int>(index))}};
  }
  /// joint = transmission * actuator, so torque_actuator = transmission^T torque_joint.
  double torque_limit_Nm(int joint) const {
    double limit_Nm = INFINITY;
    for (const LegConfig& leg : robot_.legs) {
      const auto at = std::find(leg.joints.begin(), leg.joints.end(), joint);
      if (at == leg.joints.end()) continue;
      const std::size_t row = static_cast<std::size_t>(at - leg.joints.begin());
      for (std::size_t i = 0; i < leg.actuators.size(); ++i) {
        const double share = std::abs(leg.transmission[row * leg.actuators.size() + i]);
        const double own_Nm = robot_.actuators[static_cast<std::size_t>(leg.actuators[i])].torque_limit_Nm;
        constexpr double kLeastShare = 0.1;  // a belt's small coupling is no limit
        if (share > kLeastShare) limit_Nm = std::min(limit_Nm, own_Nm / share);
      }
    }
    return limit_Nm;
  }
  Json leg_of(const LegConfig& leg) const {
    Json out{{"name", leg.name},
             {"joints", leg.joints},
             {"foot_radius_m", leg.foot_radius_m},
             {"hip_in_base_m", leg.hip_in_trunk_m}};
    const int foot = mj_name2id(&model_, mjOBJ_GEOM, (leg.name + "_foot").c_str());
    if (foot < 0) return out;
    out["foot_body"] = model_.geom_bodyid[foot] - 1;
    out["foot_in_body_m"] = numbers(sim::row(model_.geom_pos, foot, 3), 3);
    return out;
  }

  const RobotConfig& robot_;
  std::string path_;
  sim::ModelPtr owner_;
  const mjModel& model_;
};

void add_friction(const RobotConfig& robot, const std::string& preset, Json& scene) {
  scene["friction_coefficient"] = nullptr;
  scene["friction_source"] = "";
  if (!robot.gaits.empty()) {
    const PresetConfig& chosen = robot.preset(preset);
    scene["friction_coefficient"] = chosen.walk.floor_friction;
    scene["friction_source"] = "robot.yaml, floor_friction of preset " + chosen.name;
    return;
  }
  try {
    scene["friction_coefficient"] = sim::load_sim_config(robot, {}).plant.contact.friction;
    scene["friction_source"] = "sim.yaml, contact";
  } catch (const ConfigError&) {  // a robot that was never simulated has no cone
  }
}

}  // namespace

nlohmann::json make_scene(const RobotConfig& robot, const std::string& preset) {
  Json scene = SceneMaker(robot, robot.folder + "/model.xml").make();
  add_friction(robot, preset, scene);
  return scene;
}

}  // namespace sprung::station
