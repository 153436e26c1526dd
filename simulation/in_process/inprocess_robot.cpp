#include "simulation/in_process/inprocess_robot.h"

#include <cmath>
#include <stdexcept>

namespace sprung {

namespace {

InProcessRobot::ObserverSource& observer_source() {
  static InProcessRobot::ObserverSource source;
  return source;
}

}  // namespace

void InProcessRobot::observe_all_by(ObserverSource source) { observer_source() = std::move(source); }

InProcessRobot::InProcessRobot(const RobotConfig& robot, const std::string& preset, const SimOptions& sim)
    : cycle_us_(std::llround(robot.cycle_s * 1e6)),
      bridge_(robot, BridgeOptions{robot.watchdogs}),
      sim_(robot, sim),
      estimator_(as_in_preset(robot, preset)),
      planner_(robot, robot.preset(preset)),
      controller_(robot, robot.preset(preset), robot.watchdogs),
      drive_state_(robot.actuators.size()),
      joint_state_(robot.joints.size(), robot.legs.size()),
      leg_command_(robot.legs.size()),
      motion_state_(robot.legs.size()),
      drive_command_(robot.actuators.size()),
      observer_(observer_source() ? observer_source()(robot, robot.preset(preset).name, sim) : nullptr) {}

bool InProcessRobot::tick() {
  time_us_ += cycle_us_;
  if (!runs(StackProcess::kBridge)) return advance_without_bridge();
  bridge_.begin_tick(time_us_, to_drives_);
  exchange_frames();
  const bool cyclic = bridge_.end_sampling(time_us_, drive_state_);
  if (cyclic) {
    run_cores();
    if (observer_) observer_->on_cycle(*this);
  }
  bridge_.emit_setpoints(time_us_, to_drives_);
  return cyclic;
}

/// The drives hear nobody, and nobody hears them.
bool InProcessRobot::advance_without_bridge() {
  to_drives_.clear();
  sim_.receive_burst(to_drives_, time_us_ - cycle_us_, time_us_);
  sim_.advance_to(time_us_, from_drives_);
  from_drives_.clear();
  return false;
}

void InProcessRobot::exchange_frames() {
  sim_.receive_burst(to_drives_, time_us_ - cycle_us_, time_us_);
  to_drives_.clear();
  from_drives_.clear();
  sim_.advance_to(time_us_, from_drives_);
  for (const BusFrame& answer : from_drives_) {
    bridge_.receive(answer.bus, answer.frame, time_us_);
  }
}

void InProcessRobot::run_cores() {
  if (!runs(StackProcess::kEstimator)) return;  // without a JOINT_STATE the others do nothing
  estimator_.step(drive_state_, joint_state_, sim_.imu().stamp.seq >= 0 ? &sim_.imu() : nullptr);
  const bool commands = runs(StackProcess::kController);
  if (commands)
    controller_.step(joint_state_, leg_command_.stamp.seq >= 0 ? &leg_command_ : nullptr, drive_command_);
  plan();
  if (!commands) return;
  if (forger_) forger_(drive_command_);
  bridge_.command(drive_command_, time_us_);
}

void InProcessRobot::plan() {
  if (leg_source_) {
    leg_source_(joint_state_, leg_command_);
  } else if (runs(StackProcess::kPlanner)) {
    planner_.step(joint_state_, leg_command_, motion_state_);
  }
}

void InProcessRobot::boot(double limit_s) {
  const std::int64_t end_us = time_us_ + std::llround(limit_s * 1e6);
  while (!tick()) {
    if (time_us_ > end_us) {
      throw std::runtime_error(std::string("the drives did not become operational: ") +
                               bridge_.boot_detail());
    }
  }
}

void InProcessRobot::submit(const OperatorCommand& command) {
  if (observer_) observer_->on_command(command);
  const OperatorKind kind = command.kind;
  if (kind == OperatorKind::kEstop || kind == OperatorKind::kClear || kind == OperatorKind::kHome) {
    bridge_reply_ = bridge_.operator_command(command, time_us_);
    has_bridge_reply_ = true;
    return;
  }
  planner_.submit(command);
}

bool InProcessRobot::next_reply(OperatorReply& out) {
  if (!take_reply(out)) return false;
  if (observer_) observer_->on_reply(out);
  return true;
}

bool InProcessRobot::take_reply(OperatorReply& out) {
  if (has_bridge_reply_) {
    has_bridge_reply_ = false;
    out = bridge_reply_;
    return true;
  }
  return bridge_.next_reply(out) || planner_.next_reply(out);
}

}  // namespace sprung
