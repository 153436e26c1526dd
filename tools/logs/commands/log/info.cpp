#include <cstdio>
#include <memory>

#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/log/info_text.h"

namespace sprung::commands {

namespace {

struct InfoRequest {
  std::vector<std::string> logs;
  bool every_incident = false;
  bool as_json = false;
};

int run_info(const InfoRequest& request) {
  bool first = true;
  int status = kExitDone;
  for (const std::string& path : request.logs) {
    log::Reader reader(path);
    const std::vector<std::string> legs = names_or_told(reader).legs;
    const log::LogInfo info = log::collect_info(reader, legs, progress_line("info"));
    const std::string text = request.as_json ? log::info_json(info) + "\n"
                                             : log::info_text(info, {request.every_incident});
    std::printf("%s%s", first || request.as_json ? "" : "\n", text.c_str());
    first = false;
    if (info.events > 0 || info.damages == 0) continue;
    tell_no_event(path);
    status = kExitFailed;
  }
  return status;
}

}  // namespace

void add_log_info(CommandLine& log) {
  const auto request = std::make_shared<InfoRequest>();
  CommandLine& info = log.subcommand(
      "info", "What a log holds: channels, rates, cycles that are missing, who made it, what happened.");
  info.option("log", request->logs, "LCM logs", Need::kRequired);
  info.flag("--events", request->every_incident,
            "everything that happened, also what befell each leg in a gait");
  info.flag("--json", request->as_json, "one JSON object for each log on standard output");
  info.example("sprung log info logs/pegasus.lcm --events");
  info.action([=] { return run_info(*request); });
}

}  // namespace sprung::commands
