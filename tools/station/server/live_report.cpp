#include "tools/station/server/live_report.h"

#include <cmath>
#include <nlohmann/json.hpp>

namespace sprung::station {
namespace {

using OrderedJson = nlohmann::ordered_json;

/// Five digits are more than a page shows, and a third of the bytes.
OrderedJson short_number(double value) {
  if (!std::isfinite(value)) return nullptr;
  if (value == 0.0) return 0.0;
  const double scale = std::pow(10.0, 4.0 - std::floor(std::log10(std::abs(value))));
  return std::round(value * scale) / scale;
}

OrderedJson short_numbers(const Vec3& values) {
  return {short_number(values[0]), short_number(values[1]), short_number(values[2])};
}

/// Of the actuators that turn the joint: what they give together at their limits.
double torque_limit_Nm(const RobotConfig& robot, int joint) {
  for (std::size_t i = 0; i < robot.actuators.size(); ++i)
    if (robot.joint_of_actuator(static_cast<int>(i)) == joint) return robot.actuators[i].torque_limit_Nm;
  return kNaN;
}

}  // namespace

OrderedJson robot_json(const RobotConfig& robot) {
  OrderedJson out{{"robot", robot.name}, {"cycle_s", robot.cycle_s}};
  for (const char* key : {"joints", "legs", "actuators", "gaits"}) out[key] = OrderedJson::array();
  for (std::size_t i = 0; i < robot.joints.size(); ++i) {
    const JointConfig& joint = robot.joints[i];
    out["joints"].push_back({{"name", joint.name},
                             {"position_min_rad", joint.position_min_rad},
                             {"position_max_rad", joint.position_max_rad},
                             {"torque_limit_Nm", short_number(torque_limit_Nm(robot, static_cast<int>(i)))}});
  }
  for (const LegConfig& leg : robot.legs) out["legs"].push_back({{"name", leg.name}});
  for (const ActuatorConfig& actuator : robot.actuators)
    out["actuators"].push_back({{"name", actuator.name}, {"rated_current_A", actuator.rated_current_A}});
  for (std::size_t i = 0; i < robot.gaits.size(); ++i) {
    const GaitConfig& gait = robot.gaits[i];
    if (gait.duty >= 1.0) continue;
    out["gaits"].push_back(
        {{"index", i},
         {"name", gait.name},
         {"fastest", {gait.fastest_forward_m_s, gait.fastest_sideways_m_s, gait.fastest_turning_rad_s}}});
  }
  return out;
}

OrderedJson live_json(const JointState& joints, const DriveState& drives) {
  OrderedJson out{
      {"joints", OrderedJson::array()}, {"legs", OrderedJson::array()}, {"actuators", OrderedJson::array()}};
  for (const EstimatedJoint& joint : joints.joints)
    out["joints"].push_back({{"status", name(joint.status)},
                             {"position_rad", short_number(joint.estimated_position_rad)},
                             {"torque_Nm", short_number(joint.gear_output_torque_Nm)},
                             {"torque_bound_Nm", short_number(joint.gear_output_torque_bound_Nm)},
                             {"external_Nm", short_number(joint.external_torque_Nm)},
                             {"temperature_degC", short_number(joint.estimated_temperature_degC)},
                             {"enabled", joint.drive_enabled}});
  for (const EstimatedLeg& leg : joints.legs)
    out["legs"].push_back({{"force_N", short_numbers(leg.foot_force_N)},
                           {"force_bound_N", short_numbers(leg.foot_force_bound_N)},
                           {"contact", leg.contact},
                           {"confidence", short_number(leg.contact_confidence)}});
  for (const ActuatorState& drive : drives.actuators)
    out["actuators"].push_back({{"power", name(drive.power_state)},
                                {"current_A", short_number(drive.measured_current_A)},
                                {"supply_V", short_number(drive.measured_supply_V)},
                                {"fault_code", drive.fault_code}});
  return out;
}

}  // namespace sprung::station
