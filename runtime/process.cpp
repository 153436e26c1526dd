#include "runtime/process.h"

#include <sprung_version.h>
#include <unistd.h>

#include <stdexcept>
#include <utility>

#include "lcmtypes/channels.h"
#include "robots/maintenance.h"
#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "runtime/stop_request.h"
#include "runtime/types_hash.h"

namespace sprung {
namespace {

int run(const ProgramInfo& info, ProcessOptions options, const std::function<int(Process&)>& body) {
  start_log(info.program);
  install_stop_signals();
  stop_with_parent();
  RobotConfig robot = load_robot(options.robot);
  try {
    options.preset = robot.preset(options.preset).name;
    robot = as_in_preset(std::move(robot), options.preset);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(std::string("--preset: ") + error.what());
  }
  if (options.maintenance) robot = for_maintenance(std::move(robot));
  refuse_injection(options);
  if (!info.only_looks) options.node.key = key_of(options);
  options.node.lockstep = options.clock_mode() == ClockMode::kLockstep;
  const std::string real_time = set_up_real_time(options.real_time());
  if (real_time_refused(real_time)) log_warn("real time: " + real_time);
  Process process(info, options, robot, real_time);
  try {
    const int status = body(process);
    process.set_state(ProcessState::kStopping);
    return status;
  } catch (const std::exception& error) {
    log_error(error.what());
    return kExitFailed;
  }
}

}  // namespace

Process::Process(const ProgramInfo& info, const ProcessOptions& options, const RobotConfig& robot,
                 const std::string& real_time)
    : options_(options),
      robot_(robot),
      node_(options.node),
      statistics_(lockstep() ? 0.0 : robot.cycle_s * 1e6),
      publisher_(node_.publisher<ProcessStatus>(channels::kProcessStatus)) {
  status_.pid = getpid();
  status_.configuration_hash = configuration_hash(robot, options.preset);
  status_.types_hash = types_hash();
  status_.process = info.program;
  status_.host = host_name();
  status_.version = SPRUNG_VERSION;
  status_.git_hash = SPRUNG_GIT_HASH;
  status_.robot = robot.name;
  status_.clock = name(options.clock_mode());
  status_.real_time = real_time;
}

void Process::set_state(ProcessState state) {
  status_.state = state;
  publish_status_if_due();
}

void Process::set_standing_note(const std::string& note) {
  const bool first = standing_note_.empty();
  standing_note_ = status_.detail = note;
  if (first) publish_status();
}

void Process::publish_status_if_due() {
  if (schedule_.due(status_.state, node_.utime_us())) publish_status();
}

void Process::publish_status() {
  status_.stamp.utime_us = node_.utime_us();
  status_.utc_offset_us = node_.clock().utc_offset_us();
  status_.cycles = statistics_.cycles();
  status_.loop = statistics_.summarize();
  status_.cpu_share = cpu_meter_.cpu_share();
  status_.memory_kB = resident_kB();
  const std::int64_t refused = node_.refused_messages();
  if (refused != status_.refused_messages) status_.detail = node_.last_refusal();  // old ones hide nothing
  status_.refused_messages = refused;
  status_.detail = with_note(status_.detail, standing_note_);
  publisher_.publish(status_);
}

int run_process(int argc, char** argv, const ProgramInfo& info, const std::function<int(Process&)>& body,
                const std::function<void(CommandLine&)>& more_options) {
  ProcessOptions options;
  CommandLine line(info.program, info.description);
  add_process_options(line, options);
  if (more_options) more_options(line);
  line.example(info.program + " --robot single_leg --session 1 --clock lockstep");
  line.action([&] { return run(info, options, body); });
  return line.run(argc, argv);
}

}  // namespace sprung
