#include <poll.h>

#include <cstdio>
#include <ctime>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/stop_request.h"
#include "tools/commands/commands.h"
#include "tools/launcher/child_process.h"
#include "tools/launcher/recorder_plan.h"
#include "tools/launcher/run_file.h"

namespace sprung::commands {

namespace {

constexpr double kPatience_s = 10.0;  ///< a disk that is slow must still get everything

struct RecordRequest {
  std::string file;
  std::string instance = "default";
  std::string recorder = kRecorderProgram;
  std::string channels = ".*";
  double split_MB = 0.0;
  double split_min = 0.0;
  double least_free_MB = 500.0;
};

std::string command_line(const RecordRequest& request, const std::string& file) {
  return "sprung record " + file + " --instance " + request.instance;
}

PlannedProcess recorder_of(const RecordRequest& request, RunInfo info) {
  if (!request.file.empty()) {
    info.log = request.file;
  } else {
    info.log = info.robot + "-" + std::to_string(std::time(nullptr)) + ".lcm";
  }
  LaunchRequest launch;
  launch.preset = info.preset;
  launch.clock = info.clock;
  launch.simulation = info.simulation;
  launch.lcm_url = info.lcm_url;
  launch.recorder = request.recorder;
  launch.command_line = command_line(request, info.log);
  PlannedProcess planned = plan_recorder(launch, load_robot(info.robot_folder), info);
  if (request.recorder == kRecorderProgram)
    planned.arguments.insert(planned.arguments.end(),
                             {"--channels", request.channels,                    //
                              "--split-mb", std::to_string(request.split_MB),    //
                              "--split-min", std::to_string(request.split_min),  //
                              "--min-free-mb", std::to_string(request.least_free_MB)});
  return planned;
}

int run_record(const RecordRequest& request) {
  const RunInfo info = require_running(request.instance, "");
  const PlannedProcess planned = recorder_of(request, info);
  const bool own = request.recorder == kRecorderProgram;
  ChildProcess recorder(
      own ? program_folder() + "/" + kRecorderProgram : system_program(kLcmLogger, "liblcm-bin"),
      planned.arguments);
  std::printf("recording %s with %s; Ctrl-C ends it\n", info.robot.c_str(), request.recorder.c_str());
  std::fflush(stdout);
  while (!stop_requested() && !recorder.ended() && read_run_file(request.instance)) poll(nullptr, 0, 50);
  const bool died = recorder.ended().has_value();
  const int status = recorder.stop(kPatience_s);
  if (own) return status;  // it has said all
  if (died) std::fprintf(stderr, "lcm-logger ended by itself: can it write its file?\n");
  return died ? kExitFailed : kExitDone;
}

}  // namespace

void add_record(CommandLine& sprung) {
  const auto r = std::make_shared<RecordRequest>();
  CommandLine& record =
      sprung.subcommand("record", "Record every channel of the running robot into an LCM log.");
  record.option("file", r->file, "LCM log to write, default ROBOT-TIME.lcm");
  record.option("--instance", r->instance, "which run");
  record.choice("--with", r->recorder, {kRecorderProgram, kLcmLogger}, "what writes the log");
  record.option("--channels", r->channels, "regular expression, as LCM's");
  record.option("--split-mb", r->split_MB, "begin another file at this size, MB; 0 = never");
  record.option("--split-min", r->split_min, "begin another file after this time, minutes; 0 = never");
  record.option("--min-free-mb", r->least_free_MB,
                "end before the disk has less than this left, MB; 0 = never");
  record.example("sprung record jump.lcm");
  record.action([=] { return run_record(*r); });
}

}  // namespace sprung::commands
