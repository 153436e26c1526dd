#include "tools/operate/launcher/recorder_plan.h"

#include <filesystem>
#include <stdexcept>

namespace sprung {

void check_recording(const std::string& recorder, const RecordingRequest& recording) {
  if (recorder != kLcmLogger) return;
  const RecordingRequest usual;
  if (recording.channels != usual.channels || recording.splits() ||
      recording.least_free_MB != usual.least_free_MB || recording.keep_MB != usual.keep_MB)
    throw std::invalid_argument(
        "--channels, --split-mb, --split-min, --min-free-mb and --keep-mb are sprung-recorder's: leave out "
        "--with lcm-logger");
}

namespace {

void add_recording(std::vector<std::string>& arguments, const RecordingRequest& recording) {
  arguments.insert(arguments.end(), {"--channels", recording.channels,                    //
                                     "--split-mb", std::to_string(recording.split_MB),    //
                                     "--split-min", std::to_string(recording.split_min),  //
                                     "--min-free-mb", std::to_string(recording.least_free_MB), "--keep-mb",
                                     std::to_string(recording.keep_MB)});
}

}  // namespace

PlannedProcess plan_recorder(const LaunchRequest& request, const RobotConfig& robot, const RunInfo& info) {
  if (request.recorder == kLcmLogger) {
    check_recording(request.recorder, request.recording);
    return {kLcmLogger, {"--lcm-url=" + request.lcm_url, "-q", "-f", info.log}, RestartPolicy::kNever};
  }
  PlannedProcess process{kRecorderProgram, {}, RestartPolicy::kNever};
  process.arguments = {"--robot",    robot.folder,
                       "--preset",   robot.preset(request.preset).name,
                       "--session",  std::to_string(info.session),
                       "--epoch-us", std::to_string(info.epoch_us),
                       "--lcm-url",  request.lcm_url,
                       "--clock",    request.clock,
                       "--file",     info.log};
  if (!request.command_line.empty())
    process.arguments.insert(process.arguments.end(), {"--command-line", request.command_line});
  if (request.simulation || request.simulated_elsewhere) process.arguments.push_back("--simulation");
  if (request.maintenance) process.arguments.push_back("--maintenance");
  add_recording(process.arguments, request.recording);
  return process;
}

std::string first_file(const std::string& log, const RecordingRequest& recording) {
  if (!recording.splits()) return log;
  const std::filesystem::path path(log);
  return (path.parent_path() / (path.stem().string() + "-000" + path.extension().string())).string();
}

bool says_status(const PlannedProcess& planned) { return planned.program != kLcmLogger; }

}  // namespace sprung
