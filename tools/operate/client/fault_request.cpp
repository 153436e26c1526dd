#include "tools/operate/client/fault_request.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "signals/messages.h"

namespace sprung {
namespace {

constexpr const char* kClear = "sprung status names the cause, sprung clear recovers";
constexpr const char*
    kEmergency = "sprung can dump --filter emcy; sprung status names the cause, sprung clear recovers";
constexpr const char* kCounters = "sprung status counts them at the node";
constexpr const char* kBus = "sprung status shows the bus; when it is over, sprung clear recovers";

/// Whether the target is a joint, an actuator or a bus; -1 = not this one.
struct Target {
  int actuator = -1;
  int bus = -1;
};

template <class Items>
int index_of(const Items& items, const std::string& name) {
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name == name) return static_cast<int>(i);
  }
  return -1;
}

/// A joint's own actuator stands at its place in the leg, however the transmission couples them.
int actuator_of_joint(const RobotConfig& robot, int joint) {
  for (const LegConfig& leg : robot.legs) {
    const auto place = std::find(leg.joints.begin(), leg.joints.end(), joint);
    const auto at = static_cast<std::size_t>(place - leg.joints.begin());
    if (place != leg.joints.end() && at < leg.actuators.size()) return leg.actuators[at];
  }
  return -1;
}

template <class Items>
void list(const Items& items, const char* what, std::string& text) {
  for (const auto& item : items) text += (text.empty() ? "" : ", ") + item.name;
  text += std::string(" (") + what + ")";
}

Target find_target(const RobotConfig& robot, const std::string& name) {
  const int actuator = index_of(robot.actuators, name);
  if (actuator >= 0) return {actuator, -1};
  const int joint = index_of(robot.joints, name);
  if (joint >= 0 && actuator_of_joint(robot, joint) >= 0) return {actuator_of_joint(robot, joint), -1};
  const int bus = index_of(robot.buses, name);
  if (bus >= 0) return {-1, bus};
  std::string known;
  list(robot.actuators, "actuators", known);
  list(robot.joints, "joints", known);
  list(robot.buses, "buses", known);
  throw std::invalid_argument("'" + name + "' is nothing of " + robot.name + "; there are: " + known);
}

/// By the simulation's own check of what comes in.
void refuse_unheard(const SimControl& control) {
  sprung_msgs::sim_control_t message;
  SimControl heard;
  to_message(control, 0, message);
  if (!from_message(message, heard))
    throw std::invalid_argument("--value is 65535 at most, --for 1e7 s: the simulation takes no more");
}

}  // namespace

const std::vector<FaultGuide>& fault_guides() {
  static const std::vector<FaultGuide> guides = {
      {FaultKind::kNone, true, true, "", 0.0, "sprung status; if a cause is latched, sprung clear"},
      {FaultKind::kOverCurrent, true, false, "", 0.0, kEmergency},
      {FaultKind::kUnderVoltage, true, false, "", 0.0, kEmergency},
      {FaultKind::kOverTemperature, true, false, "", 0.0, kEmergency},
      {FaultKind::kEncoderStuck, true, false, "", 0.0, "the joint's measured position stays while it moves"},
      {FaultKind::kEncoderJump, true, false, "rad of the joint", 0.5,
       "implausible samples; a reference that is wrong until sprung home"},
      {FaultKind::kEncoderNoise, true, false, "rms rad of the joint", 0.0005,
       "noise of the estimated velocity and torque; of several mrad the bridge stops the robot"},
      {FaultKind::kCurrentOffset, true, false, "A", 0.5, "the estimated torque is off by this much"},
      {FaultKind::kFramesLost, true, true, "share of the frames, 0..1", 1.0, kCounters},
      {FaultKind::kFramesLate, true, true, "seconds", 0.005, kCounters},
      {FaultKind::kFramesDuplicated, true, true, "share of the frames, 0..1", 1.0, kCounters},
      {FaultKind::kFramesFlipped, true, true, "share of the frames, 0..1", 0.01,
       "implausible samples are kept out and counted"},
      {FaultKind::kHeartbeatStopped, true, true, "", 0.0, kClear},
      {FaultKind::kBusOff, true, true, "", 0.0, kBus},
      {FaultKind::kErrorPassive, true, true, "", 0.0, kBus},
      {FaultKind::kPowerCycle, true, true, "", 0.0,
       "the node boots again, not operational: sprung clear configures it"},
      {FaultKind::kDuplicateNode, true, false, "", 0.0,
       "sprung drive scan and sprung status count a second device with this id"},
      {FaultKind::kShortPdo, true, false, "", 0.0, kCounters},
      {FaultKind::kLinkDown, true, true, "", 0.0, kBus},
      {FaultKind::kQueueFull, false, true, "", 0.0, kBus},
      {FaultKind::kEmergencyInput, true, false, "", 0.0,
       "where robot.yaml has an emergency_input: no power at once, and no clear until it is released"}};
  return guides;
}

