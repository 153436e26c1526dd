#pragma once
/// The robot as a page draws it: model.xml's bodies, joints and shapes, and robot.yaml's limits. Start-up
/// only: reads files.
#include <nlohmann/json_fwd.hpp>
#include <string>

#include "robots/robot_config.h"

namespace sprung::station {

/// ```
/// {"robot": "single_leg", "base_fixed": false,
///  "bodies": [{"name": "base", "parent": -1, "position_m": [x, y, z], "quaternion_wxyz": [w, x, y, z],
///              "joint": {"name": "hip", "type": "hinge", "axis": [0, 1, 0], "position_m": [0, 0, 0],
///                        "zero": 0},
///              "shapes": [{"kind": "capsule", "size_m": [r, half length, 0], "position_m": [...],
///                          "quaternion_wxyz": [...], "rgba": [...], "foot": "leg"}]}],
///  "world_shapes": [as above, of the world itself; the floor is none of them],
///  "meshes": [{"vertices_m": [x, y, z, ...], "triangles": [a, b, c, ...]}],
///  "base": index of the body that trunk.* places,
///  "joints": [{"name", "body", "min_rad", "max_rad", "torque_limit_Nm"}], as robot.yaml has them,
///  "legs": [{"name", "joints": [index, ...], "foot_body": index, "foot_in_body_m": [...],
///            "foot_radius_m", "hip_in_base_m": [...]}],
///  "ground": of a simulated run, by who asks for the scene: ground_scene.h,
///  "friction_coefficient": 0.6, "friction_source": "robot.yaml, floor_friction of preset best"}
/// ```
/// Positions and turns of a body are in its parent's axes, at joint angle `zero`; of a shape in its body's.
/// `kind` is one of sphere, capsule, cylinder, box, ellipsoid, mesh (with "mesh": index); sizes are MuJoCo's
/// half sizes; capsules and cylinders lie along z. torque_limit_Nm is the smallest that the leg's
/// transmission leaves of its actuators'. friction_coefficient is null where neither file has one.
/// @param robot its `folder` has model.xml and, for the friction of a robot that does not walk, sim.yaml.
/// @param preset as the run's; "" = the usual one.
/// @throws ConfigError where model.xml cannot be read, or has not the names that the robot needs.
nlohmann::json make_scene(const RobotConfig& robot, const std::string& preset = "");

}  // namespace sprung::station
