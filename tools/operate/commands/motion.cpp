#include <array>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/jump/live_jump_report.h"
#include "tools/operate/client/cycle_collector.h"
#include "tools/operate/client/jump_heights.h"
#include "tools/operate/commands/held_motion.h"
#include "tools/operate/commands/motion_call.h"

namespace sprung::commands {

namespace {

constexpr double kLook_s = 0.05;
constexpr std::chrono::milliseconds kSettle{
    300};  // after `done`: what is still on the way, or waits behind a lost message

struct MotionRequest : HeldCall {
  bool report = false;
  std::string html;
  double height_mm = 0.0;
  double forward_mm = 0.0;
  double touchdown_in_s = kNaN;
  std::array<double, 2> stiffness_N_m{kNaN, kNaN};  ///< x, z
  std::array<double, 2> damping_N_s_m{kNaN, kNaN};
  double friction_compensation = kNaN;
  std::string mode = "hybrid";
  int count = 1;
};

/// The line that jumps so again.
std::string jump_line(const MotionRequest& request) {
  std::string line = "sprung jump --mode " + request.mode + " --count " + std::to_string(request.count);
  if (request.height_mm != 0.0) line += " --height " + std::to_string(std::lround(request.height_mm));
  if (request.forward_mm != 0.0) line += " --forward " + std::to_string(std::lround(request.forward_mm));
  return line + " --report --html " + request.html;
}

/// Nothing where no page was asked for, or no jump began.
void write_page(const RunInfo& info, const MotionRequest& request, const std::vector<JumpResult>& jumps,
                const std::vector<JumpSample>& samples) {
  if (request.html.empty() || jumps.empty()) return;
  const LiveJumps live{info.robot,         info.preset, value_named<JumpMode>(request.mode).value(),
                       jump_line(request), jumps,       samples};
  report::write_report(live_jump_report(live), request.html);
  std::printf("report: %s\n", request.html.c_str());
}

/// Measures while the robot jumps: needs SIM_TRUTH, so simulated drives.
int run_reported_jump(const OperatorCommand& order, const MotionRequest& request) {
  const RunInfo info = require_running(request.instance, request.robot);
  if (!info.simulation) {
    throw WrongUse("--report measures with SIM_TRUTH: it needs simulated drives");
  }
  const RobotConfig robot = load_robot(info.robot_folder);
  JumpMetrics metrics(robot);
  JumpTrace trace(robot);
  CycleCollector collector(info, robot);
  OperatorClient client(info);
  OperatorCommand command = order;
  command.apply_at_seq = request.at_seq;
  int status = motion_exit("jump", client.send(command, kAnswer_s));
  const auto measure = [&](const CycleRecord& cycle) {
    metrics.add(cycle.motion_state, cycle.joint_state, cycle.truth, &cycle.leg_command);
    trace.add(cycle);
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
  status = status == kExitDone ? motion_exit("jump", done) : status;
  std::printf("%scycles %lld, without a command %lld, overruns %lld, lost on the way to this table %lld\n",
              jump_table(metrics.jumps()).c_str(), static_cast<long long>(collector.last_cycle()) + 1,
              static_cast<long long>(collector.missed_cycles()), static_cast<long long>(collector.overruns()),
              static_cast<long long>(collector.lost_cycles()));
  write_page(info, request, metrics.jumps(), trace.samples());
  return status;
}

/// What is said of heights while the robot jumps.
class JumpNews {
 public:
  JumpNews(const RunInfo& info, double asked_m)
      : heights_(asked_m), node_({info.lcm_url, info.session, info.epoch_us, {}}) {
    node_.subscribe_message(channels::kMotionState, CountLimits::up_to(64), motions_);
    node_.start();
  }
  /// @return whether anything was heard since the last time.
  bool tell() {
    bool any = false;
    while (const auto motion = motions_.pop()) {
      any = true;
      for (const std::string& line : heights_.add(*motion)) std::printf("%s\n", line.c_str());
    }
    std::fflush(stdout);
    return any;
  }

 private:
  JumpHeights heights_;
  InputQueue<sprung_msgs::motion_state_t> motions_{1 << 16};
  Node node_;
};

/// Tells how high each jump was as soon as it has landed.
int run_jump(const OperatorCommand& order, const MotionRequest& request) {
  if (request.no_wait) return run_motion("jump", order, request);
  const RunInfo info = require_running(request.instance, request.robot);
  JumpNews news(info, order.jump_height_m);
  OperatorClient client(info);
  OperatorCommand command = order;
  command.apply_at_seq = request.at_seq;
  std::optional<OperatorAnswer> answer = client.send(command, kAnswer_s);
  const int status = motion_exit("jump", answer);
  if (status != kExitDone || answer->outcome == OperatorOutcome::kDone) return status;
  answer.reset();
  int silent_turns = 0;
  while (!answer && !stop_requested() && silent_turns++ < kSilence_s / kLook_s) {
    answer = client.wait_done(command, kLook_s);
    if (news.tell()) silent_turns = 0;
  }
  return motion_exit("jump", answer);
}

void add_simple(CommandLine& sprung, const char* what, const char* help, OperatorKind kind) {
  const auto request = std::make_shared<MotionRequest>();
  CommandLine& command = sprung.subcommand(what, help);
  add_motion_call(command, *request);
  command.example(std::string("sprung ") + what);
  command.action([=] {
    OperatorCommand order;
    order.kind = kind;
    return run_motion(what, order, *request);
  });
}

void add_jump_command(CommandLine& sprung) {
  const auto request = std::make_shared<MotionRequest>();
  CommandLine& jump = sprung.subcommand("jump", "Jump; the robot must stand.");
  jump.option("--height", request->height_mm,
              "rise of the hip above its height at lift-off, mm; 0 = the preset's own curve as it is");
  jump.option("--forward", request->forward_mm,
              "where the foot lands, mm ahead of where it left; the rail must be free in x");
  jump.choice("--mode", request->mode, names_of<JumpMode>(), "control through thrust, flight and landing");
  jump.option("--count", request->count, "how many, one after the other");
  add_motion_call(jump, *request);
  jump.flag(
      "--report", request->report,
      "simulated drives: measure the jumps and print a table instead of the heights that are estimated");
  jump.option("--html", request->html, "with --report: a page with the table and the first jump drawn");
  jump.example("sprung jump --height 150 --mode hybrid --count 3; sprung jump --height 150 --forward 40");
  jump.action([=] {
    OperatorCommand order;
    order.kind = OperatorKind::kJump;
    order.jump_height_m = request->height_mm * 1e-3;
    order.jump_forward_m = request->forward_mm * 1e-3;
    order.jump_mode = value_named<JumpMode>(request->mode).value();
    order.jump_count = request->count;
    if (!request->html.empty() && !request->report) throw WrongUse("--html needs --report");
    return request->report ? run_reported_jump(order, *request) : run_jump(order, *request);
  });
}

void add_comply(CommandLine& sprung) {
  const auto request = std::make_shared<MotionRequest>();
  CommandLine& comply = sprung.subcommand(
      "comply",
      "Hold each foot where it is by a virtual spring while this command runs, or --for a time; from another "
      "terminal with other values; stop or sit ends it.");
  comply.option("--stiffness", request->stiffness_N_m,
                "N/m, along x and z; default: the preset's compliance");
  comply.option("--damping", request->damping_N_s_m,
                "N s/m, along x and z; default: the preset's compliance");
  comply.option("--compensation", request->friction_compensation,
                "share of the gears' friction that is made up for, 0 to 1; default: the preset's");
  add_held_call(comply, *request);
  comply.example("sprung comply --stiffness 2000 2000 --damping 40 40 --compensation 0.9 --for 60");
  comply.action([=] {
    OperatorCommand order;
    order.kind = OperatorKind::kComply;
    order.stiffness_N_m = {request->stiffness_N_m[0], kNaN, request->stiffness_N_m[1]};
    order.damping_N_s_m = {request->damping_N_s_m[0], kNaN, request->damping_N_s_m[1]};
    order.friction_compensation = request->friction_compensation;
    return run_held("comply", order, *request);
  });
}

void add_land(CommandLine& sprung) {
  const auto request = std::make_shared<MotionRequest>();
  CommandLine& land = sprung.subcommand(
      "land", "Catch a fall from rest that begins now; the robot must stand, in the air.");
  land.option("--in", request->touchdown_in_s, "s until the foot is expected to meet the ground, 0.02 to 1",
              Need::kRequired);
  land.choice("--mode", request->mode, names_of<JumpMode>(), "control in the fall and through the landing");
  add_motion_call(land, *request);
  land.example("sprung land --in 0.25 --mode adaptive");
  land.action([=] {
    OperatorCommand order;
    order.kind = OperatorKind::kLand;
    order.jump_mode = value_named<JumpMode>(request->mode).value();
    order.touchdown_in_s = request->touchdown_in_s;
    return run_motion("land", order, *request);
  });
}

}  // namespace

void add_motion(CommandLine& sprung) {
  add_simple(sprung, "stand", "Switch the drives on and rise to the stand.", OperatorKind::kStand);
  add_simple(sprung, "sit", "Lower the body, then switch the drives off.", OperatorKind::kSit);
  add_jump_command(sprung);
  add_comply(sprung);
  add_land(sprung);
  add_walk(sprung);
  add_simple(sprung, "stop", "Finish the phase that runs, then stand; ends compliance and walking.",
             OperatorKind::kStop);
}

}  // namespace sprung::commands
