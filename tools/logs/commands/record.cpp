#include <poll.h>

#include <cstdio>
#include <ctime>
#include <memory>
#include <stdexcept>

#include "robots/robot_loader.h"
#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/logs/commands/recording_options.h"
#include "tools/operate/launcher/child_process.h"
#include "tools/operate/launcher/recorder_plan.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

constexpr double kTimeout_s = 10.0;  ///< a disk that is slow must still get everything

struct RecordRequest {
  std::string file;
  std::string instance = "default";
  std::string recorder = kRecorderProgram;
  RecordingRequest recording;
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
  launch.recording = request.recording;
  launch.command_line = command_line(request, info.log);
  return plan_recorder(launch, load_robot(info.robot_folder), info);
}

void refuse_contradictions(const RecordRequest& request) {
  try {
    check_recording(request.recorder, request.recording);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
}

int run_record(const RecordRequest& request) {
  refuse_contradictions(request);
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
  const int status = recorder.stop(kTimeout_s);
  if (own) return status;  // it has said all
  if (died) std::fprintf(stderr, "lcm-logger ended by itself: can it write its file?\n");
  return died ? kExitFailed : kExitDone;
}

}  // namespace

void add_record(CommandLine& sprung) {
  const auto r = std::make_shared<RecordRequest>();
  CommandLine& record = sprung.subcommand("record",
                                          "Record every channel of the running robot into an LCM log.");
  record.option("file", r->file, "LCM log to write, default ROBOT-TIME.lcm");
  record.option("--instance", r->instance, "which run");
  add_recording_options(record, r->recorder, r->recording);
  record.example("sprung record jump.lcm");
  record.action([=] { return run_record(*r); });
}

}  // namespace sprung::commands
