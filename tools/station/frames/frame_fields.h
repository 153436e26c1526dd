#pragma once
/// The numbers of which a frame consists, what a page shows of one cycle: their names, units and words, and
/// where each stands in the messages. Pure.
#include <string>
#include <utility>
#include <vector>

#include "robots/robot_config.h"

namespace sprung::station {

/// One number of a frame. Names are those of the messages, with names for indices and x, y, z (w) behind a
/// vector: "joints.knee.gear_output_torque_Nm", "legs.fl.foot_force_N.z", "safety.level".
struct FrameField {
  std::string name;
  std::string unit;                                ///< "" = none
  std::vector<std::pair<int, std::string>> words;  ///< of an enumeration's values
  std::string channel;                             ///< "" = computed from others (trunk, ghost)
  std::string path;                                ///< in that channel's messages, "joints[1].status"
};

/// All fields of a robot's frames, in their order; those of channels come first, then, in this order:
/// trunk.x_m, .y_m, .z_m, .qw, .qx, .qy, .qz, trunk.source (trunk_pose.h), and
/// joints.NAME.desired_position_rad of each joint, the ghost.
std::vector<FrameField> frame_fields(const RobotConfig& robot);

/// Index of the field of that name, -1 = none.
int find_field(const std::vector<FrameField>& fields, const std::string& name);

}  // namespace sprung::station
