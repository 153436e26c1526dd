#include "tools/launcher/recorder_plan.h"

namespace sprung {

PlannedProcess plan_recorder(const LaunchRequest& request, const RobotConfig& robot, const RunInfo& info) {
  if (request.recorder == kLcmLogger)
    return {kLcmLogger, {"--lcm-url=" + request.lcm_url, "-q", "-f", info.log}, RestartPolicy::kNever};
  PlannedProcess process{kRecorderProgram, {}, RestartPolicy::kNever};
  process.arguments = {"--robot",    robot.folder,
                       "--preset",   request.preset,
                       "--session",  std::to_string(info.session),
                       "--epoch-us", std::to_string(info.epoch_us),
                       "--lcm-url",  request.lcm_url,
                       "--clock",    request.clock,
                       "--file",     info.log};
  if (!request.command_line.empty())
    process.arguments.insert(process.arguments.end(), {"--command-line", request.command_line});
  if (request.simulation) process.arguments.push_back("--simulation");
  return process;
}

bool says_status(const PlannedProcess& planned) { return planned.program != kLcmLogger; }

}  // namespace sprung
