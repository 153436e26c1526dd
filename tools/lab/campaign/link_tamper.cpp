#include "tools/lab/campaign/link_tamper.h"

#include <array>
#include <limits>

#include "drivers/canopen/protocol.h"
#include "drivers/profiles/drive_profile.h"
#include "tools/lab/campaign/wire_flip.h"

namespace sprung::campaign {
namespace {

constexpr double kHuge = 1e9;

/// In [0, 1), the same on every machine.
double share(std::mt19937_64& random) noexcept { return static_cast<double>(random() >> 11) * 0x1p-53; }

void spoil(double& number, FieldFault fault) noexcept {
  switch (fault) {
    case FieldFault::kNaN:
      number = kNaN;
      break;
    case FieldFault::kInfinite:
      number = std::numeric_limits<double>::infinity();
      break;
    case FieldFault::kHuge:
      number = kHuge;
      break;
    case FieldFault::kSign:
      number = -number;
      break;
  }
}

template <class Parts>
auto& part_of(Parts& parts, int target) noexcept {
  return parts[static_cast<std::size_t>(target) % parts.size()];
}

// The numbers that the receivers of each message compute with.
std::array<double*, 3> fields(DriveState& message, int target) noexcept {
  ActuatorState& one = part_of(message.actuators, target);
  return {&one.measured_position_rad, &one.measured_current_A, &one.measured_link_position_rad};
}
std::array<double*, 5> fields(JointState& message, int target) noexcept {
  EstimatedJoint& one = part_of(message.joints, target);
  return {&one.estimated_position_rad, &one.estimated_velocity_rad_s, &one.measured_motor_torque_Nm,
          &one.gear_output_torque_Nm, &message.body.estimated_height_m};
}
std::array<double*, 5> fields(LegCommand& message, int target) noexcept {
  DesiredLeg& one = part_of(message.legs, target);
  return {&one.desired_foot_in_hip_m[2], &one.desired_foot_velocity_m_s[2], &one.stiffness_N_m[2],
          &one.damping_N_s_m[2], &one.feedforward_force_N[2]};
}
std::array<double*, 3> fields(DriveCommand& message, int target) noexcept {
  ActuatorCommand& one = part_of(message.actuators, target);
  return {&one.commanded_torque_Nm, &one.commanded_position_rad, &one.commanded_damping_Nm_s_rad};
}
std::array<double*, 3> fields(Imu& message, int) noexcept {
  return {&message.measured_angular_velocity_rad_s[1], &message.measured_specific_force_m_s2[2],
          &message.measured_quaternion_wxyz[0]};
}

}  // namespace

int fields_of(Link link) noexcept { return link == Link::kJointState || link == Link::kLegCommand ? 5 : 3; }

LinkTamper::LinkTamper(const RobotConfig& robot, std::uint64_t seed) : robot_(robot), random_(seed) {}

bool LinkTamper::pass(DriveState& message) noexcept {
  return pass_by(Link::kDriveState, message, drive_states_);
}
bool LinkTamper::pass(JointState& message) noexcept {
  return pass_by(Link::kJointState, message, joint_states_);
}
bool LinkTamper::pass(LegCommand& message) noexcept {
  return pass_by(Link::kLegCommand, message, leg_commands_);
}
bool LinkTamper::pass(DriveCommand& message) noexcept {
  return pass_by(Link::kDriveCommand, message, drive_commands_);
}
bool LinkTamper::pass(Imu& message) noexcept { return pass_by(Link::kImu, message, imus_); }

template <class Signal>
bool LinkTamper::pass_by(Link link, Signal& message, History<Signal>& history) noexcept {
  history.ring[static_cast<std::size_t>(history.count++) % kHistory] = message;
  bool arrives = true;
  for (const Injection& injection : injections_) {
    if (injection.link != link || !injection.active(seq_, robot_.cycle_s)) continue;
    if (injection.kind == Class::kField) {
      const auto all = fields(message, injection.target);
      spoil(*all[static_cast<std::size_t>(injection.field) % all.size()], injection.field_fault);
    } else if (injection.kind == Class::kMessage) {
      arrives = disturb(injection, message, history) && arrives;
    }
  }
  return arrives;
}

/// What was sent so many cycles ago. @return false: there was nothing.
template <class Signal>
bool LinkTamper::take_back(std::int64_t cycles, Signal& message, const History<Signal>& history) noexcept {
  const std::int64_t wanted = history.count - 1 - cycles;
  if (wanted < 0) return false;
  message = history.ring[static_cast<std::size_t>(wanted) % kHistory];
  return true;
}

template <class Signal>
bool LinkTamper::disturb(const Injection& injection, Signal& message, History<Signal>& history) noexcept {
  const auto cycles = static_cast<std::int64_t>(injection.value);
  switch (injection.link_fault) {
    case LinkFault::kLost:
      return share(random_) >= injection.value;
    case LinkFault::kLate:
      return take_back(cycles, message, history);
    case LinkFault::kDisorder:  // 4, 3, 6, 5, 8, ...
      return (seq_ - injection.at_seq) % 2 == 0 || take_back(2, message, history);
    case LinkFault::kFlipped:
      return share(random_) >= injection.value || arrives_flipped(message, random_());
    case LinkFault::kRepeated:
      if (history.repeats_since != injection.at_seq) {
        history.first = message;
        history.repeats_since = injection.at_seq;
      }
      message = history.first;
      return true;
    case LinkFault::kFuture:
      message.stamp.seq += cycles;
      return true;
  }
  return true;
}

void LinkTamper::add_foreign(FrameBatch& frames) noexcept {
  for (const Injection& injection : injections_)
    if (injection.kind == Class::kForeign && injection.active(seq_, robot_.cycle_s))
      add_foreign(injection, frames);
}

void LinkTamper::add_foreign(const Injection& injection, FrameBatch& frames) noexcept {
  const ActuatorConfig& victim = part_of(robot_.actuators, injection.target);
  const auto nmt = [&](canopen::NmtCommand command) { return canopen::nmt_frame(command, victim.node); };
  switch (injection.foreign) {
    case Foreign::kPreOperational:
      frames.push(victim.bus, nmt(canopen::NmtCommand::kEnterPreOperational));
      return;
    case Foreign::kReset:
      frames.push(victim.bus, nmt(canopen::NmtCommand::kResetNode));
      return;
    case Foreign::kStopNode:
      frames.push(victim.bus, nmt(canopen::NmtCommand::kStop));
      return;
    case Foreign::kHeartbeat:
      frames.push(victim.bus,
                  canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational));
      return;
    case Foreign::kSync:
      frames.push(victim.bus, canopen::sync_frame());
      return;
    case Foreign::kSetpoint:
      DriveSetpoint setpoint;
      setpoint.commanded_torque_Nm = injection.value * victim.torque_limit_Nm;
      frames.push(victim.bus, make_profile(victim, {robot_.cycle_s, robot_.watchdogs.heartbeat_s,
                                                    robot_.watchdogs.heartbeat_consumer_s})
                                  ->encode_setpoint(setpoint));
      return;
  }
}

}  // namespace sprung::campaign
