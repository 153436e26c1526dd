#include <poll.h>
#include <string.h>

#include <algorithm>
#include <cstdio>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "runtime/node.h"
#include "runtime/stop_request.h"
#include "tools/commands/commands.h"
#include "tools/launcher/launcher.h"

namespace sprung::commands {

namespace {

/// What to type next.
std::string first_commands(const RobotConfig& robot) {
  const bool referenced = std::all_of(robot.actuators.begin(), robot.actuators.end(),
                                      [](const ActuatorConfig& actuator) { return actuator.referenced; });
  std::string out = referenced ? "" : "sprung home, ";
  if (robot.why_not_standing() == nullptr)
    out += robot.gaits.empty() ? "sprung stand, sprung jump, " : "sprung stand, sprung walk, sprung stop, ";
  return out + "sprung status, sprung down";
}

void announce(const LaunchRequest& request, const RobotConfig& robot, const Launcher& launcher,
              double ready_s) {
  const RunInfo& info = launcher.info();
  std::printf("%s is up: %zu processes, clock %s, preset %s, ready in %.1f s\n", info.robot.c_str(),
              launcher.running(), info.clock.c_str(), info.preset.c_str(), ready_s);
  std::printf("  LCM  %s\n", info.lcm_url.c_str());
  if (!info.log.empty()) {
    std::printf("  log  %s\n", info.log.c_str());
  }
  if (request.simulation && request.clock == "realtime") {
    std::printf(
        "  note simulated drives in real time: the longer simulation_watchdogs of robot.yaml apply\n");
  }
  std::printf("In a second terminal: %s. Ctrl-C here ends it.\n", first_commands(robot).c_str());
  std::fflush(stdout);
}

/// Until a stop is asked for or nothing is left to watch. @return exit status.
int watch_over(Launcher& launcher, bool ends_by_itself) {
  int exit_status = kExitDone;
  while (!stop_requested()) {
    for (const Launcher::Ended& ended : launcher.newly_ended()) {
      const bool good = ended.status == 0 && ends_by_itself;
      const std::string how = ended.status < 128 ? "exit status " + std::to_string(ended.status)
                                                 : std::string(strsignal(ended.status - 128));
      if (good) {
        return exit_status;
      }
      log_error(ended.program + " ended (" + how +
                "). It is not started again; the robot's own safety acts. " +
                "See sprung status, then sprung down.");
      exit_status = kExitFailed;
    }
    if (launcher.running() == 0) {
      return kExitFailed;
    }
    poll(nullptr, 0, 20);
  }
  return exit_status;
}

int run_up(const LaunchRequest& request) {
  if (!(request.patience_s > 0.0)) throw WrongUse("--patience is more than 0 s");
  start_log("sprung");
  const RobotConfig robot = load_robot(request.robot);
  Launcher launcher(request, robot);
  const std::int64_t started_us = monotonic_us();
  launcher.start_all_but_bridge();
  launcher.start_bridge();
  announce(request, robot, launcher, static_cast<double>(monotonic_us() - started_us) * 1e-6);
  const int status = watch_over(launcher, request.cycles > 0);
  std::printf("%s: stopping, drives first\n", launcher.info().robot.c_str());
  std::fflush(stdout);
  launcher.stop();
  if (!launcher.info().log.empty()) {
    std::printf("log: %s\n", launcher.info().log.c_str());
  }
  return status;
}

}  // namespace

void add_up(CommandLine& sprung) {
  const auto request = std::make_shared<LaunchRequest>();
  const auto no_record = std::make_shared<bool>(false);
  const auto no_truth = std::make_shared<bool>(false);
  request->lcm_url = kDefaultLcmUrl;
  request->log_folder = "logs";
  CommandLine& up =
      sprung.subcommand("up", "Start every process of a robot and watch over them; Ctrl-C ends it in order.");
  up.option("robot", request->robot, "name of a folder in robots/, or a folder", Need::kRequired);
  up.flag("--sim", request->simulation, "simulated drives instead of real ones");
  up.choice("--clock", request->clock, {"realtime", "lockstep"},
            "lockstep: deterministic, as fast as it goes, needs --sim");
  up.option("--preset", request->preset, "set of parameters in robot.yaml");
  up.option("--can", request->can, "BUS=ADDRESS: socketcan:can0, udp:GROUP:PORT; may be repeated");
  up.option("--lcm-url", request->lcm_url, "LCM network of this robot");
  up.option("--rt-policy", request->rt_policy, "real-time scheduling: enforce, warn or off");
  up.option("--seed", request->seed, "simulation: seed of every noise");
  up.option("--plant", request->plant,
            "simulation: KEY=VALUE changes the plant, e.g. friction_scale=1.2; may be repeated");
  up.option("--speed", request->speed, "lock-step: at most so many times real time, 0 = no limit");
  up.option("--patience", request->patience_s,
            "seconds for each process to get ready, and for the drives; more on a slow machine");
  up.option("--cycles", request->cycles, "end after that many cycles, 0 = never");
  up.option("--log", request->log_folder, "folder of the LCM log");
  up.flag("--no-record", *no_record, "write no log");
  up.flag("--no-truth", *no_truth, "simulation: no SIM_TRUTH");
  up.option("--inject", request->inject,
            "test of the links: PROGRAM=SPEC, e.g. sprung-leg-controller=drop-rx:JOINT_STATE:100");
  up.option("--instance", request->instance, "name of this run, where several robots are up");
  up.example("sprung up single_leg --sim");
  up.action([=] {
    request->truth = !*no_truth;
    if (*no_record) {
      request->log_folder.clear();
    }
    return run_up(*request);
  });
}

}  // namespace sprung::commands
