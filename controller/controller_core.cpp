#include "controller/controller_core.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "controller/leg_controller.h"
#include "controller/lowering.h"
#include "signals/microseconds.h"

namespace sprung {
namespace {

/// Longest time that one step may account for; a longer gap only makes fades and rates slower.
constexpr double kLongestStep_s = 0.020;

/// Saturated is no reason to let go: the drive still does what it can.
bool ready(const EstimatedJoint& joint) noexcept {
  return joint.status == JointStatus::kOk || joint.status == JointStatus::kSaturated;
}

CommandBasis basis_of(LegOutcome outcome) noexcept {
  switch (outcome) {
    case LegOutcome::kOk:
      return CommandBasis::kCommanded;
    case LegOutcome::kUnreachable:
      return CommandBasis::kUnreachable;
    case LegOutcome::kNotFinite:
      break;
  }
  return CommandBasis::kNotFinite;
}

}  // namespace

struct ControllerCore::Impl {
  Impl(const RobotConfig& robot, const PresetConfig& preset, const WatchdogConfig& watchdogs)
      : cycle_s(robot.cycle_s),
        leg_command_us(to_us(watchdogs.leg_command_s)),
        valid_us(to_us(watchdogs.command_hold_s + robot.cycle_s)),
        used(robot.legs.size()),
        lowering(robot.legs.size(), preset.sit_length_m, robot.lowering_s) {
    if (!(preset.friction_smoothing_rad_s > 0.0)) {
      throw std::invalid_argument("preset '" + preset.name + "': friction_smoothing must be positive");
    }
    for (const LegConfig& leg : robot.legs) legs.emplace_back(robot, leg, preset);
  }

  CommandBasis check(const JointState& state, const LegCommand* command) const noexcept {
    if (state.safety == SafetyLevel::kLowering) return CommandBasis::kCommandStale;
    if (state.safety != SafetyLevel::kOperational) return CommandBasis::kSafety;
    if (command == nullptr) return CommandBasis::kNoCommand;
    const std::int64_t age_us = state.stamp.utime_us - command->stamp.utime_us;
    if (age_us < 0 || age_us > leg_command_us || command->legs.size() != legs.size()) {
      return CommandBasis::kCommandStale;
    }
    return CommandBasis::kCommanded;
  }

  /// A leg that is to be without power needs no joint that is ready; all others do.
  CommandBasis run(const JointState& state, const LegCommand& command, double dt_s,
                   DriveCommand& out) noexcept {
    const bool wanted = std::any_of(command.legs.begin(), command.legs.end(), [](const DesiredLeg& leg) {
      return leg.control_mode != ControlMode::kDisabled;
    });
    if (wanted && !std::all_of(state.joints.begin(), state.joints.end(), ready))
      return CommandBasis::kJointNotReady;
    const double age_s = 1e-6 * static_cast<double>(state.stamp.utime_us - command.stamp.utime_us);
    CommandBasis worst = CommandBasis::kCommanded;
    for (std::size_t i = 0; i < legs.size(); ++i) {
      worst = std::max(worst, basis_of(legs[i].step(state.joints, command.legs[i], age_s, dt_s, out)));
    }
    return worst;
  }

  void remember(const LegCommand& command) noexcept {
    std::copy(command.legs.begin(), command.legs.end(), used.legs.begin());
    used.stamp = command.stamp;
    was_lowered = false;
    lowering.end();
  }

  /// Who leads changes: set-points go over from those of before.
  void lead_by(bool own) noexcept {
    if (own == led_by_lowering) return;
    led_by_lowering = own;
    for (LegController& leg : legs) leg.begin_anew();
  }

  /// Nobody plans: a robot that stood when the last good command came is let down, once.
  CommandBasis lower(const JointState& state, double dt_s, DriveCommand& out) noexcept {
    const bool held = std::all_of(state.joints.begin(), state.joints.end(),
                                  [](const EstimatedJoint& joint) { return joint.drive_enabled; });
    const bool begins = held && !was_lowered && used.stamp.seq >= 0 && lowering.begin(used, state);
    if (!begins && !(held && lowering.running())) return CommandBasis::kCommandStale;
    was_lowered = true;
    lead_by(true);
    const CommandBasis done = run(state, lowering.at(state.stamp.utime_us), dt_s, out);
    return done == CommandBasis::kCommanded ? CommandBasis::kLowering : done;
  }

  /// @return whether `out` is filled.
  bool follow(const JointState& state, const LegCommand* command, double dt_s, DriveCommand& out) noexcept {
    basis = check(state, command);
    if (basis == CommandBasis::kCommanded) {
      lead_by(false);
      basis = run(state, *command, dt_s, out);
      if (basis == CommandBasis::kCommanded) remember(*command);
    } else if (basis == CommandBasis::kCommandStale) {
      basis = lower(state, dt_s, out);
    } else {
      used.stamp.seq = -1;  // what was before a stop is no reason to move after it
    }
    return basis == CommandBasis::kCommanded || basis == CommandBasis::kLowering;
  }

  void fall_back(const JointState& state, DriveCommand& out) noexcept {
    const bool any_enabled = std::any_of(state.joints.begin(), state.joints.end(),
                                         [](const EstimatedJoint& joint) { return joint.drive_enabled; });
    // Nothing that goes wrong may turn a drive on that is off, nor drop a leg that is held.
    const bool power_off = state.safety == SafetyLevel::kDisabled || !any_enabled;
    for (LegController& leg : legs) power_off ? leg.disable(out) : leg.damp(out);
  }

  double advance(const Stamp& stamp) noexcept {
    const double dt_s = 1e-6 * static_cast<double>(stamp.utime_us - last.utime_us);
    const bool usable = last.seq >= 0 && stamp.seq > last.seq && dt_s > 0.0;
    last = stamp;
    return usable ? std::min(dt_s, kLongestStep_s) : cycle_s;
  }

  void stamp_command(DriveCommand& out) const noexcept {
    out.stamp = last;
    out.valid_until_utime_us = last.utime_us + valid_us;
    out.used_joint_state_seq = last.seq;
  }

  double cycle_s;
  std::int64_t leg_command_us;
  std::int64_t valid_us;
  std::vector<LegController> legs;
  Stamp last;
  LegCommand used;  ///< the last one that was followed; seq -1: none since a stop
  Lowering lowering;
  bool led_by_lowering = false;
  bool was_lowered = false;  ///< it has begun, since a command was followed
  CommandBasis basis = CommandBasis::kNoCommand;
};

ControllerCore::ControllerCore(const RobotConfig& robot, const PresetConfig& preset,
                               const WatchdogConfig& watchdogs)
    : impl_(std::make_unique<Impl>(robot, preset, watchdogs)) {}

ControllerCore::~ControllerCore() = default;

void ControllerCore::step(const JointState& state, const LegCommand* command, DriveCommand& out) noexcept {
  const double dt_s = impl_->advance(state.stamp);
  impl_->stamp_command(out);
  out.used_leg_command_seq = command != nullptr ? command->stamp.seq : -1;
  if (!impl_->follow(state, command, dt_s, out)) impl_->fall_back(state, out);
}

CommandBasis ControllerCore::basis() const noexcept { return impl_->basis; }

LimitCounts ControllerCore::limits() const noexcept {
  LimitCounts sum;
  for (const LegController& leg : impl_->legs) sum += leg.limits();
  return sum;
}

}  // namespace sprung
