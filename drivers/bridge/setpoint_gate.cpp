#include "drivers/bridge/setpoint_gate.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

// All [design choice]: a little wider than what the leg controller does by itself.
constexpr double kPowerShare = 1.1;
constexpr double kFullTorque_s = 0.0038;
constexpr double kSetPointSpeedShare = 2.0;
/// Where position control begins: so much of its torque limit may the drive's loop give at once.
constexpr double kFirstShare = 0.25;
/// A joint that needs more than this share of its torque to stop before its limit is braked.
constexpr double kBrakeShare = 0.6;
constexpr double kLeastRoom_rad = 0.001;

bool is_torque(const ActuatorCommand& command) noexcept { return command.mode == DriveMode::kTorque; }
bool is_position(const ActuatorCommand& command) noexcept { return command.mode == DriveMode::kPosition; }
/// Beyond a limit no torque further out; in good time before it the torque that its own inertia takes to stop
/// there, v^2 I / (2 room), where that is much.
double held_torque_Nm(const JointConfig& joint, double position_rad, double velocity_rad_s, double torque_Nm,
                      double bound_Nm) noexcept {
  const double above_rad = position_rad - joint.position_max_rad;
  const double below_rad = joint.position_min_rad - position_rad;
  const double room_rad = std::max(velocity_rad_s > 0.0 ? -above_rad : -below_rad, kLeastRoom_rad);
  const double energy_J = 0.5 * joint.armature_kg_m2 * velocity_rad_s * velocity_rad_s;
  if (energy_J > kBrakeShare * bound_Nm * room_rad) {
    const double brake_Nm = std::min(energy_J / room_rad, bound_Nm);
    return velocity_rad_s > 0.0 ? std::min(torque_Nm, -brake_Nm) : std::max(torque_Nm, brake_Nm);
  }
  if (above_rad > 0.0) return std::min(torque_Nm, 0.0);
  return below_rad > 0.0 ? std::max(torque_Nm, 0.0) : torque_Nm;
}
/// As Transmission's, but for legs whose actuators are their joints: this is run every cycle.
JointVector joints_of(const Transmission& transmission, const JointVector& actuators) noexcept {
  return transmission.direct() ? actuators : transmission.joint_from_actuator(actuators);
}
/// More than rounding on the way through a transmission.
bool differ(double a, double b) noexcept { return std::abs(a - b) > 1e-9; }

}  // namespace

SetpointGate::SetpointGate(const RobotConfig& robot) : cycle_s_(robot.cycle_s) {
  for (const ActuatorConfig& actuator : robot.actuators)
    drives_.push_back({actuator, actuator.torque_limit_Nm * cycle_s_ / kFullTorque_s, kNaN, kNaN, {}});
  for (const LegConfig& leg : robot.legs) {
    std::vector<JointConfig> joints;
    for (const int joint : leg.joints) joints.push_back(robot.joints.at(joint));
    const Transmission transmission(leg);
    JointVector limits_Nm(transmission.size());
    for (int i = 0; i < transmission.size(); ++i)
      limits_Nm[i] = robot.actuators.at(leg.actuators[i]).torque_limit_Nm;
    legs_.push_back({transmission, leg.actuators, joints, transmission.joint_torque_bound(limits_Nm)});
  }
}

void SetpointGate::show(std::size_t actuator, NodeHealth& out) const noexcept {
  const GateCounts& counts = drives_[actuator].counts;
  out.limited_joint_position = counts[index(GateLimit::kJointPosition)];
  out.limited_speed = counts[index(GateLimit::kSpeed)];
  out.limited_rate = counts[index(GateLimit::kRate)];
  out.limited_power = counts[index(GateLimit::kPower)];
  out.limited_winding = counts[index(GateLimit::kWinding)];
}

void SetpointGate::forget() noexcept {
  for (Drive& drive : drives_) drive.set_torque_Nm = drive.set_position_rad = kNaN;
}

void SetpointGate::limit(const Motions& motion, Commands& commands) noexcept {
  for (const Leg& leg : legs_) within_joint_limits(leg, motion, commands);
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    Drive& drive = drives_[i];
    ActuatorCommand& command = commands[i];
    const bool acts = motion[i].enabled;
    if (acts && is_torque(command))
      command.commanded_torque_Nm = torque_of(drive, motion[i], command.commanded_torque_Nm);
    if (acts && is_position(command))
      command.commanded_position_rad = position_of(drive, motion[i], command.commanded_position_rad);
    drive.set_torque_Nm = acts && is_torque(command) ? command.commanded_torque_Nm : kNaN;
    drive.set_position_rad = acts && is_position(command) ? command.commanded_position_rad : kNaN;
  }
}

/// Where an actuator of the leg is not known, neither are its joints.
void SetpointGate::within_joint_limits(const Leg& leg, const Motions& motion, Commands& commands) noexcept {
  JointVector measured_rad(leg.transmission.size());
  for (int i = 0; i < leg.transmission.size(); ++i) {
    measured_rad[i] = motion[leg.actuators[i]].measured_position_rad;
    if (!std::isfinite(measured_rad[i])) return;
  }
  hold_positions(leg, measured_rad, commands);
  hold_torques(leg, measured_rad, motion, commands);
}

