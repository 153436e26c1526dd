#include <cstdio>
#include <filesystem>
#include <memory>

#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/logs/log/reader.h"
#include "tools/station/play/log_page.h"

namespace sprung::commands {

namespace {

struct PlayLine {
  std::string log;
  std::string out;
};

int run_play(const PlayLine& line) {
  namespace fs = std::filesystem;
  const std::string out = line.out.empty() ? fs::path(line.log).stem().string() + ".html" : line.out;
  if (fs::path(out).extension() != ".html") throw WrongUse("-o " + out + ": its name ends in .html");
  log::Reader reader(line.log);
  const station::LogPage page = station::make_log_page(reader);
  report::write_text(page.html, out);
  for (const std::string& note : page.notes) std::printf("%s\n", note.c_str());
  std::printf("%s: open it in a browser\n", out.c_str());
  return kExitDone;
}

}  // namespace

void add_play(CommandLine& sprung) {
  const auto line = std::make_shared<PlayLine>();
  CommandLine& play = sprung.subcommand(
      "play",
      "A log as one page that shows the robot in 3-D, with forces, torques, plots and a time slider.");
  play.option("log", line->log, "LCM log", Need::kRequired);
  play.option("-o,--output", line->out, "x.html; default: named after the log, in this folder");
  play.example("sprung play logs/single_leg.lcm -o jump.html");
  play.action([=] { return run_play(*line); });
}

}  // namespace sprung::commands
