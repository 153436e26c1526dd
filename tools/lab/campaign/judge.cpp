#include "tools/lab/campaign/judge.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "drivers/canopen/wire.h"
#include "drivers/cia402/words.h"

namespace sprung::campaign {
namespace {

/// Beyond its limits, and what a joint's stop yields that stands just there in model.xml: one that leans on
/// it is not beyond it.
constexpr double kBeyond_rad = 0.05 + 0.001;
constexpr double kTooFastShare = 1.2, kTooFast_s = 0.02;
constexpr double kNamed_s = 0.05;  // for the cause, from then on
constexpr double kDrivingWork_J = 1.0;
constexpr double
    kCurrentFalls_s = 0.01;  // a thrust's torque does not end in one cycle: current loop, and its frame
/// Lowering 1.5 s, damping until the joints rest 5 s, the drives' quick stop 0.5 s, and a tenth.
constexpr double kLongestStop_s = 7.1;
/// Heartbeat consumers of 20 ms and the 60 ms in which a dead program must be without effect.
constexpr double kDeadBridge_s = 0.06;
constexpr double kOff_s = 0.1;                // after `disabled`
constexpr double kSetpointBeyond_rad = 0.15;  // the window in which the drives' own limits lie
constexpr double kHeld_rad = 0.02;            // what an encoder and a cycle's motion leave
constexpr double kNoTorque_Nm = 1e-9;

std::int16_t i16(const std::uint8_t* bytes) { return static_cast<std::int16_t>(canopen::get_le(bytes, 2)); }
std::int32_t i32(const std::uint8_t* bytes) { return static_cast<std::int32_t>(canopen::get_le(bytes, 4)); }

std::string with_number(const std::string& name, double value, const char* unit) {
  char text[48];
  std::snprintf(text, sizeof text, " %.3g %s", value, unit);
  return name + text;
}

}  // namespace

/// Counts of a set-point are read by what its drive has measured and where its joint truly was then, so that
/// no zero has to be believed. What an encoder shows that sticks says nothing of the joint any more.
struct Judge::Drive {
  std::string name;
  int bus = 0;
  std::uint32_t setpoint_id = 0;
  int most_torque = 0;
  double counts_per_rad = 0.0;  ///< with its sign
  std::uint8_t position_mode = 0;
  double lowest_rad = 0.0, highest_rad = 0.0;
  std::unique_ptr<DriveProfile> profile;
  bool enabled = false;
  std::int32_t measured_counts = 0;
  double zero_rad = kNaN;  ///< the joint's true position at count 0, by the last sample that differed
  double true_position_rad = kNaN;  ///< not known before the first cycle
};

Judge::Judge(const RobotConfig& machine) : robot_(machine), joints_(machine.joints.size()) {
  if (machine.actuators.size() != machine.joints.size())
    throw std::invalid_argument("the campaign's judge knows robots with one actuator a joint; " +
                                machine.name + " has " + std::to_string(machine.actuators.size()) + " of " +
                                std::to_string(machine.joints.size()));
  for (std::size_t i = 0; i < machine.actuators.size(); ++i) {
    const ActuatorConfig& actuator = machine.actuators[i];
    auto drive = std::make_shared<Drive>();
    drive->name = actuator.name;
    drive->bus = actuator.bus;
    drive->profile = make_profile(actuator, timing_of(machine.cycle_s, machine.watchdogs));
    DriveSetpoint setpoint{actuator.torque_limit_Nm, 0.0, DriveMode::kPosition};
    const CanFrame at_zero = drive->profile->encode_setpoint(setpoint);
    setpoint.commanded_position_rad = 1.0;
    const CanFrame at_one = drive->profile->encode_setpoint(setpoint);
    drive->setpoint_id = at_zero.id;
    drive->most_torque = std::abs(i16(&at_zero.data[0])) + 1;
    drive->position_mode = at_zero.data[6];
    drive->counts_per_rad = static_cast<double>(i32(&at_one.data[2])) - i32(&at_zero.data[2]);
    drive->lowest_rad = machine.joints[i].position_min_rad - kSetpointBeyond_rad;
    drive->highest_rad = machine.joints[i].position_max_rad + kSetpointBeyond_rad;
    drives_.push_back(std::move(drive));
  }
}

int Judge::cycles(double seconds) const noexcept {
  return static_cast<int>(std::lround(seconds / robot_.cycle_s));
}

void Judge::breach(Rule rule, const std::string& detail) {
  const auto same = [&](const Breach& one) { return one.rule == rule; };
  if (std::none_of(breaches_.begin(), breaches_.end(), same)) breaches_.push_back({rule, seq_, detail});
}

void Judge::operator_asked() noexcept { operator_asked_ = true; }

bool Judge::any_enabled() const noexcept {
  return std::any_of(drives_.begin(), drives_.end(), [](const auto& drive) { return drive->enabled; });
}

double Judge::damping_work_J() const noexcept {
  double most = 0.0;
  for (const Joint& joint : joints_) most = std::max(most, joint.work_J);
  return most;
}

void Judge::sent(const FrameBatch& frames) noexcept {
  bridge_spoke_ = true;
  silent_ = 0;
  for (const BusFrame& one : frames)
    for (const auto& drive : drives_)
      if (drive->bus == one.bus && drive->setpoint_id == one.frame.id && one.frame.length >= 7)
        look_at_setpoint(*drive, one.frame);
}

void Judge::look_at_setpoint(Drive& drive, const CanFrame& frame) {
  const int torque = i16(&frame.data[0]);
  if (std::abs(torque) > drive.most_torque)
    breach(Rule::kBadSetpoint, with_number(drive.name, torque, "counts of torque"));
  const double goal_rad = drive.zero_rad + i32(&frame.data[2]) / drive.counts_per_rad;
  // A joint that is beyond its limits itself may be held where it is, or brought back.
  const double low_rad = std::min(drive.lowest_rad, drive.true_position_rad - kHeld_rad);
  const double high_rad = std::max(drive.highest_rad, drive.true_position_rad + kHeld_rad);
  if (frame.data[6] == drive.position_mode && drive.enabled && (goal_rad < low_rad || goal_rad > high_rad))
    breach(Rule::kBadSetpoint, with_number(drive.name, goal_rad, "rad"));
}

void Judge::answered(const FrameBatch& frames) noexcept {
  for (const BusFrame& one : frames) {
    for (const auto& drive : drives_) {
      DriveSample sample;
      if (drive->bus != one.bus || one.frame.error || !drive->profile->decode_sample(one.frame, sample))
        continue;
      const bool enabled = cia402::decode_status(sample.status_word) == PowerState::kOperationEnabled;
      if (enabled && !drive->enabled && !operator_asked_) breach(Rule::kUncommandedEnable, drive->name);
      drive->enabled = enabled;
      const std::int32_t counts = i32(&one.frame.data[0]);
      if (counts != drive->measured_counts || std::isnan(drive->zero_rad))
        drive->zero_rad = drive->true_position_rad - counts / drive->counts_per_rad;
      drive->measured_counts = counts;
    }
  }
}

void Judge::look(const Scene& scene) {
  seq_ = scene.seq;
  for (std::size_t i = 0; i < drives_.size(); ++i)
    drives_[i]->true_position_rad = scene.truth->joints[i].true_position_rad;
  damped_ = scene.said->level == SafetyLevel::kDamping ? damped_ + 1 : 0;
  for (std::size_t j = 0; j < joints_.size(); ++j) look_at_joint(j, scene);
  look_at_stop(scene);
}

void Judge::look_at_joint(std::size_t j, const Scene& scene) {
  const TrueJoint& joint = scene.truth->joints[j];
  const JointConfig& limits = robot_.joints[j];
  const bool named = scene.said->level != SafetyLevel::kOperational || scene.said->latched;
  const double below_rad = limits.position_min_rad - joint.true_position_rad;
  const double beyond_rad = std::max(below_rad, joint.true_position_rad - limits.position_max_rad);
  const double outward_Nm = (below_rad > 0.0 ? -1.0 : 1.0) * joint.true_motor_torque_Nm;
  farthest_rad_ = std::max(farthest_rad_, beyond_rad);
  Joint& seen = joints_[j];
  seen.beyond = beyond_rad > kBeyond_rad && outward_Nm > kNoTorque_Nm && !named ? seen.beyond + 1 : 0;
  if (seen.beyond > cycles(kNamed_s)) breach(Rule::kBeyondLimit, with_number(limits.name, beyond_rad, "rad"));
  const double share = std::abs(joint.true_velocity_rad_s) / robot_.actuators[j].speed_limit_rad_s;
  fastest_share_ = std::max(fastest_share_, share);
  seen.fast = share > kTooFastShare && !named ? seen.fast + 1 : 0;
  if (seen.fast > cycles(kTooFast_s + kNamed_s))
    breach(Rule::kTooFast, with_number(limits.name, share, "times"));
  if (damped_ <= cycles(kCurrentFalls_s)) return;
  seen.work_J += std::max(0.0, joint.true_motor_torque_Nm * joint.true_velocity_rad_s) * robot_.cycle_s;
  if (seen.work_J > kDrivingWork_J) breach(Rule::kDrivingStop, with_number(limits.name, seen.work_J, "J"));
}

void Judge::look_at_stop(const Scene& scene) {
  const auto& torques = *scene.motor_torque_Nm;
  const bool torque = std::any_of(torques.begin(), torques.end(),
                                  [](double t) { return std::abs(t) > kNoTorque_Nm; });
  const bool latched = scene.said->latched && scene.said->level != SafetyLevel::kOperational;
  stopped_ = latched ? stopped_ + 1 : 0;
  if (stopped_ > cycles(kLongestStop_s) && torque) breach(Rule::kTorqueStays, name(scene.said->level));
  disabled_ = scene.said->level == SafetyLevel::kDisabled ? disabled_ + 1 : 0;
  if (disabled_ > cycles(kOff_s) && torque) breach(Rule::kDisagrees, name(scene.said->cause));
  if (bridge_spoke_ && ++silent_ > cycles(kDeadBridge_s) && torque)
    breach(Rule::kTorqueStays, "the bridge is silent");
  if (latched) operator_asked_ = false;  // from here on power wants somebody's word
}

}  // namespace sprung::campaign
