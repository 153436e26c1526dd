#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/operate/client/operator_client.h"
#include "tools/operate/commands/answers.h"

namespace sprung::commands {
namespace {

constexpr double kHoldAnswer_s = 3.0;
constexpr double kEnabledFor_s = 0.5;  // [design choice] four renewals may be lost
constexpr double kEnableAgain_s = 0.1;

int run_hold(const std::string& instance) {
  const RunInfo info = require_running(instance, "");
  if (!info.maintenance) {
    std::fprintf(
        stderr,
        "sprung hold: %s is not in maintenance mode, which needs no hold; sprung up %s --maintenance\n",
        info.robot.c_str(), info.robot.c_str());
    return kExitFailed;
  }
  OperatorClient client(info);
  std::printf("hold: the robot may move while this command runs; Ctrl-C lets go\n");
  std::fflush(stdout);
  while (!stop_requested()) {
    OperatorCommand enable;
    enable.kind = OperatorKind::kEnable;
    enable.hold_s = kEnabledFor_s;
    const auto answer = client.send(enable, kHoldAnswer_s);
    if (!answer || answer->outcome == OperatorOutcome::kRefused) {
      report_answer("hold", answer);
      return kExitFailed;
    }
    std::this_thread::sleep_for(std::chrono::duration<double>(kEnableAgain_s));
  }
  std::printf("hold: let go; what moved stops, a rise is damped, then off\n");
  return kExitDone;
}

}  // namespace

void add_hold(CommandLine& sprung) {
  const auto instance = std::make_shared<std::string>("default");
  CommandLine& hold = sprung.subcommand(
      "hold", "Maintenance mode: the robot may move while this runs; when it ends, what moves stops.");
  hold.option("--instance", *instance, "which run");
  hold.example("sprung hold");
  hold.action([=] { return run_hold(*instance); });
}

}  // namespace sprung::commands
