#include <poll.h>

#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>

#include "runtime/stop_request.h"
#include "tools/commands/commands.h"
#include "tools/launcher/child_process.h"
#include "tools/launcher/run_file.h"

namespace sprung::commands {

namespace {

constexpr double kPatience_s = 3.0;

int run_record(const std::string& instance, const std::string& path) {
  const RunInfo info = require_running(instance, "");
  const std::string file =
      path.empty() ? info.robot + "-" + std::to_string(std::time(nullptr)) + ".lcm" : path;
  ChildProcess logger(system_program("lcm-logger", "liblcm-bin"),
                      {"--lcm-url=" + info.lcm_url, "-q", "-f", file});
  std::printf("recording %s with lcm-logger; Ctrl-C ends it\n", file.c_str());
  std::fflush(stdout);
  while (!stop_requested() && !logger.ended() && read_run_file(instance)) {
    poll(nullptr, 0, 50);
  }
  const bool died = logger.ended().has_value();
  logger.stop(kPatience_s);
  if (died) {
    std::fprintf(stderr, "lcm-logger ended by itself: check that %s can be written\n", file.c_str());
    return kExitFailed;
  }
  std::printf("recorded %s, %lld bytes\n", file.c_str(),
              static_cast<long long>(std::filesystem::file_size(file)));
  return kExitDone;
}

}  // namespace

void add_record(CommandLine& sprung) {
  const auto instance = std::make_shared<std::string>("default");
  const auto path = std::make_shared<std::string>();
  CommandLine& record =
      sprung.subcommand("record", "Record every channel of the running robot with LCM's own lcm-logger.");
  record.option("file", *path, "LCM log to write, default ROBOT-TIME.lcm");
  record.option("--instance", *instance, "which run");
  record.example("sprung record jump.lcm");
  record.action([=] { return run_record(*instance, *path); });
}

}  // namespace sprung::commands
