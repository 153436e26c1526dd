#include <cstdio>
#include <filesystem>
#include <memory>

#include "tools/common/report/report_shell.h"
#include "tools/logs/commands/log/log_commands.h"
#include "tools/logs/log/log_plot.h"
#include "tools/logs/log/picture_file.h"

namespace sprung::commands {

namespace {

struct PlotLine {
  std::string log;
  log::PlotRequest plot;
  std::string from, to;
  int width_px = 1200;
  std::string out;
};

std::string command_of(const PlotLine& line) {
  std::string out = "sprung log plot " + line.log;
  for (const std::string& field : line.plot.fields) out += " --fields '" + field + "'";
  if (!line.from.empty()) out += " --from " + line.from;
  if (!line.to.empty()) out += " --to " + line.to;
  return out;
}

void write_plot(const PlotLine& line, const log::LogPlot& plot, const std::string& path) {
  const std::string kind = std::filesystem::path(path).extension().string();
  const report::Report page = log::plot_report(plot, command_of(line));
  if (kind == ".html") return report::write_report(page, path);
  constexpr int kTitle_px = 90, kPlot_px = 380;
  log::write_png(path, report::to_html(page), line.width_px,
                 kTitle_px + kPlot_px * static_cast<int>(plot.plots.size()));
}

int run_plot(PlotLine line) {
  constexpr int kLeastWidth_px = 600, kMostWidth_px = 8000;
  const std::string path = line.out.empty() ? beside(line.log, ".html") : line.out;
  const std::string kind = std::filesystem::path(path).extension().string();
  if (kind == ".svg")
    throw WrongUse("-o " + path +
                   ": SVG is no longer written; .html can be zoomed and printed, .png is a picture");
  if (kind != ".html" && kind != ".png") throw WrongUse("-o " + path + ": its name ends in .html or .png");
  if (line.plot.fields.empty())
    throw WrongUse("what is to be drawn? For example --fields 'JOINT_STATE.joints[*].gear_output_torque_Nm'");
  if (line.width_px < kLeastWidth_px || line.width_px > kMostWidth_px)
    throw WrongUse("--width is 600 to 8000");
  line.plot.span = or_wrong_use([&] { return log::parse_span(line.from, line.to); });
  if (line.plot.phases == "none") line.plot.phases.clear();
  log::Reader reader(line.log);
  line.plot.names = names_or_told(reader).lists;
  const log::LogPlot plot = or_wrong_use(
      [&] { return log::collect_plot(reader, line.plot, progress_line("plot")); });
  tell_unmatched(line.log, plot.unmatched);
  write_plot(line, plot, path);
  std::printf("%s\n", path.c_str());
  return kExitDone;
}

}  // namespace

void add_log_plot(CommandLine& log) {
  const auto line = std::make_shared<PlotLine>();
  CommandLine& plot = log.subcommand(
      "plot", "Fields of a log over time, one plot for each unit, phases shaded: HTML to zoom into, or PNG.");
  plot.option("log", line->log, "LCM log", Need::kRequired);
  plot.option("--fields", line->plot.fields,
              "CHANNEL.path, with stars, indices or names: JOINT_STATE.joints[knee].gear_output_torque_Nm; "
              "may be repeated");
  plot.option("--phases", line->plot.phases,
              "field whose values shade the plots, e.g. MOTION_STATE.legs[0].phase; none = no shades");
  plot.option("--from", line->from, "seconds since the log's begin, and the other ways of sprung log cut");
  plot.option("--to", line->to, "likewise");
  plot.option("--width", line->width_px, "of the picture, px; not for HTML");
  plot.option("-o,--output", line->out, "x.html or x.png; default: HTML named after the log, in this folder");
  plot.example(
      "sprung log plot logs/single_leg.lcm --fields 'JOINT_STATE.joints[*].gear_output_torque_Nm' --phases "
      "'MOTION_STATE.legs[0].phase' -o torques.html");
  plot.action([=] { return run_plot(*line); });
}

}  // namespace sprung::commands
