#include <poll.h>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "runtime/session_clock.h"
#include "runtime/stop_request.h"
#include "runtime/transport/lcm_address.h"
#include "runtime/utc_text.h"
#include "simulation/plant/plant_words.h"
#include "simulation/plant/robot_check.h"
#include "simulation/plant/sim_config.h"
#include "tools/commands.h"
#include "tools/logs/commands/recording_options.h"
#include "tools/operate/client/model_report.h"
#include "tools/operate/launcher/installed_release.h"
#include "tools/operate/launcher/kept_overlay.h"
#include "tools/operate/launcher/launch_view.h"
#include "tools/operate/launcher/launcher.h"
#include "tools/operate/launcher/recorder_plan.h"
#include "tools/operate/launcher/service_notify.h"

namespace sprung::commands {

namespace {

std::string end_text(const Launcher::Ended& ended, bool lockstep) {
  const std::string what = ended.program + " ended (" + exit_text(ended.status) + "). ";
  if (ended.program == kRecorderProgram || ended.program == kLcmLogger)
    return what + (ended.comes_back ? "It is started again, into another log."
                                    : "The run goes on without a log; when that is mended: sprung record.");
  if (ended.comes_back)
    return what +
           "The robot's own safety acts; it is started again once no drive has torque: sprung estop if need "
           "be.";
  return what + "It is not started again; the robot's own safety acts. See sprung status, then sprung down." +
         (lockstep ? " In lock-step the others wait for it." : "");
}

/// Until a stop is asked for or nothing is left to watch. @return exit status.
int watch_over(Launcher& launcher, LaunchView& view, ServiceNotify& service, const LaunchRequest& request) {
  int exit_status = kExitDone;
  const auto complain = [&](const std::string& what) {
    launcher.say("error " + what);
    service.status(what);
  };
  while (!stop_requested()) {
    launcher.look();
    service.keep_alive(monotonic_us());
    for (const Launcher::Ended& ended : launcher.newly_ended()) {
      if (ended.status == 0 && request.cycles > 0) return exit_status;
      complain(end_text(ended, request.clock == "lockstep"));
      if (!ended.comes_back) exit_status = kExitFailed;
    }
    for (const std::string& trouble : launcher.new_trouble()) {
      complain(trouble);
      exit_status = kExitFailed;
    }
    if (launcher.lead_is_gone()) {
      launcher.say("the launcher of the host that has the bridge has ended: stopping here too");
      return exit_status;
    }
    if (launcher.running() == 0) return kExitFailed;
    view.turn();
    poll(nullptr, 0, 20);
  }
  return launcher.all_run() ? exit_status : kExitFailed;  // one that waited to be started again stayed dead
}

void warn_of_ttl(const LaunchRequest& request, const RobotConfig& robot, Launcher& launcher) {
  const LcmAddress address = LcmAddress::of(request.lcm_url);
  if (!remote_processes(request, robot).empty() && (address.ttl == 0 || address.interface.empty()))
    launcher.say(
        "note: robot.yaml has processes on other hosts, but this machine alone is heard: with ttl=1 and the "
        "interface of their network, --lcm-url "
        "'udpm://239.255.76.67:7667?ttl=1&recv_buf_size=4194304&interface=NAME' on every host");
}

void refuse_contradictions(const LaunchRequest& request, const RobotConfig& robot) {
  if (!(request.timeout_s > 0.0)) throw WrongUse("--timeout is more than 0 s");
  try {
    (void)LcmAddress::of(request.lcm_url);
    check_request(request, robot);
    check_recording(request.recorder, request.recording);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

/// Before anything starts; no process of the stack reads what the plant is. On real buses sim.yaml is
/// nobody's, and a robot may have no model.xml: that is said, and it goes on.
void refuse_disagreeing_files(const LaunchRequest& request, const RobotConfig& robot, bool unchecked) {
  if (!request.simulation && !sim::has_model(robot)) {
    std::printf("note: %s has no model.xml: robot.yaml is not checked against one\n", robot.folder.c_str());
    return;
  }
  const auto found = sim::check_robot(
      robot, request.simulation ? sim::CheckAgainst::kModelAndSim : sim::CheckAgainst::kModel);
  if (found.empty()) return;
  std::string text;
  for (const std::string& what : found) text += what + "\n";
  if (!unchecked)
    throw std::runtime_error(text +
                             "nothing was started: mend what is wrong (docs/your_robot.md), or --unchecked");
  std::printf("note: started unchecked, though\n%s", text.c_str());
}

/// A world that there is not, or that is wrong, would only be seen by simulated drives that do not start.
void refuse_wrong_plant(const LaunchRequest& request, const RobotConfig& robot) {
  if (!request.simulation) return;
  (void)sim::load_sim_config(robot, parse_plant(request.plant));
}

int run_up(const LaunchRequest& request, bool plain, bool unchecked) {
  start_log("sprung");
  check_installed_release(program_folder());
  RobotConfig robot = load_robot(request.robot);
  refuse_contradictions(request, robot);
  refuse_disagreeing_files(request, robot, unchecked);
  refuse_wrong_plant(request, robot);
  if (request.maintenance) robot = for_maintenance(std::move(robot));
  ServiceNotify service;
  Launcher launcher(request, robot);
  const KeptOverlay overlay(request.instance, robot);
  int status = kExitFailed;
  {
    LaunchView view(launcher, robot, plain);
    const std::int64_t started_us = monotonic_us();
    warn_of_ttl(request, robot, launcher);
    const std::string today = utc_text(utc_us()).substr(0, 10);
    for (const std::string& old : doubtful_identifications(robot, today)) launcher.say("note: " + old);
    for (const std::string& old : doubtful_zeros(robot, today)) launcher.say("note: " + old);
    launcher.start_all_but_bridge();
    launcher.start_bridge();
    view.announce(static_cast<double>(monotonic_us() - started_us) * 1e-6);
    service.ready(robot.name + " is up; torque comes with sprung stand");
    status = watch_over(launcher, view, service, request);
    service.stopping();
    view.phase("stopping");
    if (plain || !has_terminal()) std::printf("%s: stopping, drives first\n", robot.name.c_str());
    std::fflush(stdout);
    launcher.stop();
    if (!launcher.stopped_in_order()) status = kExitFailed;
  }
  if (!launcher.info().log.empty()) std::printf("log: %s\n", launcher.info().log.c_str());
  return status;
}

/// What was typed, words apart by blanks.
std::string typed_command_line() {
  std::ifstream in("/proc/self/cmdline", std::ios::binary);
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  while (!text.empty() && text.back() == '\0') text.pop_back();
  std::replace(text.begin(), text.end(), '\0', ' ');
  return text;
}

}  // namespace

void add_up(CommandLine& sprung) {
  const auto request = std::make_shared<LaunchRequest>();
  const auto no_record = std::make_shared<bool>(false);
  const auto no_truth = std::make_shared<bool>(false);
  const auto world = std::make_shared<std::string>();
  const auto plain = std::make_shared<bool>(false);
  const auto unchecked = std::make_shared<bool>(false);
  request->lcm_url = kDefaultLcmUrl;
  request->log_folder = "logs";
  CommandLine& up = sprung.subcommand(
      "up", "Start every process of a robot and watch over them; Ctrl-C ends it in order.");
  up.option("robot", request->robot, "name of a folder in robots/, or a folder", Need::kRequired);
  up.flag("--sim", request->simulation, "simulated drives instead of real ones");
  up.flag("--sim-elsewhere", request->simulated_elsewhere,
          "drives that another program simulates are on the buses: simulation_watchdogs apply");
  up.flag("--maintenance", request->maintenance,
          "for work on the robot: a quarter of the speed, half of the torque, and nothing moves without "
          "sprung hold");
  up.choice("--clock", request->clock, {"realtime", "lockstep"},
            "lockstep: deterministic, as fast as it goes, needs --sim");
  up.option("--preset", request->preset, "set of parameters in robot.yaml; default: best, else the only one");
  up.option("--can", request->can, "BUS=ADDRESS: socketcan:can0, udp:GROUP:PORT; may be repeated");
  up.option("--lcm-url", request->lcm_url, "LCM network of this robot");
  up.option("--rt-policy", request->rt_policy, "real-time scheduling: enforce, warn or off");
  up.option("--seed", request->seed, "simulation: seed of every noise");
  up.option("--plant", request->plant,
            "simulation: KEY=VALUE changes the plant, e.g. friction_scale=1.2; may be repeated");
  up.option("--world", *world, "simulation: one of robots/worlds, or a file like them: stairs, ramps, ...");
  up.option("--speed", request->speed, "lock-step: at most so many times real time, 0 = no limit");
  up.option("--timeout", request->timeout_s,
            "seconds for each process to get ready, and for the drives; more on a slow machine");
  up.option("--cycles", request->cycles, "end after that many cycles, 0 = never");
  up.option("--log", request->log_folder, "folder of the LCM log");
  up.flag("--no-record", *no_record, "write no log");
  add_recording_options(up, request->recorder, request->recording);
  up.option("--host", request->host,
            "start the processes that robot.yaml gives to this host; without: those that have no host");
  up.option(
      "--key-file", request->key_file,
      "32 bytes that prove to the processes of several hosts that they belong together; default: new ones");
  up.flag("--plain", *plain, "lines instead of a screen, also in a terminal");
  up.flag("--unchecked", *unchecked,
          "start though robot.yaml, model.xml and sim.yaml disagree: sprung robot check");
  up.flag("--no-truth", *no_truth, "simulation: no SIM_TRUTH");
  up.option("--inject", request->inject,
            "test of the links: PROGRAM=SPEC, e.g. sprung-leg-controller=drop-rx:JOINT_STATE:100");
  up.option("--instance", request->instance, "name of this run, where several robots are up");
  up.example("sprung up single_leg --sim");
  up.action([=] {
    request->truth = !*no_truth;
    if (!world->empty()) request->plant.push_back("world=" + *world);
    request->command_line = typed_command_line();
    if (*no_record) {
      request->log_folder.clear();
    }
    return run_up(*request, *plain, *unchecked);
  });
}

}  // namespace sprung::commands
