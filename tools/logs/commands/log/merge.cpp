#include <memory>

#include "tools/logs/commands/log/log_commands.h"

namespace sprung::commands {

namespace {

struct MergeRequest {
  std::vector<std::string> logs;
  std::string out = "merged.lcm";
};

int run_merge(const MergeRequest& request) {
  or_wrong_use([&] { log::refuse_same_file(request.logs, request.out); });
  for (const std::string& path : request.logs)
    log::Reader probe(path);  // all must be there before anything is written
  log::Writer writer(request.out);
  const log::RewriteResult result = log::merge(request.logs, writer, progress_line("merge"));
  return tell_rewrite(request.logs.front(), request.out, result);
}

}  // namespace

void add_log_merge(CommandLine& log) {
  const auto request = std::make_shared<MergeRequest>();
  CommandLine& merge = log.subcommand("merge",
                                      "Several logs as one, in the order in which messages were received.");
  merge.option("log", request->logs, "LCM logs, e.g. the parts of a recording that was split",
               Need::kRequired);
  merge.option("-o,--output", request->out, "log to write");
  merge.example("sprung log merge walk-000.lcm walk-001.lcm camera.lcm -o walk.lcm");
  merge.action([=] { return run_merge(*request); });
}

}  // namespace sprung::commands