void SetpointGate::hold_positions(const Leg& leg, const JointVector& measured_rad,
                                  Commands& commands) noexcept {
  const int size = leg.transmission.size();
  JointVector set_rad = measured_rad;
  bool any = false;
  for (int i = 0; i < size; ++i) {
    const ActuatorCommand& command = commands[leg.actuators[i]];
    if (!is_position(command)) continue;
    set_rad[i] = command.commanded_position_rad;
    any = true;
  }
  if (!any) return;
  JointVector joints_rad = joints_of(leg.transmission, set_rad);
  bool held = false;
  for (int j = 0; j < size; ++j) {
    const JointConfig& joint = leg.joints[j];
    const double inside_rad = std::clamp(joints_rad[j], joint.position_min_rad, joint.position_max_rad);
    held = held || inside_rad != joints_rad[j];
    joints_rad[j] = inside_rad;
  }
  if (!held) return;
  set_rad = leg.transmission.actuator_from_joint(joints_rad);
  for (int i = 0; i < size; ++i) {
    ActuatorCommand& command = commands[leg.actuators[i]];
    if (!is_position(command) || !differ(command.commanded_position_rad, set_rad[i])) continue;
    command.commanded_position_rad = set_rad[i];
    count(leg.actuators[i], GateLimit::kJointPosition);
  }
}

void SetpointGate::hold_torques(const Leg& leg, const JointVector& measured_rad, const Motions& motion,
                                Commands& commands) noexcept {
  const int size = leg.transmission.size();
  JointVector torque_Nm(size), velocity_rad_s(size);
  for (int i = 0; i < size; ++i) {
    const ActuatorCommand& command = commands[leg.actuators[i]];
    torque_Nm[i] = is_torque(command) ? command.commanded_torque_Nm : 0.0;
    velocity_rad_s[i] = motion[leg.actuators[i]].filtered_velocity_rad_s;
  }
  if (!leg.transmission.direct()) torque_Nm = leg.transmission.joint_torque(torque_Nm);
  const JointVector position_rad = joints_of(leg.transmission, measured_rad);
  velocity_rad_s = joints_of(leg.transmission, velocity_rad_s);
  bool held = false;
  for (int j = 0; j < size; ++j) {
    const double inside_Nm = held_torque_Nm(leg.joints[j], position_rad[j], velocity_rad_s[j], torque_Nm[j],
                                            leg.torque_bound_Nm[j]);
    held = held || inside_Nm != torque_Nm[j];
    torque_Nm[j] = inside_Nm;
  }
  if (!held) return;
  torque_Nm = leg.transmission.actuator_torque(torque_Nm);
  for (int i = 0; i < size; ++i) {
    ActuatorCommand& command = commands[leg.actuators[i]];
    if (!is_torque(command) || !differ(command.commanded_torque_Nm, torque_Nm[i])) continue;
    command.commanded_torque_Nm = torque_Nm[i];
    count(leg.actuators[i], GateLimit::kJointPosition);
  }
}

double SetpointGate::torque_of(Drive& drive, const GateMotion& motion, double torque_Nm) noexcept {
  const ActuatorConfig& a = drive.config;
  const double velocity_rad_s = motion.filtered_velocity_rad_s;
  const bool faster = torque_Nm * velocity_rad_s > 0.0;
  const auto limit_to = [&](double low_Nm, double high_Nm, GateLimit limit) {
    const double inside_Nm = std::clamp(torque_Nm, low_Nm, high_Nm);
    if (inside_Nm != torque_Nm) ++drive.counts[index(limit)];
    torque_Nm = inside_Nm;
  };
  if (faster && a.speed_limit_rad_s > 0.0 && std::abs(velocity_rad_s) > kSpeedShare * a.speed_limit_rad_s)
    limit_to(0.0, 0.0, GateLimit::kSpeed);
  const double before_Nm = std::isfinite(drive.set_torque_Nm) ? drive.set_torque_Nm
                                                              : motion.measured_torque_Nm;
  if (std::isfinite(before_Nm)) {
    limit_to(std::min(before_Nm, 0.0) - drive.most_step_Nm, std::max(before_Nm, 0.0) + drive.most_step_Nm,
             GateLimit::kRate);
  }
  const bool too_strong = std::abs(torque_Nm * velocity_rad_s) > kPowerShare * a.power_limit_W;
  if (faster && a.power_limit_W > 0.0 && too_strong) {
    const double most_Nm = kPowerShare * a.power_limit_W / std::abs(velocity_rad_s);
    limit_to(-most_Nm, most_Nm, GateLimit::kPower);
  }
  if (motion.warm) {
    const double rated_Nm = a.rated_current_A * a.torque_constant_Nm_A * a.gear_ratio;
    limit_to(-rated_Nm, rated_Nm, GateLimit::kWinding);
  }
  return torque_Nm;
}

double SetpointGate::position_of(Drive& drive, const GateMotion& motion, double position_rad) noexcept {
  const ActuatorConfig& a = drive.config;
  const bool goes_on = std::isfinite(drive.set_position_rad);
  const double before_rad = goes_on ? drive.set_position_rad : motion.measured_position_rad;
  if (!std::isfinite(before_rad) || a.speed_limit_rad_s <= 0.0) return position_rad;
  double step_rad = kSetPointSpeedShare * a.speed_limit_rad_s * cycle_s_;
  if (!goes_on && a.position_stiffness_Nm_rad > 0.0)
    step_rad += kFirstShare * a.torque_limit_Nm / a.position_stiffness_Nm_rad;
  const double inside_rad = std::clamp(position_rad, before_rad - step_rad, before_rad + step_rad);
  if (inside_rad != position_rad) ++drive.counts[index(GateLimit::kRate)];
  return inside_rad;
}

}  // namespace sprung
