#include "tests/support/disturbed_stack.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "drivers/canopen/nmt.h"

namespace sprung::test {
namespace {

constexpr double kShort_Nm = 5.0;  // between what a drive is told and what it gives
constexpr int kShortCycles = 25;   // longer than a current loop takes
constexpr int kBootCycles = 2500;
constexpr double kSettle_s = 0.2;  // the estimator
constexpr double kHome_s = 0.2;
constexpr double kRise_s = 2.8;

}  // namespace

DisturbedStack::DisturbedStack(const RobotConfig& robot, const std::map<std::string, double>& plant)
    : robot_(robot),
      cycle_us_(std::llround(robot.cycle_s * 1e6)),
      bridge_(robot, BridgeOptions{robot.watchdogs}),
      sim_(robot,
           [&plant] {
             SimOptions options;
             options.plant = plant;
             return options;
           }()),
      estimator_(robot),
      planner_(robot, robot.preset("best")),
      controller_(robot, robot.preset("best"), robot.watchdogs),
      drive_state_(robot.actuators.size()),
      joint_state_(robot.joints.size(), robot.legs.size()),
      leg_command_(robot.legs.size()),
      motion_state_(robot.legs.size()),
      drive_command_(robot.actuators.size()),
      weak_cycles_(robot.actuators.size(), 0) {}

void DisturbedStack::stand_up() {
  OperatorCommand home;
  home.kind = OperatorKind::kHome;
  home.reference_source = ReferenceSource::kLink;
  for (int i = 0; !bridge_.operational(); ++i) {
    if (i > kBootCycles) throw std::runtime_error(bridge_.boot_detail());
    tick();
  }
  run(kSettle_s);
  ask(home);
  run(kHome_s);
  OperatorCommand stand;
  stand.kind = OperatorKind::kStand;
  ask(stand);
  run(kRise_s);
  if (motion_state_.state != MotionPhase::kStanding)
    throw std::runtime_error(std::string("it does not stand: ") + motion_state_.last_transition + "; " +
                             bridge_.safety().detail.data());
}

void DisturbedStack::run(double seconds) {
  run_cycles(static_cast<int>(std::lround(seconds / robot_.cycle_s)));
}

void DisturbedStack::run_cycles(int cycles) {
  for (int i = 0; i < cycles; ++i) tick();
}

void DisturbedStack::ask(OperatorCommand command) {
  command.request_id = ++said_;
  if (command.kind == OperatorKind::kHome) {
    (void)bridge_.operator_command(command, time_us_);
  } else {
    planner_.submit(command);
  }
}

void DisturbedStack::fault(FaultKind kind, int actuator, double value, double duration_s) {
  SimControl control;
  control.kind = SimControlKind::kNodeFault;
  control.fault = kind;
  control.actuator = actuator;
  control.value = value;
  control.duration_s = duration_s;
  sim_.control(control);
}

void DisturbedStack::floor(double height_m, int leg) {
  SimControl control;
  control.kind = SimControlKind::kFloor;
  control.actuator = leg;
  control.value = height_m;
  sim_.control(control);
}

void DisturbedStack::push(const std::array<double, 6>& wrench, double duration_s) {
  SimControl control;
  control.kind = SimControlKind::kWrench;
  control.wrench = wrench;
  control.duration_s = duration_s;
  sim_.control(control);
}

void DisturbedStack::watch() {
  watching_ = true;
  acted_.clear();
  before_ = controller_.limits();
  std::fill(weak_cycles_.begin(), weak_cycles_.end(), 0);
}

void DisturbedStack::tick() {
  time_us_ += cycle_us_;
  bridge_.begin_tick(time_us_, to_drives_);
  exchange_frames();
  if (bridge_.end_sampling(time_us_, drive_state_) && !missing.drive_state) run_cores();
  bridge_.emit_setpoints(time_us_, to_drives_);
  if (watching_) note();
}

void DisturbedStack::exchange_frames() {
  FrameBatch heard;
  for (const BusFrame& frame : to_drives_) {
    const bool heartbeat = frame.frame.id == canopen::heartbeat_id(canopen::kBridgeNode);
    if (!(heartbeat && missing.heartbeat)) heard.push(frame.bus, frame.frame);
  }
  to_drives_.clear();
  sim_.receive_burst(heard, time_us_ - cycle_us_, time_us_);
  from_drives_.clear();
  sim_.advance_to(time_us_, from_drives_);
  for (const BusFrame& answer : from_drives_) bridge_.receive(answer.bus, answer.frame, time_us_);
}

void DisturbedStack::run_cores() {
  estimator_.step(drive_state_, joint_state_, sim_.imu().stamp.seq >= 0 ? &sim_.imu() : nullptr);
  controller_.step(joint_state_, leg_command_.stamp.seq >= 0 ? &leg_command_ : nullptr, drive_command_);
  if (!missing.leg_command) planner_.step(joint_state_, leg_command_, motion_state_);
  if (!missing.drive_command) bridge_.command(drive_command_, time_us_);
}

void DisturbedStack::note() {
  const SafetyState& safety = bridge_.safety();
  if (safety.level != SafetyLevel::kOperational)
    acted_.insert(std::string(name(safety.cause)) + (safety.latched ? ", latched" : ""));
  const CommandBasis basis = controller_.basis();
  const bool own = basis != CommandBasis::kCommanded && basis != CommandBasis::kSafety;
  if (own && !missing.drive_state) acted_.insert(sprung::name(basis));
  for (const EstimatedJoint& joint : joint_state_.joints)
    if (joint.status == JointStatus::kStarting) acted_.insert("estimator starts anew");
  for (OperatorReply reply; planner_.next_reply(reply);)
    if (reply.outcome == OperatorOutcome::kRefused) acted_.insert(reply.reason);
  if (motion_state_.state == MotionPhase::kFallen) acted_.insert("fallen");
  for (const MotionLeg& leg : motion_state_.legs)
    if (leg.event_counts[static_cast<std::size_t>(LegEvent::kNoGround)] > 0) acted_.insert("no ground");
  note_clamps();
  note_drives();
}

void DisturbedStack::note_clamps() {
  const LimitCounts now = controller_.limits();
  const std::pair<const char*, std::int64_t> clamps[] = {
      {"soft stop", now.soft_stop - before_.soft_stop},
      {"torque", now.torque - before_.torque},
      {"speed", now.speed - before_.speed + now.velocity - before_.velocity},
      {"power", now.power - before_.power},
      {"position", now.position - before_.position}};
  for (const auto& [what, count] : clamps)
    if (count > 0) acted_.insert(what);
}

/// A drive that gives less than it is told protects its motor.
void DisturbedStack::note_drives() {
  for (std::size_t i = 0; i < robot_.actuators.size(); ++i) {
    const ActuatorConfig& actuator = robot_.actuators[i];
    const ActuatorCommand& told = drive_command_.actuators[i];
    const double given_Nm = drive_state_.actuators[i].measured_current_A * actuator.gear_ratio *
                            actuator.torque_constant_Nm_A;
    const bool weak = told.mode == DriveMode::kTorque &&
                      std::abs(told.commanded_torque_Nm) - std::abs(given_Nm) > kShort_Nm;
    weak_cycles_[i] = weak ? weak_cycles_[i] + 1 : 0;
    if (weak_cycles_[i] > kShortCycles) acted_.insert("drive's current");
  }
}

}  // namespace sprung::test
