#include "tools/station/frames/frame_fields.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "lcmtypes/channels.h"
#include "tools/logs/fields/type_table.h"
#include "tools/logs/fields/units.h"

namespace sprung::station {

namespace {

constexpr const char* kVector = "xyz";
constexpr const char* kQuaternion = "wxyz";

/// Values of an enumeration in words; fields know one value's word alone.
std::vector<std::pair<int, std::string>> words_of(const fields::Enumeration* enumeration) {
  std::vector<std::pair<int, std::string>> words;
  if (enumeration == nullptr) return words;
  for (int value = INT8_MIN; value <= INT8_MAX; ++value) {
    const char* const text = enumeration->text(static_cast<std::int8_t>(value));
    if (std::strcmp(text, "unknown") != 0) words.emplace_back(value, text);
  }
  return words;
}

/// Adds fields of one channel's messages.
class ChannelFields {
 public:
  /// @param type "joint_state_t"
  ChannelFields(std::vector<FrameField>& out, const char* channel, const char* type)
      : out_(out), channel_(channel), type_(fields::TypeTable::sprung().by_name(type)) {}

  /// Members of every element of a list: joints[i].x as joints.NAME.x.
  template <class Items>
  void add_list(const std::string& list, const Items& items, const std::vector<const char*>& members) {
    const fields::StructType* const element = member_of(*type_, list)->type;
    for (std::size_t i = 0; i < items.size(); ++i) {
      for (const char* member : members)
        add(*element, member, list + "." + items[i].name + ".", list + "[" + std::to_string(i) + "].");
    }
  }
  /// An element of a list of numbers, for one item: x[index] as LIST.NAME.x.
  void add_element(const std::string& list, const std::string& name, const std::string& member,
                   std::size_t index) {
    out_.push_back({list + "." + name + "." + member,
                    fields::unit_of(member),
                    {},
                    channel_,
                    member + "[" + std::to_string(index) + "]"});
  }
  /// Members of the message itself, or of one of its structs. @param prefix of the names, "motion."
  /// @param inside "body" or ""
  void add_members(const std::string& prefix, const std::string& inside,
                   const std::vector<const char*>& members) {
    const fields::StructType& type = inside.empty() ? *type_ : *member_of(*type_, inside)->type;
    for (const char* member : members) add(type, member, prefix, inside.empty() ? "" : inside + ".");
  }

 private:
  static const fields::Member* member_of(const fields::StructType& type, const std::string& name) {
    return &*std::find_if(type.members.begin(), type.members.end(),
                          [&](const fields::Member& member) { return member.name == name; });
  }
  void add(const fields::StructType& type, const std::string& name, const std::string& prefix,
           const std::string& path) {
    const fields::Member& member = *member_of(type, name);
    const FrameField field{prefix + name, fields::unit_of(name), words_of(member.enumeration), channel_,
                           path + name};
    if (member.dimensions.empty()) return out_.push_back(field);
    const std::int64_t size = member.dimensions.front().fixed;
    const char* const axes = size == 4 ? kQuaternion : kVector;
    for (std::int64_t i = 0; i < size; ++i) {
      out_.push_back(field);
      out_.back().name += std::string(".") + axes[i];
      out_.back().path += "[" + std::to_string(i) + "]";
    }
  }