const FaultGuide& guide_of(FaultKind kind) {
  for (const FaultGuide& guide : fault_guides()) {
    if (guide.kind == kind) return guide;
  }
  throw std::logic_error(std::string("no guide for the fault ") + name(kind));
}

int actuator_named(const RobotConfig& robot, const std::string& name) {
  const Target target = find_target(robot, name);
  if (target.actuator < 0)
    throw std::invalid_argument("'" + name + "' is a bus: name a joint or an actuator");
  return target.actuator;
}

SimControl fault_control(const RobotConfig& robot, const FaultRequest& request) {
  const std::optional<FaultKind> kind = value_named<FaultKind>(request.kind);
  if (!kind) throw std::invalid_argument("no fault '" + request.kind + "': sprung fault --help lists them");
  const FaultGuide* const guide = &guide_of(*kind);
  const Target target = find_target(robot, request.target);
  if (target.actuator >= 0 && !guide->on_drive)
    throw std::invalid_argument(request.kind + " is a bus's fault: name the bus, " +
                                robot.buses.front().name);
  if (target.bus >= 0 && !guide->on_bus)
    throw std::invalid_argument(request.kind + " is a drive's fault: name a joint or an actuator");
  const bool takes_value = *guide->value != '\0';
  if (request.value && !takes_value) throw std::invalid_argument(request.kind + " takes no --value");
  if (request.value && !std::isfinite(*request.value))
    throw std::invalid_argument("--value must be a number");
  if (request.for_s < 0.0 || !std::isfinite(request.for_s))
    throw std::invalid_argument("--for must not be negative");
  if (guide->kind == FaultKind::kNone && request.for_s > 0.0)
    throw std::invalid_argument("none takes no --for: what it takes away does not come back");
  SimControl control;
  control.kind = SimControlKind::kNodeFault;
  control.actuator = target.actuator;
  control.bus = target.bus;
  control.fault = guide->kind;
  control.value = request.value.value_or(guide->usual_value);
  control.duration_s = request.for_s;
  refuse_unheard(control);
  return control;
}

std::string announcement(const FaultRequest& request, const SimControl& control) {
  const std::string cycle = "at cycle " + std::to_string(control.apply_at_seq);
  if (control.fault == FaultKind::kNone)
    return request.target + ": faults that were made there are taken away " + cycle;
  std::string text = request.kind + " at " + request.target;
  char number[64];
  if (const char* value = guide_of(control.fault).value; *value != '\0') {
    std::snprintf(number, sizeof number, ", %g ", control.value);
    text += number + std::string(value);
  }
  text += ": acts " + cycle;
  if (control.duration_s > 0.0) {
    std::snprintf(number, sizeof number, " for %g s", control.duration_s);
    text += number;
  }
  return text;
}

std::string effect_text(FaultKind kind) {
  return std::string(kind == FaultKind::kNone ? "taken away. Then: " : "it acts now. Watch: ") +
         guide_of(kind).watch;
}

}  // namespace sprung
