/// The steps with power: little current, first at standstill, then just enough to move.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <utility>

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"
#include "signals/angles.h"
#include "tools/can/commission/walk.h"

namespace sprung::commission {
namespace {

constexpr std::int64_t kPowerOffOption = 2;  ///< 0x6007: disable voltage when this master is gone
constexpr std::uint32_t kWatch_ms = 100;     ///< the drive gives up on this master after
constexpr int kOffTries = 3;                 ///< frames may be lost
constexpr double kEnable_s = 1.0, kStill_s = 0.05, kCurrent_s = 0.06;
constexpr int kCurrentSteps = 8;          ///< both ways in turn: the sensor's noise is averaged out
constexpr double kStandstillShare = 0.5;  ///< of breakaway friction: it does not turn
constexpr double kStandstill_rad = 0.002;
constexpr double kWeightShare = 0.25;       ///< of breakaway friction: the known weight
constexpr double kWeightMargin = 0.05;      ///< the same: that it surely moves
constexpr double kLargestLoad = 0.8;        ///< of breakaway friction, on a joint that should have none
constexpr double kWeightedCapShare = 1.45;  ///< of the measured breakaway friction, with the weight
constexpr double kCurrentBound = 1.3;       ///< of the cap, measured: beyond it power goes off at once
constexpr double kConstantError = 0.12;     ///< of the torque constant, by a weight and a protractor
constexpr double kFrictionFactor = 2.0;     ///< measured against robot.yaml's: further apart is said

std::string text_of(const char* format, double a, double b = 0.0, double c = 0.0) {
  char text[240];
  std::snprintf(text, sizeof text, format, a, b, c);
  return text;
}

const char* remedy_of(Travel outcome) {
  switch (outcome) {
    case Travel::kWrongWay:
      return "phases or Hall sensors swapped, or the commutation angle is off: not the sign in robot.yaml, "
             "which "
             "the hand found right";
    case Travel::kNoMotion:
      return "two phases swapped, commutation angle, brake, a load on the joint, or more friction than "
             "robot.yaml "
             "says";
    case Travel::kFades:
      return "pole pairs or encoder counts in the drive, or phases: the field runs away from the rotor";
    case Travel::kTooFast:
    case Travel::kTooFar:
      return "friction is far less than robot.yaml's, or the joint is loaded: power was switched off";
    default:
      return "";
  }
}

}  // namespace

void Walk::set_for_now(canopen::ObjectId object, std::int64_t value, int size) {
  const SdoAnswer before = ask_drive(object);
  if (before.done()) backups_.push_back({object, before.bytes});
  if (!write(object, value, size) || number(object, false).value_or(-1) != value)
    throw DriveLost("it does not take " + named(object) +
                    ", without which nothing would stop it if this computer died");
}

void Walk::power() {
  protocol_.torque_cap_Nm = kCapShare * friction_Nm_;
  if (plan_.torque_mode == 0 || !(friction_Nm_ > 0.0)) {
    finding({"power", "friction of the joint and a make that is known", "missing", Verdict::kDiffers,
             "coulomb_friction of robot.yaml: a data sheet's guess will do"});
    throw Ended{};
  }
  const double cap_A = protocol_.torque_cap_Nm / (actuator_.gear_ratio * actuator_.torque_constant_Nm_A);
  const std::string question =
      text_of("The motor gets power now: at most %.2f Nm at the joint (%.2f A), and off at %.3f rad. ",
              protocol_.torque_cap_Nm, cap_A, kBound_rad) +
      "The robot hangs, the joint is unloaded and free, hands are off, the emergency stop is at hand. 1 = on";
  if (!(ask(Ask::kPower, question, 1.0) == 1.0)) {
    finding({"power", "", "not wanted", Verdict::kNeedsHand, "run this again"});
    throw Ended{};
  }
  switch_on();
  const double from_rad = position_rad();
  const std::vector<CurrentSample> still = record_current(kStill_s);
  double largest_A = 0.0;
  for (const CurrentSample& one : still) largest_A = std::max(largest_A, std::abs(one.current_A));
  const double moved_rad = std::abs(position_rad() - from_rad);
  Finding one{"power without set-point", text_of("no motion, below %.2f A", cap_A),
              text_of("%.4f rad, %.3f A at most", moved_rad, largest_A)};
  if (moved_rad > kStandstill_rad || largest_A > cap_A) {
    one.verdict = Verdict::kDiffers;
    one.to_do = "a load or a brake on the joint, the current sensor's offset, or another mode than shown";
  }
  finding(one);
}

void Walk::switch_on() {
  set_for_now({canopen::kHeartbeatConsumer, 1},
              (static_cast<std::int64_t>(canopen::kBridgeNode) << 16) | kWatch_ms, 4);
  set_for_now({canopen::kAbortConnectionOption, 0}, kPowerOffOption, 2);
  port_.beat();
  powered_ = true;  // from here on switch_off() has something to do
  write(plan_.setpoint, 0, 2);
  write({canopen::kMode, 0}, static_cast<std::uint8_t>(plan_.torque_mode), 1);
  powered_from_rad_ = position_rad();
  const double end_s = port_.now_s() + kEnable_s;
  for (PowerState state = PowerState::kUnknown; state != PowerState::kOperationEnabled;) {
    port_.beat();
    const auto word = static_cast<std::uint16_t>(number({canopen::kStatusWord, 0}, false).value_or(0));
    state = cia402::decode_status(word);
    if (state == PowerState::kFault || state == PowerState::kFaultReactionActive || port_.now_s() > end_s)
      throw DriveLost(std::string("it did not switch on: ") + name(state));
    write({canopen::kControlWord, 0}, cia402::next_control_word(state, cia402::PowerTarget::kEnabled), 2);
    port_.wait(DrivePort::kCycle_s);
  }
  while (number({canopen::kModeDisplay, 0}, true).value_or(0) != plan_.torque_mode) {
    port_.beat();
    if (port_.now_s() > end_s) throw DriveLost("it does not confirm the mode in 0x6061");
    port_.wait(DrivePort::kCycle_s);
  }
}

/// On every way out. A drive that does not say that its power is off keeps its watch of this master, which
/// takes the power, since nothing beats any more.
void Walk::switch_off() noexcept {
  try {
    const bool off = !std::exchange(powered_, false) || take_power();
    put_back(off);
  } catch (...) {  // the drive's own watch of this master remains
  }
}

/// @return whether the drive says so.
bool Walk::take_power() {
  for (int tries = 0; tries < kOffTries; ++tries) {
    port_.write(actuator_.node, plan_.setpoint, {0, 0});
    port_.write(actuator_.node, {canopen::kControlWord, 0}, {0, 0});
    const SdoAnswer word = port_.read(actuator_.node, {canopen::kStatusWord, 0});
    if (!word.done()) continue;
    const PowerState state = cia402::decode_status(static_cast<std::uint16_t>(word.number()));
    if (state == PowerState::kSwitchOnDisabled || state == PowerState::kReadyToSwitchOn ||
        state == PowerState::kNotReadyToSwitchOn || state == PowerState::kFault)
      return true;
  }
  return false;
}

void Walk::put_back(bool off) {
  for (; !backups_.empty(); backups_.pop_back()) {
    const Backup& backup = backups_.back();
    const bool done = off && port_.write(actuator_.node, backup.object, backup.bytes).done();
    const char* what = done  ? "put back"
                       : off ? "NOT put back (no answer): gone when its power goes"
                             : "NOT put back, since the drive does not say that its motor is off: its watch "
                               "takes the power, then the supply off and on";
    const std::string line = named(backup.object) + ": set for this walk, " + what;
    std::vector<std::string>& said = protocol_.written;  // each time that it got power
    if (std::find(said.begin(), said.end(), line) == said.end()) said.push_back(line);
  }
}

void Walk::set_torque(double torque_Nm) {
  const double motor_A = actuator_.direction * torque_Nm /
                         (actuator_.gear_ratio * actuator_.torque_constant_Nm_A);
  const double raw = std::round(motor_A / plan_.A_per_setpoint);
  if (!write(plan_.setpoint, static_cast<std::int16_t>(std::clamp(raw, -32767.0, 32767.0)), 2))
    throw DriveLost("it refuses the set-point " + named(plan_.setpoint));
  protocol_.exposure.torque_Nm = std::max(protocol_.exposure.torque_Nm, std::abs(torque_Nm));
}

/// What bounds everything with power: without it, none.
double Walk::measured_A() {
  const auto raw = number(plan_.measured_current, true);
  if (!raw) throw DriveLost(named(plan_.measured_current) + " cannot be read");
  return static_cast<double>(*raw) * plan_.A_per_measured;
}

Walk::Sample Walk::sample() {
  Sample now;
  now.position_rad = position_rad();
  now.current_A = measured_A();
  now.status = static_cast<std::uint16_t>(number({canopen::kStatusWord, 0}, false).value_or(0));
  require_enabled(now);
  require_bounded(now.current_A);
  return now;
}

void Walk::require_enabled(const Sample& now) {
  const double moved_rad = std::abs(now.position_rad - powered_from_rad_);
  protocol_.exposure.motion_rad = std::max(protocol_.exposure.motion_rad, moved_rad);
  check_drive();
  const PowerState state = cia402::decode_status(now.status);
  if (state == PowerState::kOperationEnabled) return;
  throw DriveLost(std::string("it left operation by itself: ") + name(state));
}

/// A loop that swings up, or a sensor: the drive loses its power before anything is judged.
void Walk::require_bounded(double current_A) {
  const double cap_A = protocol_.torque_cap_Nm / (actuator_.gear_ratio * actuator_.torque_constant_Nm_A);
  if (std::abs(current_A) <= kCurrentBound * cap_A) return;
  switch_off();
  finding({"measured current", text_of("below %.2f A", kCurrentBound * cap_A),
           text_of("%.2f A: power off", current_A), Verdict::kDiffers,
           "current loop gains of another motor, which swing up, or the current sensor: the maker's tool"});
  throw Ended{};
}

std::vector<CurrentSample> Walk::record_current(double seconds) {
  std::vector<CurrentSample> out;
  const double begin_s = port_.now_s();
  while (port_.now_s() - begin_s < seconds) {
    port_.beat();
    const double current_A = measured_A();
    out.push_back({port_.now_s() - begin_s, current_A});
    require_bounded(current_A);
  }
  return out;
}

void Walk::current_step() {
  const double torque_Nm = kStandstillShare * friction_Nm_;
  const double target_A = actuator_.direction * torque_Nm /
                          (actuator_.gear_ratio * actuator_.torque_constant_Nm_A);
  const double from_rad = position_rad();
  const std::vector<CurrentSample> before = record_current(kStill_s);  // later a loop may swing by itself
  std::vector<CurrentSample> after;
  for (int i = 0; i < kCurrentSteps; ++i) {
    const double sign = i % 2 == 0 ? 1.0 : -1.0;
    set_torque(sign * torque_Nm);
    for (const CurrentSample& one : record_current(kCurrent_s))
      after.push_back({one.time_s, sign * one.current_A});
    set_torque(0.0);
    port_.wait(4.0 * DrivePort::kCycle_s);
  }
  const double moved_rad = std::abs(sample().position_rad - from_rad);
  const CurrentStepResult result = judge_current_step(before, after, target_A);
  Finding one{
      text_of("current of %.3f A, half of breakaway friction", target_A), "follows",
      std::string(name(result.verdict)) + text_of(": %.3f A after 3 to 8 ms, then %.3f A, ripple %.3f A rms",
                                                  result.early_A, result.settled_A, result.ripple_A)};
  if (result.verdict != CurrentLoopVerdict::kFollows) {
    one.verdict = Verdict::kDiffers;
    one.to_do = result.verdict == CurrentLoopVerdict::kNothing
                    ? "motor cable, power stage's supply (STO), or ratings of 0"
                    : "current loop gains of another motor: tune them with the maker's tool, type them in "
                      "robot.yaml";
  }
  finding(one);
  Finding still{"standstill meanwhile", text_of("below %.3f rad", kStandstill_rad),
                text_of("%.4f rad", moved_rad)};
  if (moved_rad > kStandstill_rad) {
    still.verdict = Verdict::kDiffers;
    still.to_do = "friction is less than half of robot.yaml's, or the torque constant is another one";
  }
  finding(still);
}

/// One way, and at rest again.
TravelProbe Walk::travel(double direction, double cap_Nm) {
  TravelPlan plan;
  plan.direction = direction;
  plan.cap_Nm = cap_Nm;
  plan.inertia_kg_m2 = std::max(joint_.armature_kg_m2, 0.01);
  plan.bound_rad = kBound_rad;
  TravelProbe probe(plan);
  double last_s = port_.now_s() - DrivePort::kCycle_s;
  while (probe.outcome() == Travel::kGoing) {
    port_.beat();
    const Sample now = sample();
    const double time_s = port_.now_s();
    set_torque(probe.step(std::max(time_s - last_s, 1e-4), now.position_rad));
    last_s = time_s;
    port_.wait(DrivePort::kCycle_s);
  }
  set_torque(0.0);
  port_.wait(0.1);
  port_.beat();
  (void)sample();
  return probe;
}

void Walk::judge_travel(const TravelProbe& probe, double direction, double cap_Nm) {
  Finding one{direction > 0 ? "small torque forward" : "small torque back",
              text_of("moves %+.3f rad with at most %.2f Nm", direction * TravelPlan{}.travel_rad, cap_Nm),
              std::string(name(probe.outcome())) + text_of(": %+.4f rad, breakaway %.2f Nm, highest %.2f Nm",
                                                           direction * probe.moved_rad(),
                                                           probe.breakaway_Nm(), probe.highest_Nm())};
  if (probe.outcome() != Travel::kArrived) {
    one.verdict = Verdict::kDiffers;
    one.to_do = remedy_of(probe.outcome());
  }
  finding(one);
}

/// The way that did not move: it goes against a load if the other one went as far as it should, and took less
/// than friction alone. The load is what it took less.
TravelProbe Walk::against_load(double direction, const TravelProbe& other, double& cap_Nm) {
  const double load_Nm = std::clamp(friction_Nm_ - other.breakaway_Nm(), 0.0, kLargestLoad * friction_Nm_);
  cap_Nm = kCapShare * friction_Nm_ + load_Nm;
  protocol_.torque_cap_Nm = std::max(protocol_.torque_cap_Nm, cap_Nm);
  return travel(direction, cap_Nm);
}

void Walk::compare_link(std::optional<double> before, double motor_moved_rad) {
  if (!before) return;
  const double moved_rad = std::remainder(*link_rad() - *before, kTurn_rad);
  Finding link{"link encoder meanwhile", text_of("%+.4f rad, as the motor's", motor_moved_rad),
               text_of("%+.4f rad", moved_rad)};
  if (std::abs(moved_rad - motor_moved_rad) > 0.1 * std::abs(motor_moved_rad) + 0.002) {
    link.verdict = Verdict::kDiffers;
    link.to_do = "link encoder: sign, counts, coupling";
  }
  finding(link);
}

void Walk::commutation() {
  const double cap_Nm = kCapShare * friction_Nm_;
  double forward_cap_Nm = cap_Nm, back_cap_Nm = cap_Nm;
  auto link_before = link_rad();
  double motor_before = position_rad();
  TravelProbe forward = travel(1.0, cap_Nm);
  const bool loaded = forward.outcome() == Travel::kNoMotion;
  if (!loaded) {
    judge_travel(forward, 1.0, cap_Nm);
    if (forward.outcome() != Travel::kArrived) return;
    compare_link(link_before, position_rad() - motor_before);
  }
  TravelProbe back = travel(-1.0, cap_Nm);
  if (!loaded && back.outcome() == Travel::kNoMotion) back = against_load(-1.0, forward, back_cap_Nm);
  if (loaded && back.outcome() == Travel::kArrived) {
    link_before = link_rad();
    motor_before = position_rad();
    forward = against_load(1.0, back, forward_cap_Nm);
  }
  if (loaded) judge_travel(forward, 1.0, forward_cap_Nm);
  if (loaded && forward.outcome() == Travel::kArrived)
    compare_link(link_before, position_rad() - motor_before);
  judge_travel(back, -1.0, back_cap_Nm);
  if (forward.outcome() != Travel::kArrived || back.outcome() != Travel::kArrived) return;
  const double measured_Nm = 0.5 * (forward.breakaway_Nm() + back.breakaway_Nm());
  mean_Nm_ = 0.5 * (forward.sliding_Nm() + back.sliding_Nm());
  hardest_Nm_ = std::max(forward.breakaway_Nm(), back.breakaway_Nm());
  Finding friction{
      "breakaway friction, load", text_of("%.2f Nm (robot.yaml), little load", friction_Nm_),
      text_of("%.2f Nm, %+.2f Nm", measured_Nm, 0.5 * (forward.breakaway_Nm() - back.breakaway_Nm()))};
  if (measured_Nm * kFrictionFactor < friction_Nm_)
    friction.to_do = "less than half of robot.yaml's: sprung identify";
  finding(friction);
  friction_Nm_ = measured_Nm;
}

bool Walk::moves_both_ways(double cap_Nm, double& mean_Nm) {
  const TravelProbe forward = travel(1.0, cap_Nm);
  if (forward.outcome() != Travel::kArrived) return false;
  const TravelProbe back = travel(-1.0, cap_Nm);
  mean_Nm = 0.5 * (forward.sliding_Nm() + back.sliding_Nm());
  return back.outcome() == Travel::kArrived;
}

/// Friction is the same both ways, a weight is not: the mean of the two ways is the weight.
void Walk::torque_constant() {
  set_torque(0.0);
  switch_off();
  const double cap_Nm = std::max(kWeightedCapShare * friction_Nm_, hardest_Nm_ + kWeightShare * friction_Nm_);
  const double room_Nm = cap_Nm - hardest_Nm_ - kWeightMargin * friction_Nm_;
  const double wanted_Nm = std::min(kWeightShare * friction_Nm_, room_Nm);
  const double weight_Nm = ask(
      Ask::kHangWeight,
      text_of(
          "Power is off. Hang a known weight on the link that makes about %.2f Nm about the joint (mass x "
          "9.81 x "
          "horizontal lever, for example %.2f kg at 0.2 m), and say how many Nm it makes; 0 = no weight here",
          wanted_Nm, wanted_Nm / 9.81 / 0.2),
      wanted_Nm);
  if (!std::isfinite(weight_Nm) || weight_Nm <= 0.0) {
    finding({"torque constant", text_of("%.4f Nm/A", actuator_.torque_constant_Nm_A), "no weight",
             Verdict::kSkipped,
             "without it forces are off by as much as the constant is: sprung identify with a known mass"});
    return;
  }
  switch_on();
  double mean_Nm = 0.0;
  protocol_.torque_cap_Nm = std::max(protocol_.torque_cap_Nm, cap_Nm);
  const bool moves = moves_both_ways(cap_Nm, mean_Nm);
  switch_off();
  ask(Ask::kTakeWeight, "Power is off. Take the weight away", 1.0);
  const double measured_Nm = std::abs(mean_Nm - mean_Nm_);
  const double constant = actuator_.torque_constant_Nm_A *
                          (measured_Nm > 0.0 ? weight_Nm / measured_Nm : 0.0);
  Finding one{text_of("torque constant by %.2f Nm of weight", weight_Nm),
              text_of("%.4f Nm/A", actuator_.torque_constant_Nm_A),
              moves ? text_of("%.4f Nm/A", constant) : "it does not move both ways with the weight"};
  if (!moves || std::abs(constant / actuator_.torque_constant_Nm_A - 1.0) > kConstantError) {
    one.verdict = Verdict::kDiffers;
    one.to_do = "torque_constant of robot.yaml, the weight or its lever, or the commutation angle";
  }
  finding(one);
}

}  // namespace sprung::commission
