#include <cstdio>
#include <memory>
#include <string>

#include "tools/commands.h"
#include "tools/station/server/drive_by_shell.h"

namespace sprung::commands {

namespace {

struct DriveByRequest : station::DriveByOptions {
  std::string instance = "default";
};

int run_gamepad(const DriveByRequest& request) {
  const RunInfo info = require_running(request.instance, "");
  if (info.clock == "lockstep")
    throw WrongUse("in lock-step the robot's seconds are not the operator's: sprung walk instead");
  const auto tell = [](const std::string& line) {
    std::printf("drive-by: %s\n", line.c_str());
    std::fflush(stdout);
  };
  std::string why;
  try {
    why = station::drive_by_gamepad(info, request, tell);
  } catch (const std::invalid_argument& error) {
    throw WrongUse(error.what());
  }
  if (why.empty()) return kExitDone;
  std::fprintf(stderr, "drive-by: %s\n", why.c_str());
  return kExitFailed;
}

}  // namespace

void add_drive_by(CommandLine& sprung) {
  const auto request = std::make_shared<DriveByRequest>();
  CommandLine& drive_by = sprung.subcommand("drive-by", "Steer a robot that walks, without a browser.");
  drive_by.example("sprung drive-by gamepad --device /dev/input/event7");
  CommandLine& gamepad = drive_by.subcommand(
      "gamepad",
      "By a gamepad of this machine: locked until its sticks are at rest, and only while L1 or R1 is held.");
  gamepad.option("--device", request->device,
                 "/dev/input/event*, see /proc/bus/input/devices; or a file with its events",
                 Need::kRequired);
  gamepad.option("--gait", request->gait, "one of robot.yaml's; default: the fastest that steps");
  gamepad.option("--instance", request->instance, "which run");
  gamepad.example("sprung drive-by gamepad --device /dev/input/event7");
  gamepad.action([=] { return run_gamepad(*request); });
}

}  // namespace sprung::commands
