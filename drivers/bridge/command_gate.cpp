#include "drivers/bridge/command_gate.h"

#include <algorithm>
#include <cmath>

namespace sprung {
namespace {

constexpr double kTorqueTolerance = 1.001;
constexpr double kDampingFactor = 10.0;
constexpr double kPositionReach_rad = 20.0;
constexpr std::int64_t kLongestValidity_us = 1'000'000;  // [design choice] far above any command_hold

bool is_known(DriveMode mode) noexcept {
  return mode >= DriveMode::kDisabled && mode <= DriveMode::kPosition;
}

}  // namespace

CommandGate::CommandGate(const RobotConfig& robot)
    : actuators_(robot.actuators), last_(robot.actuators.size()) {}

bool CommandGate::accept(const DriveCommand& command, std::int64_t cycle, std::int64_t time_us,
                         const DriveState& state) noexcept {
  last_was_refused_ = !judge(command, cycle, time_us, state);
  if (last_was_refused_) {
    ++refused_;
    return false;
  }
  std::copy(command.actuators.begin(), command.actuators.end(), last_.actuators.begin());
  last_.stamp = command.stamp;
  last_.valid_until_utime_us = command.valid_until_utime_us;
  last_.used_leg_command_seq = command.used_leg_command_seq;
  any_ = true;
  armed_ = armed_ || std::all_of(command.actuators.begin(), command.actuators.end(),
                                 [](const ActuatorCommand& a) { return a.mode == DriveMode::kDisabled; });
  return true;
}

bool CommandGate::judge(const DriveCommand& command, std::int64_t cycle, std::int64_t time_us,
                        const DriveState& state) noexcept {
  const std::int64_t seq = command.stamp.seq;
  if (command.actuators.size() != actuators_.size()) {
    print(detail_, "command for %zu actuators, expected %zu", command.actuators.size(), actuators_.size());
    return false;
  }
  if (seq > cycle || seq < 0 || (any_ && seq <= last_.stamp.seq)) {
    print(detail_, "command of cycle %lld in cycle %lld, the last good one was of %lld",
          static_cast<long long>(seq), static_cast<long long>(cycle),
          static_cast<long long>(any_ ? last_.stamp.seq : -1));
    return false;
  }
  const std::int64_t valid_until_us = std::max<std::int64_t>(command.valid_until_utime_us, 0);
  if (valid_until_us < time_us) {
    print(detail_, "command of cycle %lld came %lld us after it expired", static_cast<long long>(seq),
          static_cast<long long>(time_us - valid_until_us));
    return false;
  }
  if (valid_until_us - time_us > kLongestValidity_us) {
    print(detail_, "command of cycle %lld says that it is valid for more than a second",
          static_cast<long long>(seq));
    return false;
  }
  for (std::size_t i = 0; i < actuators_.size(); ++i) {
    if (!judge_actuator(i, command.actuators[i], state.actuators[i])) return false;
  }
  return true;
}

bool CommandGate::judge_actuator(std::size_t i, const ActuatorCommand& command,
                                 const ActuatorState& state) noexcept {
  const ActuatorConfig& actuator = actuators_[i];
  const char* name = actuator.name.c_str();
  if (!is_known(command.mode)) {
    print(detail_, "%s: unknown command mode %d", name, static_cast<int>(command.mode));
    return false;
  }
  const double torque_Nm = command.commanded_torque_Nm;
  const bool torque_counts = command.mode == DriveMode::kTorque || !std::isnan(torque_Nm);
  if (torque_counts && !(std::abs(torque_Nm) <= kTorqueTolerance * actuator.torque_limit_Nm)) {
    print(detail_, "%s: commanded torque %g Nm, limit %g Nm", name, torque_Nm, actuator.torque_limit_Nm);
    return false;
  }
  const double damping = command.commanded_damping_Nm_s_rad;
  const double damping_limit = kDampingFactor * actuator.safety_damping_Nm_s_rad;
  if (command.mode == DriveMode::kDamping && !(damping >= 0.0 && damping <= damping_limit)) {
    print(detail_, "%s: commanded damping %g Nm s/rad, limit %g", name, damping, damping_limit);
    return false;
  }
  const double distance_rad = command.commanded_position_rad - state.measured_position_rad;
  if (command.mode == DriveMode::kPosition && !(std::abs(distance_rad) <= kPositionReach_rad)) {
    print(detail_, "%s: commanded position %g rad, measured %g rad", name, command.commanded_position_rad,
          state.measured_position_rad);
    return false;
  }
  return true;
}

}  // namespace sprung
