#include <chrono>
#include <cstdio>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/stop_request.h"
#include "tools/client/cycle_collector.h"
#include "tools/client/operator_client.h"
#include "tools/commands/answers.h"
#include "tools/commands/commands.h"
#include "tools/experiments/jump_table.h"

namespace sprung::commands {

namespace {

constexpr double kAnswer_s = 3.0;
constexpr double kSilence_s = 5.0;  // without any answer from the planner, which is asked twice a second
constexpr double kLook_s = 0.05;
constexpr std::chrono::milliseconds kSettle{
    300};  // after `done`: what is still on the way, or waits behind a lost message

struct MotionRequest {
  std::string instance = "default";
  std::string robot;
  bool no_wait = false;
  bool report = false;
  std::int64_t at_seq = -1;
  double height_mm = 0.0;
  std::string mode = "hybrid";
  int count = 1;
};

JumpMode jump_mode(const std::string& text) {
  if (text == "position") {
    return JumpMode::kPosition;
  }
  return text == "torque" ? JumpMode::kTorque : JumpMode::kHybrid;
}

int exit_status(const char* what, const std::optional<OperatorAnswer>& answer) {
  return report_motion(what, answer) ? kExitDone : kExitFailed;
}

int run_motion(const char* what, OperatorCommand command, const MotionRequest& request) {
  OperatorClient client(require_running(request.instance, request.robot));
  command.apply_at_seq = request.at_seq;
  const std::optional<OperatorAnswer> answer = client.send(command, kAnswer_s);
  const int status = exit_status(what, answer);
  const bool under_way = answer && status == kExitDone && answer->outcome != OperatorOutcome::kDone;
  if (!under_way || request.no_wait) {
    return status;
  }
  return exit_status(what, client.wait_done(command, kSilence_s));
}

/// Measures while the robot jumps: needs SIM_TRUTH, so simulated drives.
int run_reported_jump(const OperatorCommand& order, const MotionRequest& request) {
  const RunInfo info = require_running(request.instance, request.robot);
  if (!info.simulation) {
    throw WrongUse("--report measures with SIM_TRUTH: it needs simulated drives");
  }
  const RobotConfig robot = load_robot(info.robot_folder);
  JumpMetrics metrics(robot);
  CycleCollector collector(info, robot);
  OperatorClient client(info);
  OperatorCommand command = order;
  command.apply_at_seq = request.at_seq;
  int status = exit_status("jump", client.send(command, kAnswer_s));
  const auto measure = [&](const CycleRecord& cycle) {
    metrics.add(cycle.motion_state, cycle.joint_state, cycle.truth);
  };
  std::optional<OperatorAnswer> done;
  int silent_turns = 0;
  while (status == kExitDone && !done && !stop_requested() && silent_turns++ < kSilence_s / kLook_s) {
    done = client.wait_done(command, kLook_s);
    silent_turns = collector.collect(measure, [](const OperatorReply&) {}) > 0 ? 0 : silent_turns;
  }
  const auto settled = std::chrono::steady_clock::now() + kSettle;
  while (status == kExitDone && std::chrono::steady_clock::now() < settled) {
    collector.wait(kLook_s);
    collector.collect(measure, [](const OperatorReply&) {});
  }
  status = status == kExitDone ? exit_status("jump", done) : status;
  std::printf("%scycles %lld, without a command %lld, overruns %lld, lost on the way to this table %lld\n",
              jump_table(metrics.jumps()).c_str(), static_cast<long long>(collector.last_cycle() + 1),
              static_cast<long long>(collector.missed_cycles()), static_cast<long long>(collector.overruns()),
              static_cast<long long>(collector.lost_cycles()));
  return status;
}

void add_simple(CommandLine& sprung, const char* what, const char* help, OperatorKind kind) {
  const auto request = std::make_shared<MotionRequest>();
  CommandLine& command = sprung.subcommand(what, help);
  command.option("--instance", request->instance, "which run");
  command.option("--robot", request->robot, "refuse unless this robot is up");
  command.option("--at", request->at_seq, "cycle in which it shall take effect, -1 = the next");
  command.flag("--no-wait", request->no_wait, "return when it is accepted, not when it is done");
  command.example(std::string("sprung ") + what);
  command.action([=] {
    OperatorCommand order;
    order.kind = kind;
    return run_motion(what, order, *request);
  });
}

void add_jump(CommandLine& sprung) {
  const auto request = std::make_shared<MotionRequest>();
  CommandLine& jump = sprung.subcommand("jump", "Jump on the spot; the robot must stand.");
  jump.option(
      "--height", request->height_mm,
      "rough height in mm: scales the preset's own curve, low jumps come out a third too high; 0 = as it is");
  jump.choice("--mode", request->mode, {"position", "torque", "hybrid"},
              "control through thrust, flight and landing");
  jump.option("--count", request->count, "how many, one after the other");
  jump.option("--instance", request->instance, "which run");
  jump.option("--robot", request->robot, "refuse unless this robot is up");
  jump.option("--at", request->at_seq, "cycle in which it shall take effect, -1 = the next");
  jump.flag("--no-wait", request->no_wait, "return when it is accepted, not when it is done");
  jump.flag("--report", request->report, "simulated drives: measure the jumps and print a table");
  jump.example("sprung jump --height 150 --mode hybrid --count 3");
  jump.action([=] {
    OperatorCommand order;
    order.kind = OperatorKind::kJump;
    order.jump_height_m = request->height_mm * 1e-3;
    order.jump_mode = jump_mode(request->mode);
    order.jump_count = request->count;
    return request->report ? run_reported_jump(order, *request) : run_motion("jump", order, *request);
  });
}

}  // namespace

void add_motion(CommandLine& sprung) {
  add_simple(sprung, "stand", "Switch the drives on and rise to the stand.", OperatorKind::kStand);
  add_simple(sprung, "sit", "Lower the body, then switch the drives off.", OperatorKind::kSit);
  add_jump(sprung);
  add_simple(sprung, "stop", "Finish the phase that runs, then stand.", OperatorKind::kStop);
}

}  // namespace sprung::commands
