#include "tools/lab/campaign/campaign.h"

#include <chrono>
#include <cstdio>
#include <memory>

#include "robots/robot_loader.h"
#include "runtime/log.h"
#include "tools/commands.h"
#include "tools/common/progress_bar.h"
#include "tools/common/report/report_shell.h"
#include "tools/lab/campaign/separate.h"

namespace sprung::commands {
namespace {

using namespace campaign;

struct CampaignOptions {
  std::string robot = "pegasus";
  std::string only, out;
  Request request;
  int separate = 0;  ///< runs by real processes
  bool as_json = false, no_twins = false;
};

report::Report page_of(const Result& result, const RobotConfig& robot, const ExperimentReport& rows,
                       const CampaignOptions& options) {
  report::Report page{"Campaign of " + robot.name,
                      "seed " + std::to_string(options.request.seed) + ", preset " + rows.preset,
                      campaign_command(options.robot, options.request.seed, options.request.first,
                                       options.request.runs, options.request.only)};
  report::Table table{"", {"row", "unit", "value"}};
  for (const ReportRow& row : rows.rows)
    table.rows.push_back({row.name, row.unit,
                          report::Cell(row.value, !row.low && !row.high ? report::Mark::kPlain
                                                  : row.ok()            ? report::Mark::kGood
                                                                        : report::Mark::kBad)});
  report::Section summary{"Summary"};
  summary.tables = {table};
  page.sections = campaign_sections(result, robot, options.robot);
  page.sections.insert(page.sections.begin(), summary);
  return page;
}

void print_failures(const Result& result, const RobotConfig& robot, const std::string& asked_robot) {
  for (const Verdict& one : result.runs)
    if (bad(one)) std::printf("%s\n", failure_text(one, robot, asked_robot).c_str());
  for (const Verdict& one : result.twins)
    if (bad_twin(one)) std::printf("without a fault: %s\n", failure_text(one, robot, asked_robot).c_str());
}

void print_differences(const std::vector<SeparateRun>& runs, const std::string& asked_robot) {
  for (const SeparateRun& one : runs) {
    if (one.same()) continue;
    const std::string why = one.failure.empty()
                                ? "differs first in cycle " + std::to_string(one.first_difference)
                                : one.failure;
    const Draw& draw = one.draw;
    std::printf("run %llu by real processes: %s\n  %s --separate 1\n",
                static_cast<unsigned long long>(draw.number), why.c_str(),
                campaign_command(asked_robot, draw.seed, draw.number, 1, draw.only).c_str());
  }
}

std::vector<SeparateRun> separately(const Result& result, const RobotConfig& robot,
                                    const CampaignOptions& options) {
  std::vector<Draw> draws;
  for (const Verdict& one : result.runs) draws.push_back(one.draw);
  return run_separately(robot, options.request.preset, draws, options.separate);
}

void refuse_homing(const RobotConfig& robot) {
  for (const ActuatorConfig& actuator : robot.actuators)
    if (actuator.reference.method != ReferenceMethod::kNone)
      throw WrongUse("--separate: " + robot.name + " has to be homed (" + actuator.name +
                     "), which no script of commands at fixed cycles can do");
}

int run(CampaignOptions options) {
  start_log("sprung");
  const auto started = std::chrono::steady_clock::now();
  const RobotConfig robot = load_robot(options.robot);
  if (options.separate > 0) refuse_homing(robot);
  Request& request = options.request;
  request.preset = preset_or(robot, "best");
  request.twins = !options.no_twins;
  if (!options.only.empty()) request.only = value_named<Class>(options.only).value_or(Class::kNone);
  const Result result = with_progress("campaign", [&](ProgressBar& bar) {
    request.parallel.on_progress = [&bar](std::size_t done, std::size_t count) { bar.show(done, count); };
    return run_campaign(robot, request);
  });
  ExperimentReport report;
  report.experiment = "campaign";
  report.robot = robot.name;
  report.preset = request.preset;
  report.seed = request.seed;
  report.rows = campaign_rows(result);
  const std::vector<SeparateRun> separate = separately(result, robot, options);
  if (options.separate > 0)
    for (const ReportRow& one : separate_rows(separate)) report.rows.push_back(one);
  for (const auto* all : {&result.runs, &result.twins})
    for (const Verdict& one : *all) report.simulated_s += one.simulated_s;
  report.wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  if (!options.out.empty()) report::write_report(page_of(result, robot, report, options), options.out);
  if (options.as_json) {
    std::printf("%s\n", report.json().c_str());
  } else {
    print_failures(result, robot, options.robot);
    print_differences(separate, options.robot);
    std::printf("%s\n", report.table().c_str());
  }
  return report.ok() ? kExitDone : kExitFailed;
}

}  // namespace

void add_campaign(CommandLine& sprung) {
  const auto options = std::make_shared<CampaignOptions>();
  CommandLine& line = sprung.subcommand(
      "campaign", "Robots in drawn states with drawn faults, judged by the simulation's truth.");
  line.option("--robot", options->robot, "name or folder");
  line.option("--runs", options->request.runs, "each with a twin in which nothing goes wrong");
  line.option("--seed", options->request.seed, "of every draw");
  line.option("--first", options->request.first, "number of the first run");
  line.option("--jobs", options->request.parallel.jobs, "threads; 0: one for each core");
  std::vector<std::string> classes = names_of<Class>();
  classes[0] = "";
  line.choice("--only", options->only, classes, "faults of this class alone");
  line.flag("--no-twins", options->no_twins,
            "in half of the time, without asking whether a healthy robot is stopped");
  line.option("--separate", options->separate,
              "so many of the runs, where drives or buses go wrong, also by real processes, bit for bit");
  line.option("--out", options->out,
              "HTML file with distributions and every run that is not as it should be");
  line.flag("--json", options->as_json, "one JSON object on standard output");
  line.example("sprung campaign --robot pegasus --runs 1000 --seed 1 --out campaign.html");
  line.action([=] {
    if (options->request.runs < 1 || options->request.parallel.jobs < 0 || options->separate < 0)
      throw WrongUse("--runs is at least 1, --jobs and --separate at least 0");
    return run(*options);
  });
}

}  // namespace sprung::commands