  std::vector<FrameField>& out_;
  std::string channel_;
  const fields::StructType* type_;
};

/// Of what robot.yaml says that it can be read.
void add_auxiliary(const RobotConfig& robot, std::vector<FrameField>& out) {
  ChannelFields auxiliary(out, channels::kAuxiliaryState, "auxiliary_state_t");
  for (std::size_t i = 0; i < robot.actuators.size(); ++i) {
    const ActuatorConfig& actuator = robot.actuators[i];
    if (actuator.temperature.reading.index != 0)
      auxiliary.add_element("actuators", actuator.name, "measured_temperature_degC", i);
  }
  if (robot.battery.bus < 0) return;
  auxiliary.add_members("auxiliary.", "",
                        {"battery_voltage_V", "battery_charge_share", "battery_temperature_degC"});
}

void add_messages(const RobotConfig& robot, std::vector<FrameField>& out) {
  ChannelFields state(out, channels::kJointState, "joint_state_t");
  state.add_list(
      "joints", robot.joints,
      {"estimated_position_rad", "estimated_velocity_rad_s", "measured_motor_torque_Nm",
       "motor_side_torque_Nm", "gear_output_torque_Nm", "gear_output_torque_bound_Nm", "friction_torque_Nm",
       "external_torque_Nm", "external_torque_bound_Nm", "estimated_temperature_degC", "status"});
  state.add_list(
      "legs", robot.legs,
      {"estimated_foot_in_hip_m", "foot_force_N", "foot_force_bound_N", "contact_confidence", "contact"});
  state.add_members("body.", "body",
                    {"estimated_quaternion_wxyz", "estimated_angular_velocity_rad_s",
                     "estimated_velocity_m_s", "estimated_height_m"});
  ChannelFields(out, channels::kLegCommand, "leg_command_t")
      .add_list("legs", robot.legs,
                {"desired_foot_in_hip_m", "feedforward_force_N", "desired_joint_position_rad", "phase",
                 "control_mode"});
  ChannelFields(out, channels::kDriveState, "drive_state_t")
      .add_list("actuators", robot.actuators, {"measured_current_A", "measured_supply_V"});
  ChannelFields(out, channels::kDriveCommand, "drive_command_t")
      .add_list("actuators", robot.actuators, {"commanded_torque_Nm", "mode"});
  ChannelFields(out, channels::kMotionState, "motion_state_t")
      .add_members("motion.", "",
                   {"state", "jumps_done", "estimated_jump_height_m", "gait_phase", "desired_speed"});
  ChannelFields(out, channels::kSafetyState, "safety_state_t").add_members("safety.", "", {"level", "cause"});
  ChannelFields(out, channels::kBodyState, "body_state_t")
      .add_members("odometry.", "", {"estimated_position_in_world_m", "estimated_quaternion_wxyz", "slips"});
  ChannelFields(out, channels::kImu, "imu_t")
      .add_members("imu.", "", {"measured_angular_velocity_rad_s", "measured_specific_force_m_s2"});
  add_auxiliary(robot, out);
  ChannelFields truth(out, channels::kSimTruth, "sim_truth_t");
  truth.add_list("joints", robot.joints, {"true_gear_output_torque_Nm"});
  truth.add_list("legs", robot.legs, {"true_contact_force_N", "true_ground_height_m"});
  truth.add_members("truth.", "", {"base_in_world_m", "base_quaternion_wxyz"});
}

}  // namespace

std::vector<FrameField> frame_fields(const RobotConfig& robot) {
  std::vector<FrameField> fields;
  add_messages(robot, fields);
  for (const char* name : {"x_m", "y_m", "z_m"})
    fields.push_back({std::string("trunk.") + name, "m", {}, "", ""});
  for (const char* name : {"qw", "qx", "qy", "qz"})
    fields.push_back({std::string("trunk.") + name, "", {}, "", ""});
  fields.push_back(
      {"trunk.source", "", {{0, "legs"}, {1, "estimate"}, {2, "simulation"}, {3, "odometry"}}, "", ""});
  for (const JointConfig& joint : robot.joints)
    fields.push_back({"joints." + joint.name + ".desired_position_rad", "rad", {}, "", ""});
  return fields;
}

int find_field(const std::vector<FrameField>& fields, const std::string& name) {
  const auto found = std::find_if(fields.begin(), fields.end(),
                                  [&](const FrameField& field) { return field.name == name; });
  return found == fields.end() ? -1 : static_cast<int>(found - fields.begin());
}

}  // namespace sprung::station
