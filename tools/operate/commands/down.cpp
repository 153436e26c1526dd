#include <poll.h>
#include <signal.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <stdexcept>

#include "runtime/stop_request.h"
#include "tools/commands.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

constexpr int kShutdown_ms = 60'000;  // every process may need its three seconds, the recorder ten, a
                                      // lock-step bridge more

int run_down(const std::string& instance) {
  const RunInfo info = require_running(instance, "");
  if (kill(static_cast<pid_t>(info.launcher_pid), SIGTERM) != 0 && errno == EPERM)
    throw std::runtime_error(
        "robot " + info.robot +
        " was started by another user: sudo --preserve-env sprung down, or for a service: "
        "systemctl stop sprung@" +
        info.robot);
  for (int waited_ms = 0; waited_ms < kShutdown_ms && !stop_requested(); waited_ms += 20) {
    if (!read_run_file(instance)) {
      std::printf("%s is down\n", info.robot.c_str());
      return kExitDone;
    }
    poll(nullptr, 0, 20);
  }
  std::fprintf(stderr,
               "%s is still up: process %lld does not end. Press the emergency stop, then: kill -9 %lld\n",
               info.robot.c_str(), static_cast<long long>(info.launcher_pid),
               static_cast<long long>(info.launcher_pid));
  return kExitFailed;
}

}  // namespace

void add_down(CommandLine& sprung) {
  const auto instance = std::make_shared<std::string>("default");
  CommandLine& down = sprung.subcommand("down",
                                        "Bring the drives to rest and stop every process, recorder last.");
  down.option("--instance", *instance, "which run");
  down.example("sprung down");
  down.action([=] { return run_down(*instance); });
}

}  // namespace sprung::commands
