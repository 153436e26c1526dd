#include "tools/can/commission/simulated_bench.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "drivers/canopen/nmt.h"
#include "drivers/canopen/objects.h"
#include "drivers/canopen/sdo_frames.h"

namespace sprung::commission {
namespace {

constexpr std::int64_t kHalfTransfer_us = 250;  ///< a request or its answer, with a drive's time to think
constexpr std::int64_t kSimulatedReply_us = 50'000;
constexpr double kHanging_m = 0.8;                             ///< clear of the floor
constexpr double kPowerOn_s = 0.2;                             ///< the drives have booted
constexpr double kHand_Nm_rad = 400.0, kHand_Nm_s_rad = 40.0;  ///< a firm hand, as experiment drag's
constexpr double kHandTime_s = 0.6, kHoldTime_s = 0.3;

SimOptions hanging(SimOptions sim) {
  sim.plant.emplace("suspended", kHanging_m);
  sim.runs_from_power_on = true;
  return sim;
}

}  // namespace

SimulatedBench::SimulatedBench(const RobotConfig& machine, const BenchSetup& setup)
    : machine_(machine), setup_(setup), sim_(machine, hanging(setup.sim)) {
  wait(kPowerOn_s);
  sling_Nm_ = setup.sling * sim_.true_load_Nm(setup.joint);
  push(0.0);
}

/// In steps of the drives' own loops, so that the truth sees every one of them.
void SimulatedBench::advance(std::int64_t us) {
  const std::int64_t end_us = time_us_ + us;
  do {
    time_us_ = std::min(end_us, time_us_ + kHalfTransfer_us);
    answers_.clear();
    sim_.advance_to(time_us_, answers_);
    take_in();
    watch();
  } while (time_us_ < end_us);
  truth_.simulated_s = now_s();
}

double SimulatedBench::mean_torque_Nm(double now_Nm) {
  constexpr std::int64_t kWindow_us = 5'000;
  torques_.emplace_back(time_us_, now_Nm);
  while (torques_.front().first < time_us_ - kWindow_us) torques_.pop_front();
  double sum_Nm = 0.0;
  for (const auto& [time_us, torque_Nm] : torques_) sum_Nm += torque_Nm;
  return sum_Nm / static_cast<double>(torques_.size());
}

void SimulatedBench::take_in() {
  for (const BusFrame& one : answers_) {
    if (one.bus != setup_.bus || one.frame.error) continue;
    heard_.push_back(one.frame);
    const int node = static_cast<int>(one.frame.id) - static_cast<int>(canopen::heartbeat_id(0));
    const bool boot_up = node > 0 && node < 128 &&
                         canopen::heartbeat_state(one.frame) == canopen::NmtState::kBootUp;
    if (boot_up) ++boot_ups_[static_cast<std::size_t>(node)];
  }
}

/// Torque and motion as they truly are, while the motor gives torque and no hand is on the joint.
void SimulatedBench::watch() {
  const double torque_Nm = std::abs(mean_torque_Nm(sim_.true_motor_torque_Nm(setup_.actuator)));
  truth_.highest_torque_Nm = std::max(truth_.highest_torque_Nm, torque_Nm);
  if (torque_Nm > 0.0 && !under_torque_) torque_from_rad_ = joint_rad();
  under_torque_ = under_torque_ || torque_Nm > 0.0;
  if (hand_on_) under_torque_ = false;
  if (under_torque_)
    truth_.largest_motion_rad = std::max(truth_.largest_motion_rad, std::abs(joint_rad() - torque_from_rad_));
}

double SimulatedBench::joint_rad() const { return sim_.true_position_rad(setup_.joint); }

SdoAnswer SimulatedBench::transfer(canopen::SdoClient& client) {
  if (break_after_ > 0 && step_ == break_step_ && --break_after_ == 0 && break_how_) break_how_(*this);
  heard_.clear();
  while (client.status() == canopen::SdoStatus::kBusy) {
    CanFrame request;
    while (client.step(time_us_, request)) sim_.receive(setup_.bus, request, time_us_);
    if (client.status() != canopen::SdoStatus::kBusy) break;
    advance(kHalfTransfer_us);
    for (const CanFrame& frame : heard_) client.receive(frame);
    heard_.clear();
  }
  advance(kHalfTransfer_us);
  SdoAnswer answer;
  answer.status = client.status();
  if (answer.done()) answer.bytes.assign(client.data(), client.data() + client.size());
  if (answer.status == canopen::SdoStatus::kAborted) answer.abort_code = client.abort_code();
  return answer;
}

SdoAnswer SimulatedBench::read(int node, canopen::ObjectId object) {
  canopen::SdoClient client(node, kSimulatedReply_us);
  client.read(object);
  return transfer(client);
}

SdoAnswer SimulatedBench::write(int node, canopen::ObjectId object, const std::vector<std::uint8_t>& bytes) {
  canopen::SdoClient client(node, kSimulatedReply_us);
  client.write(object, bytes.data(), bytes.size());
  return transfer(client);
}

void SimulatedBench::send(const CanFrame& frame) {
  sim_.receive(setup_.bus, frame, time_us_);
  advance(kHalfTransfer_us);
}

void SimulatedBench::beat() {
  if (time_us_ < next_beat_us_) return;
  next_beat_us_ = time_us_ + std::llround(1e6 * kCycle_s);
  CanFrame sync;
  sync.id = canopen::kSyncId;
  for (std::size_t bus = 0; bus < machine_.buses.size(); ++bus)
    sim_.receive(static_cast<int>(bus), sync, time_us_);
  sim_.receive(setup_.bus, canopen::heartbeat_frame(canopen::kBridgeNode, canopen::NmtState::kOperational),
               time_us_);
  advance(0);
}

void SimulatedBench::wait(double seconds) {
  const std::int64_t end_us = time_us_ + std::llround(1e6 * seconds);
  while (time_us_ < end_us) {
    beat();
    advance(std::min<std::int64_t>(1000, end_us - time_us_));
  }
  heard_.clear();
}

std::vector<int> SimulatedBench::nodes() {
  std::vector<int> found;
  for (int node = 1; node <= canopen::kMaxNode; ++node) {
    heard_.clear();
    canopen::SdoClient client(node, kSimulatedReply_us);
    client.read({canopen::kDeviceType, 0});
    CanFrame request;
    if (client.step(time_us_, request)) sim_.receive(setup_.bus, request, time_us_);
    advance(2 * kHalfTransfer_us);
    for (const CanFrame& frame : heard_)
      if (frame.id == canopen::sdo_server_id(node)) found.push_back(node);
  }
  return found;
}

void SimulatedBench::fault(FaultKind kind, double value, double duration_s) {
  SimControl control;
  control.kind = SimControlKind::kNodeFault;
  control.apply_at_seq = -1;
  control.actuator = setup_.actuator;
  control.fault = kind;
  control.value = value;
  control.duration_s = duration_s;
  sim_.control(control);
  next_beat_us_ = time_us_;
  beat();
}

void SimulatedBench::break_at(const std::string& step, int transfer,
                              std::function<void(SimulatedBench&)> how) {
  break_step_ = step;
  break_after_ = transfer;
  break_how_ = std::move(how);
}

/// A firm hand takes the joint there and holds it; the bus is left alone meanwhile.
void SimulatedBench::turn_joint(double to_rad) {
  constexpr std::int64_t kStep_us = 500;
  const double from_rad = joint_rad();
  hand_on_ = true;
  double last_rad = from_rad;
  for (std::int64_t t_us = 0; 1e-6 * static_cast<double>(t_us) < kHandTime_s + kHoldTime_s;
       t_us += kStep_us) {
    const double share = std::min(1.0, 1e-6 * static_cast<double>(t_us) / kHandTime_s);
    const double at_rad = joint_rad(), speed_rad_s = (at_rad - last_rad) / (1e-6 * kStep_us);
    last_rad = at_rad;
    push(kHand_Nm_rad * (from_rad + share * (to_rad - from_rad) - at_rad) - kHand_Nm_s_rad * speed_rad_s);
    beat();
    advance(kStep_us);
  }
}

double SimulatedBench::answer(const Question& question) {
  switch (question.ask) {
    case Ask::kTurn:
      turned_from_rad_ = joint_rad();
      turn_joint(turned_from_rad_ + question.suggested);
      return (joint_rad() - turned_from_rad_) * (1.0 + setup_.angle_error);
    case Ask::kTurnBack:
      turn_joint(turned_from_rad_);
      push(0.0);
      wait(0.2);
      hand_on_ = false;
      return 1.0;
    case Ask::kPressEmergency:
      if (setup_.presses_emergency) fault(FaultKind::kEmergencyInput, 1.0, 0.0);
      wait(0.02);
      return 1.0;
    case Ask::kReleaseEmergency:
      fault(FaultKind::kNone, 0.0, 0.0);
      wait(0.02);
      return 1.0;
    case Ask::kHangWeight:
      hand_on_ = true;  // what moves now is not the motor's
      push(-question.suggested);
      wait(0.2);
      hand_on_ = false;
      return question.suggested;
    case Ask::kTakeWeight:
      push(0.0);
      return 1.0;
    default:
      return question.suggested;
  }
}

void SimulatedBench::begins(const std::string& step) {
  step_ = step;
  if (on_step_) on_step_(*this, step);
}

void SimulatedBench::hears(const std::string& text) {
  if (prints_) std::fputs(text.c_str(), stdout);
}

}  // namespace sprung::commission
