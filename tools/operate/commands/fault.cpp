#include <cmath>
#include <cstdio>
#include <limits>
#include <memory>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/operate/client/fault_request.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

constexpr double kSimulationSilence_s = 2.0;
constexpr int kFaultSendings = 3;  // nothing acknowledges it; sim-drives tells a repeat by its stamp
constexpr std::int64_t kSendingPeriod_us = 20'000;
constexpr double kLead_s = 0.080;  // in real time the last one still comes before its cycle

struct FaultCall {
  FaultRequest fault;
  double value = std::numeric_limits<double>::quiet_NaN();
  double after_s = 0.0;
  std::string instance = "default";
};

/// Newest cycle of DRIVE_STATE. @throws std::runtime_error when none comes in time.
std::int64_t next_cycle(Node& node, InputQueue<sprung_msgs::drive_state_t>& states) {
  const std::int64_t end_us = node.utime_us() + static_cast<std::int64_t>(1e6 * kSimulationSilence_s);
  while (node.utime_us() < end_us && !stop_requested()) {
    node.wait_for_input(end_us);
    std::int64_t seq = -1;
    while (const auto state = states.pop()) seq = state->seq;
    if (seq >= 0) return seq;
  }
  throw std::runtime_error("no DRIVE_STATE comes in, so there is no cycle to name: see sprung status");
}

RunInfo require_simulation(const std::string& instance) {
  RunInfo info = require_running(instance, "");
  if (!info.simulation) {
    throw std::runtime_error("faults are made by simulated drives, and " + info.robot +
                             " runs with real ones: sprung down; sprung up " + info.robot + " --sim");
  }
  return info;
}

SimControl control_of(const RobotConfig& robot, FaultCall request) {
  if (!std::isnan(request.value)) request.fault.value = request.value;
  if (request.after_s < 0.0) throw WrongUse("--after must not be negative");
  try {
    return fault_control(robot, request.fault);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

/// All with one stamp, so that it acts once.
void send(Node& node, InputQueue<sprung_msgs::drive_state_t>& states, const SimControl& control) {
  Publisher<SimControl> controls = node.publisher<SimControl>(channels::kSimControl);
  for (int i = 0; i < kFaultSendings; ++i) {
    controls.publish(control);
    const std::int64_t next_us = node.utime_us() + kSendingPeriod_us;
    while (i + 1 < kFaultSendings && node.utime_us() < next_us && !stop_requested()) {
      node.wait_for_input(next_us);
      while (states.pop()) continue;
    }
  }
}

void tell(const std::string& what) {
  std::printf("%s\n", what.c_str());
  std::fflush(stdout);
}

int run_fault(const FaultCall& request) {
  const RunInfo info = require_simulation(request.instance);
  const RobotConfig robot = load_robot(info.robot_folder);
  SimControl control = control_of(robot, request);
  InputQueue<sprung_msgs::drive_state_t> states(1024);
  Node node(commanding(info));
  node.subscribe_message(channels::kDriveState, CountLimits::exactly(robot.actuators.size()), states);
  node.start();
  std::int64_t seq = next_cycle(node, states);
  control.apply_at_seq = seq + std::llround((kLead_s + request.after_s) / robot.cycle_s);
  control.stamp = {node.utime_us(), seq};
  send(node, states, control);
  tell(announcement(request.fault, control));
  while (seq < control.apply_at_seq && !stop_requested()) seq = next_cycle(node, states);
  node.stop();
  if (seq < control.apply_at_seq) return kExitFailed;
  tell(effect_text(control.fault));
  return kExitDone;
}

std::string all_names() {
  std::string text;
  for (const FaultGuide& guide : fault_guides()) {
    text += (text.empty() ? "" : ", ") + std::string(name(guide.kind));
    if (*guide.value != '\0') text += std::string(" (--value: ") + guide.value + ")";
  }
  return text;
}

}  // namespace

void add_fault(CommandLine& sprung) {
  const auto request = std::make_shared<FaultCall>();
  CommandLine& fault = sprung.subcommand("fault",
                                         "Makes a fault in the simulated drives: " + all_names() + ".");
  fault.option("target", request->fault.target, "joint, actuator or bus", Need::kRequired);
  fault.choice("kind", request->fault.kind, names_of<FaultKind>(),
               "which fault; none takes away what was made before", Need::kRequired);
  fault.option("--value", request->value, "how much, where the fault takes a value");
  fault.option("--after", request->after_s, "seconds from now");
  fault.option("--for", request->fault.for_s, "seconds that it lasts, 0 = until mended");
  fault.option("--instance", request->instance, "which run");
  fault.example("sprung fault knee over-current --after 1\n  sprung fault leg bus-off --for 0.5");
  fault.action([=] { return run_fault(*request); });
}

}  // namespace sprung::commands
