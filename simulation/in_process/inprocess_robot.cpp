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
    : InProcessRobot(robot, preset, robot, sim) {}

InProcessRobot::InProcessRobot(const RobotConfig& robot, const std::string& preset,
                               const RobotConfig& machine, const SimOptions& sim)
    : cycle_us_(std::llround(robot.cycle_s * 1e6)),
      bridge_(robot, BridgeOptions{robot.watchdogs}),
      sim_(machine, sim),
      estimator_(as_in_preset(robot, preset)),
      planner_(robot, robot.preset(preset)),
      controller_(robot, robot.preset(preset), robot.watchdogs),
      drive_state_(robot.actuators.size()),
      joint_state_(robot.joints.size(), robot.legs.size()),
      leg_command_(robot.legs.size()),
      motion_state_(robot.legs.size()),
      drive_command_(robot.actuators.size()),
      heard_drive_state_(drive_state_),
      heard_joint_state_(joint_state_),
      heard_leg_command_(leg_command_),
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

/// A stranger's frames are on the bus for whoever listens there.
void InProcessRobot::give_to_drives() {
  if (links_ != nullptr) {
    links_->sent(to_drives_);
    foreign_.clear();
    links_->add_foreign(foreign_);
    for (const BusFrame& strange : foreign_) {
      to_drives_.push(strange.bus, strange.frame);
      bridge_.receive(strange.bus, strange.frame, time_us_);
    }
  }
  sim_.receive_burst(to_drives_, time_us_ - cycle_us_, time_us_);
}

void InProcessRobot::exchange_frames() {
  give_to_drives();
  to_drives_.clear();
  from_drives_.clear();
  sim_.advance_to(time_us_, from_drives_);
  if (links_ != nullptr) links_->answered(from_drives_);
  for (const BusFrame& answer : from_drives_) {
    bridge_.receive(answer.bus, answer.frame, time_us_);
  }
}

/// @return what comes through: the message itself where nobody stands on the link; nullptr: it is lost.
template <class Signal>
const Signal* InProcessRobot::heard(const Signal& said, Signal& copy) {
  if (links_ == nullptr) return &said;
  copy = said;
  return links_->pass(copy) ? &copy : nullptr;
}

void InProcessRobot::run_cores() {
  if (!runs(StackProcess::kEstimator)) return;  // without a JOINT_STATE the others do nothing
  const DriveState* const measured = heard(drive_state_, heard_drive_state_);
  if (measured == nullptr) return;
  const Imu* const imu = sim_.imu().stamp.seq >= 0 ? heard(sim_.imu(), heard_imu_) : nullptr;
  estimator_.step(*measured, joint_state_, imu);
  const JointState* const estimated = heard(joint_state_, heard_joint_state_);
  if (estimated == nullptr) return;
  const bool commands = runs(StackProcess::kController);
  if (commands) controller_.step(*estimated, heard_legs(), drive_command_);
  plan(*estimated);
  if (!commands) return;
  if (forger_) forger_(drive_command_);
  if (links_ == nullptr || links_->pass(drive_command_)) bridge_.command(drive_command_, time_us_);
}

/// LEG_COMMAND of the cycle before, as the controller has it; one that is lost leaves the one before it.
const LegCommand* InProcessRobot::heard_legs() {
  if (leg_command_.stamp.seq < 0) return nullptr;
  if (links_ == nullptr) return &leg_command_;
  passing_leg_command_ = leg_command_;
  if (links_->pass(passing_leg_command_)) heard_leg_command_ = passing_leg_command_;
  return heard_leg_command_.stamp.seq >= 0 ? &heard_leg_command_ : nullptr;
}

void InProcessRobot::plan(const JointState& estimated) {
  if (leg_source_) {
    leg_source_(estimated, leg_command_);
  } else if (runs(StackProcess::kPlanner)) {
    planner_.step(estimated, leg_command_, motion_state_);
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
  if (links_ != nullptr) links_->ordered(command);
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
