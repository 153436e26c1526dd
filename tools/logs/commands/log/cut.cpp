#include <memory>

#include "tools/logs/commands/log/log_commands.h"

namespace sprung::commands {

namespace {

struct PartRequest {
  std::string log;
  std::string from;
  std::string to;
  std::vector<std::string> keep;
  std::vector<std::string> drop;
  std::string out;
};

int run_part(const PartRequest& request, const char* ending) {
  const std::string out = request.out.empty() ? beside(request.log, ending) : request.out;
  const log::TimeSpan span = or_wrong_use([&] { return log::parse_span(request.from, request.to); });
  log::ChannelFilter channels = or_wrong_use([&] { return log::ChannelFilter(request.keep, request.drop); });
  log::Reader reader(request.log);
  or_wrong_use([&] { log::refuse_same_file({request.log}, out); });
  log::Writer writer(out);
  const log::RewriteResult result = log::copy_part(reader, span, channels, writer, progress_line("copy"));
  return tell_rewrite(request.log, out, result);
}

void add_options(CommandLine& line, PartRequest& request) {
  line.option("log", request.log, "LCM log", Need::kRequired);
  line.option("--from", request.from,
              "seconds of the robot's time since the log's begin; -5: before its end; 2026-11-21T20:00:00Z "
              "or @unix time: "
              "when it was received");
  line.option("--to", request.to, "likewise; that moment itself is left out");
  line.option("--channels", request.keep, "which: NAME, GLOB_* or /regular expression/; may be repeated");
  line.option("--drop", request.drop, "which not; may be repeated, wins");
  line.option("-o,--output", request.out, "log to write; default: named after the old one, in this folder");
}

}  // namespace

void add_log_cut(CommandLine& log) {
  const auto request = std::make_shared<PartRequest>();
  CommandLine& cut = log.subcommand("cut", "A stretch of time out of a log, as a new log.");
  add_options(cut, *request);
  cut.example("sprung log cut logs/pegasus.lcm --from 12.5 --to 14 -o stumble.lcm");
  cut.action([=] {
    if (request->from.empty() && request->to.empty()) throw WrongUse("from when to when? Add --from or --to");
    return run_part(*request, "-cut.lcm");
  });
  CommandLine& filter = log.subcommand("filter", "Some channels of a log, as a new log.");
  add_options(filter, *request);
  filter.example("sprung log filter logs/pegasus.lcm --channels '*_STATE' --drop CAN_TRACE -o states.lcm");
  filter.action([=] {
    if (request->keep.empty() && request->drop.empty())
      throw WrongUse("which channels? Add --channels or --drop");
    return run_part(*request, "-filtered.lcm");
  });
}

}  // namespace sprung::commands
