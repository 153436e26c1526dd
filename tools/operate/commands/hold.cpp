#include <cstdio>
#include <memory>
#include <string>

#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/operate/commands/answers.h"
#include "tools/operate/commands/held_motion.h"

namespace sprung::commands {
namespace {

int run_hold(const std::string& instance) {
  const RunInfo info = require_running(instance, "");
  if (!info.maintenance) {
    std::fprintf(stderr,
                 "sprung hold: %s is not in maintenance mode, which needs no hold; sprung up %s "
                 "--maintenance\n",
                 info.robot.c_str(), info.robot.c_str());
    return kExitFailed;
  }
  OperatorClient client(info);
  std::printf("hold: the robot may move while this command runs; Ctrl-C lets go\n");
  std::fflush(stdout);
  const std::optional<OperatorAnswer> last = keep_saying(OperatorKind::kEnable, client);
  if (!stop_requested()) {
    report_answer("hold", last);
    return kExitFailed;
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
