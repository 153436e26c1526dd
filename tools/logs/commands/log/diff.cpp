#include <cstdio>
#include <limits>
#include <memory>

#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/commands/replay.h"
#include "tools/logs/replay/difference_report.h"

namespace sprung::commands {

namespace {

struct DiffOptions {
  DiffRequest request;
  double duration_s = 0.0;
  std::string html;
};

}  // namespace

int run_diff(DiffRequest request, const std::string& html) {
  request.courses = !html.empty();
  const DiffResult result = or_wrong_use([&] {
    ProgressBar bar("diff, MB");
    return diff_logs(request, [&bar](std::uint64_t done, std::uint64_t all) {
      bar.show(done / 1'000'000, all / 1'000'000);
    });
  });
  std::printf("%s", diff_text(request, result).c_str());
  if (!html.empty())
    report::write_report(
        diff_page(request, result, "sprung log diff " + request.first + " " + request.second), html);
  return result.identical() ? kExitDone : kExitFailed;
}

void add_log_diff(CommandLine& log) {
  const auto o = std::make_shared<DiffOptions>();
  CommandLine& diff = log.subcommand(
      "diff",
      "Compare two logs field by field, cycle by cycle: the first difference, the largest, their course.");
  diff.option("first", o->request.first, "LCM log", Need::kRequired);
  diff.option("second", o->request.second, "LCM log", Need::kRequired);
  diff.option(
      "--channels", o->request.channels,
      "which: NAME, GLOB_* or /regular expression/; may be repeated; default: those with one message a "
      "cycle");
  diff.option("--start", o->request.from_s, "seconds of the robot's time since the begin of each log");
  diff.option("--duration", o->duration_s, "seconds; 0 = to the end");
  diff.option("--html", o->html, "a page with tables and plots of the differences");
  diff.example("sprung log diff logs/before.lcm logs/after.lcm --html diff.html");
  diff.action([=] {
    if (o->duration_s > 0.0) o->request.to_s = o->request.from_s + o->duration_s;
    return run_diff(o->request, o->html);
  });
}

}  // namespace sprung::commands
