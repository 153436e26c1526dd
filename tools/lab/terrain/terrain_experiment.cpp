#include "tools/lab/terrain/terrain_experiment.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "simulation/plant/world.h"
#include "tools/lab/gait/walking_robot.h"
#include "tools/lab/run/drawn_plants.h"
#include "tools/lab/terrain/terrain_levels.h"

namespace sprung {
namespace {

constexpr int kTriedDraws = 10, kMustPass = 8;
constexpr std::uint64_t kFirstDraw = 1001;  // of seed 0: beyond those that gaits are tuned and judged on
constexpr double kLeastDistance_m = 1.0, kMostDistance_m = 100.0;  // shorter ends before the ramp begins
constexpr double kAskedShare = 7.0 / 8.0;                          // of the gait's fastest

report::Cell linked(const std::string& text, const std::string& page) {
  report::Cell out(text);
  out.link = page;
  return out;
}

constexpr const char* kAll = "all";
constexpr const char* kPayloadTask = "payload";  // of terrain_tasks()

struct Options {
  std::string only = kAll;  ///< task
  std::string gait;         ///< empty: all that go forward
  std::string world;        ///< name or file: it alone instead of the tasks
  double distance_m = 3.0;
  double level = kNaN;     ///< alone, without search
  int runs = kTriedDraws;  ///< of each level
};

std::vector<std::string> task_names() {
  std::vector<std::string> out{kAll};
  for (const TerrainTask& task : terrain_tasks()) out.push_back(task.name);
  return out;
}

std::vector<SimOptions> plants_of(const ExperimentInput& in, int runs) {
  SimOptions first = in.sim;
  first.plant.emplace("draw", static_cast<double>(kFirstDraw + in.sim.seed * kTriedDraws));
  return drawn_plants(first, runs);
}

TerrainRun walk_one(const ExperimentInput& in, const TerrainTask& task, const GaitConfig& gait, int level,
                    const SimOptions& plant, const Options& options) {
  TerrainRun asked;
  asked.gait = gait.name;
  asked.speed_m_s = kAskedShare * gait.fastest_forward_m_s;
  asked.distance_m = options.distance_m;
  return walk_terrain(in.robot, in.preset, plant, task, task.levels[static_cast<std::size_t>(level)], asked);
}

TerrainOutcome::Tried try_level(const ExperimentInput& in, const TerrainTask& task, const GaitConfig& gait,
                                int level, const Options& options) {
  const std::vector<SimOptions> plants = plants_of(in, options.runs);
  TerrainOutcome::Tried out;
  out.level = level;
  out.runs = parallel_map(
      plants.size(), [&](std::size_t i) { return walk_one(in, task, gait, level, plants[i], options); },
      in.parallel);
  return out;
}

/// Of all who did not pass.
void add_pages(const ExperimentInput& in, const GaitConfig& gait, const Options& options,
               TerrainOutcome& outcome) {
  struct Failure {
    int level;
    std::size_t plant;
    TerrainRun* run;
  };
  std::vector<Failure> failures;
  for (TerrainOutcome::Tried& tried : outcome.tried)
    for (std::size_t i = 0; i < tried.runs.size(); ++i)
      if (!tried.runs[i].passed()) failures.push_back({tried.level, i, &tried.runs[i]});
  const std::vector<SimOptions> plants = plants_of(in, options.runs);
  const auto make_page = [&](std::size_t i) {
    const Failure& failure = failures[i];
    const auto again = [&] {
      (void)walk_one(in, *outcome.task, gait, failure.level, plants[failure.plant], options);
    };
    try {
      failure.run->page = in.play_page(terrain_page_name(outcome, failure.level, failure.run->draw), again);
    } catch (const std::runtime_error&) {
      failure.run->page.clear();  // rows are worth more than a page of one of them
    }
  };
  run_parallel(failures.size(), make_page, in.parallel);
}

/// @throws std::invalid_argument for a level that the task has not.
int index_of(const TerrainTask& task, double level) {
  const auto at = std::find(task.levels.begin(), task.levels.end(), level);
  if (at != task.levels.end()) return static_cast<int>(at - task.levels.begin());
  std::string known;
  for (const double one : task.levels) known += (known.empty() ? "" : ", ") + report::number_text(one);
  throw std::invalid_argument("--level: " + task.name + " has " + known);
}

TerrainOutcome climb(const ExperimentInput& in, const TerrainTask& task, const GaitConfig& gait,
                     const Options& options) {
  TerrainOutcome out;
  out.task = &task;
  out.gait = gait.name;
  const auto passes = [&](int level) {
    out.tried.push_back(try_level(in, task, gait, level, options));
    return out.tried.back().passed() >= kMustPass * options.runs / static_cast<double>(kTriedDraws);
  };
  const int only = std::isfinite(options.level) ? index_of(task, options.level) : -1;
  if (only < 0)
    out.level = hardest_level(static_cast<int>(task.levels.size()), passes);
  else if (passes(only))
    out.level = only;
  return out;
}

std::vector<TerrainTask> wanted_tasks(const ExperimentInput& in, const Options& options) {
  if (!options.world.empty()) {
    if (options.only != kAll) throw std::invalid_argument("--world and --only: the one or the other");
    (void)sim::world_path(in.robot, options.world);
  }
  std::vector<TerrainTask> out;
  if (!options.world.empty()) out.push_back(world_task(options.world));
  for (const TerrainTask& task : terrain_tasks_of(in.robot))
    if (options.world.empty() && (options.only == kAll || options.only == task.name)) out.push_back(task);
  // Before anything runs.
  if (std::isfinite(options.level))
    for (const TerrainTask& task : out) (void)index_of(task, options.level);
  return out;
}

ExperimentOutput run_terrain(const ExperimentInput& in, const Options& options) {
  if (!(options.distance_m >= kLeastDistance_m && options.distance_m <= kMostDistance_m))
    throw std::invalid_argument("--distance: expected 1 to 100 m, found " +
                                report::number_text(options.distance_m));
  if (!(options.runs >= 1 && options.runs <= 1000))
    throw std::invalid_argument("--runs: expected 1 to 1000, found " + std::to_string(options.runs));
  ExperimentOutput out;
  for (const TerrainTask& task : wanted_tasks(in, options)) {
    for (const GaitConfig& gait : going_gaits(in.robot, options.gait)) {
      TerrainOutcome outcome = climb(in, task, gait, options);
      if (in.play_page) add_pages(in, gait, options, outcome);
      out.rows.push_back(terrain_row(outcome));
      if (task.name == kPayloadTask)
        for (ReportRow& row : payload_rows(outcome)) out.rows.push_back(std::move(row));
      out.sections.push_back(terrain_section(outcome, [&](double level, double draw) {
        return terrain_repeat(in.common_words, outcome, level, draw, options.distance_m);
      }));
      for (const TerrainOutcome::Tried& tried : outcome.tried)
        for (const TerrainRun& run : tried.runs) out.simulated_s += run.simulated_s;
    }
  }
  return out;
}

}  // namespace

int TerrainOutcome::Tried::passed() const {
  return static_cast<int>(
      std::count_if(runs.begin(), runs.end(), [](const TerrainRun& run) { return run.passed(); }));
}

ReportRow terrain_row(const TerrainOutcome& outcome) {
  const TerrainTask& task = *outcome.task;
  const double level = outcome.level < 0 ? kNaN : task.levels[static_cast<std::size_t>(outcome.level)];
  const std::string name = "terrain." + task.name + "." + outcome.gait + ".level";
  const auto wanted = task.wanted.find(outcome.gait);
  if (wanted == task.wanted.end()) return row(name, task.unit, level);
  const bool grows = task.levels.back() > task.levels.front();
  return row(name, task.unit, level, grows ? at_least(wanted->second) : at_most(wanted->second));
}

std::vector<ReportRow> payload_rows(const TerrainOutcome& outcome) {
  struct Figure {
    const char* name;
    const char* unit;
    double scale;
    double TerrainRun::*of;
  };
  constexpr Figure kFigures[] = {{"stood_mass_off", "kg", 1.0, &TerrainRun::stood_mass_off_kg},
                                 {"stood_com_off", "mm", 1e3, &TerrainRun::stood_com_off_m},
                                 {"walked_mass_off", "kg", 1.0, &TerrainRun::walked_mass_off_kg},
                                 {"walked_com_off", "mm", 1e3, &TerrainRun::walked_com_off_m}};
  std::vector<ReportRow> out;
  const auto hardest = std::find_if(outcome.tried.begin(), outcome.tried.end(),
                                    [&](const auto& tried) { return tried.level == outcome.level; });
  if (hardest == outcome.tried.end()) return out;
  for (const Figure& figure : kFigures) {
    double worst = kNaN;
    for (const TerrainRun& run : hardest->runs) worst = std::fmax(worst, figure.scale * run.*figure.of);
    out.push_back(row("terrain.payload." + outcome.gait + "." + figure.name, figure.unit, worst));
  }
  return out;
}

std::string terrain_page_name(const TerrainOutcome& outcome, int level, double draw) {
  return "terrain." + outcome.task->name + "." + outcome.gait + "." +
         report::number_text(outcome.task->levels[static_cast<std::size_t>(level)]) + ".draw" +
         report::number_text(draw);
}

std::string terrain_repeat(const std::string& common_words, const TerrainOutcome& outcome, double level,
                           double draw, double distance_m) {
  const TerrainTask& task = *outcome.task;
  const std::string which = task.world.empty() ? " --only " + task.name : " --world " + task.world;
  return "sprung experiment --logs F terrain" + common_words + " --plant draw=" + report::number_text(draw) +
         which + " --gait " + outcome.gait + " --level " + report::number_text(level) + " --distance " +
         report::number_text(distance_m) + " --runs 1; sprung play F/*.lcm";
}

report::Section terrain_section(const TerrainOutcome& outcome, const HowToSee& how_to_see) {
  report::Section out{outcome.task->what + ", " + outcome.gait};
  const std::string level_head = "level (" + outcome.task->unit + ")";
  report::Table tried_levels{"Levels tried", {level_head, "passed", "of"}};
  report::Table failures{"Who did not pass",
                         {level_head, "draw", "what became of it", "after (s)", "to see it"}};
  for (const TerrainOutcome::Tried& tried : outcome.tried) {
    const double level = outcome.task->levels[static_cast<std::size_t>(tried.level)];
    tried_levels.rows.push_back({level, tried.passed(), tried.runs.size()});
    for (const TerrainRun& run : tried.runs)
      if (!run.passed())
        failures.rows.push_back({level, run.draw, linked(run.why, run.page),
                                 run.vitals.fell ? run.vitals.fell_at_s : kNaN, how_to_see(level, run.draw)});
  }
  failures.note =
      "What became of it leads to a page that plays it, where there is a folder for pages (--out). Seconds "
      "of who fell, from standing up on. A log has some 4 MB a second.";
  out.tables = {tried_levels};
  if (!failures.rows.empty()) out.tables.push_back(failures);
  return out;
}

Experiment terrain_experiment() {
  const auto options = std::make_shared<Options>();
  Experiment out = gait_experiment("terrain",
                                   "Ramps, hills, stairs, slippery floors and payloads, harder and harder.",
                                   "Where does the robot walk?");
  out.seed_help = "which ten drawn plants it is tried on, and their noise; 0 was used for tuning";
  out.out_note = ", and a page of half a megabyte a second of each run that did not pass, which plays it";
  out.in_all = {};  // all tasks and gaits take longer than everything else there
  out.draws_plants = true;
  out.own.choice("--only", options->only, task_names(), "which tasks");
  out.own.option("--gait", options->gait, "one alone; default: all that go forward");
  out.own.option("--world", options->world,
                 "one of robots/worlds, or a file like them, instead of the tasks: how much of its heights");
  out.own.option("--level", options->level, "this one alone, without search");
  out.own.option("--runs", options->runs, "drawn plants for each level; eight of ten must pass");
  out.own.option("--distance", options->distance_m, "m, of each run; ramps and hills begin 0.8 m ahead");
  out.run = [options](const ExperimentInput& in) { return run_terrain(in, *options); };
  return out;
}

}  // namespace sprung
