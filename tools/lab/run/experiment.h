#pragma once
/// What every experiment is: a question, options of its own, and a run. From the table of them
/// (experiments.h) come the commands of `sprung experiment`, the runs of `all` and their pages.
#include <cstdint>
#include <functional>
#include <set>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "robots/robot_config.h"
#include "runtime/command_line.h"
#include "tools/common/parallel.h"
#include "tools/common/report/report.h"
#include "tools/lab/run/experiment_report.h"
#include "tools/lab/run/scripted_run.h"

namespace sprung {

/// Options that several experiments have; all have --robot, --seed and --json.
enum class Common { kPreset, kPlant, kJobs, kSeparate, kOut, kReport };

/// The values of these options.
struct ExperimentRequest {
  std::string robot = "single_leg";  ///< name or folder
  std::string preset;                ///< empty: Presets says
  std::uint64_t seed = 1;
  std::vector<std::string> set;  ///< KEY=VALUE: numbers of robot.yaml that are others (robots/robot_loader.h)
  std::vector<std::string> plant;  ///< KEY=VALUE
  int plants = 0;                  ///< above 0: on so many drawn plants (drawn_plants.h)
  std::string position_loop;       ///< "drive" or "host", of every actuator; empty: robot.yaml's
  int jobs = 0;                    ///< ParallelOptions::jobs
  bool separate = false;           ///< real processes over LCM instead of this one
  bool in_all = false;             ///< by `sprung experiment all`
  bool pages = false;              ///< figures and tables will be read
};

/// Runs something again that makes one robot in this thread, and writes a page that plays what became of it
/// beside the experiment's own. Threads may call it at once. @param name of the page, without ".html".
/// @return its file's name; empty: there was no robot. @throws std::runtime_error where it has no cycle.
using PlayPage = std::function<std::string(const std::string& name, const std::function<void()>& again)>;

/// What an experiment runs on, and how.
struct ExperimentInput {
  ExperimentRequest asked;
  RobotConfig robot;
  std::string preset;  ///< of this robot
  SimOptions sim;      ///< of --seed and --plant
  ScriptRunner run;    ///< as --separate says
  ParallelOptions parallel;
  PlayPage play_page;        ///< empty: there is no folder for pages
  std::string command;       ///< the line that makes it again
  std::string common_words;  ///< of it, each after a space: robot, preset, numbers, plant, loop, seed
};

/// Of experiments whose hands feel where the robot is in every cycle. @throws std::invalid_argument with
/// --separate.
void refuse_separate(const ExperimentInput& input);

struct ExperimentOutput {
  std::vector<ReportRow> rows;
  double simulated_s = 0.0;
  std::vector<report::Section> sections{};  ///< figures and tables; may be empty where nobody asked for pages
  std::string before{};   ///< for a terminal, above the table of rows; this and the next two may be empty
  std::string instead{};  ///< of the table
  std::string remark{};   ///< below the table: what depends on the machine
  std::vector<std::pair<std::string, std::string>> files{};  ///< name and content of more than rows and page
};

/// The options that one experiment alone has, with their defaults: for the command line, and written again
/// into the line that repeats a run. The variables must live as long as the experiment.
class OwnOptions {
 public:
  template <class T>
  void option(const std::string& name, T& value, const std::string& help, Need need = Need::kOptional) {
    add([=, &value](CommandLine& line) { line.option(name, value, help, need); },
        [=, &value] { return words_of(name, value); });
  }
  void choice(const std::string& name, std::string& value, const std::vector<std::string>& allowed,
              const std::string& help);
  void flag(const std::string& name, bool& value, const std::string& help);

  void add_to(CommandLine& line) const;
  /// " --seeds 50 --minutes 10": every option with its present value; flags that are off and empty texts are
  /// left out.
  std::string words() const;

 private:
  using Declare = std::function<void(CommandLine&)>;
  using Words = std::function<std::string()>;
  void add(Declare declare, Words words) { options_.emplace_back(std::move(declare), std::move(words)); }
  static std::string words_of(const std::string& name, const std::string& value);
  static std::string words_of(const std::string& name, const std::vector<std::string>& values);
  static std::string words_of(const std::string& name, double value);
  static std::string words_of(const std::string& name, int value);
  static std::string words_of(const std::string& name, std::uint64_t value);

  std::vector<std::pair<Declare, Words>> options_;
};

/// For a choice between values that have a name().
template <class Enum, std::size_t kCount>
std::vector<std::string> names(const Enum (&all)[kCount]) {
  std::vector<std::string> out;
  for (const Enum value : all) out.emplace_back(name(value));
  return out;
}
/// The one of `all` whose name() is `text`. @throws std::invalid_argument where there is none.
template <class Enum, std::size_t kCount>
Enum named(const Enum (&all)[kCount], const std::string& text) {
  for (const Enum value : all) {
    if (text == name(value)) return value;
  }
  throw std::invalid_argument("there is no '" + text + "'");
}

/// Taken where the robot has one of this name, else its usual one.
struct Presets {
  std::string alone = "best";
  std::string in_all = "best";
};

/// Of what `sprung experiment all` can be: a joint alone, a leg that stands, a robot that walks.
enum class RobotKind { kJoint, kLeg, kWalker };

struct Experiment {
  std::string name;      ///< as in `sprung experiment <name>`; its rows' names begin with it
  std::string what;      ///< that is done, for --help
  std::string question;  ///< that it answers, for its page
  std::string robot = "single_leg";
  Presets presets{};
  std::set<Common> takes{};
  std::string robot_help = "name or folder";
  std::string preset_note{};  ///< follows the help of --preset, as out_note that of --out
  std::string seed_help = "of every noise";
  std::string out_note{};
  std::string example{};         ///< options that follow the name
  std::set<RobotKind> in_all{};  ///< whose `sprung experiment all` runs it
  bool many_cases = false;       ///< uses all the threads by itself
  bool reads_files = false;      ///< robot.yaml itself too, where nothing can be set
  bool needs_gaits = false;
  bool draws_plants = false;        ///< by itself, from `--plant draw=K` upward: `--plants` is refused
  OwnOptions own{};                 ///< and their defaults
  std::function<void()> shorten{};  ///< before it runs in `all`: changes own options; may be empty
  std::function<ExperimentOutput(const ExperimentInput&)> run{};
};

/// The robot that is asked for, with the numbers that are set.
/// @throws WrongUse for a text that is no KEY=NUMBER, ConfigError as load_robot().
RobotConfig robot_of(const ExperimentRequest& request);

/// The plant that is asked for, as it was typed: each word after a space.
std::string plant_words(const ExperimentRequest& request);

/// @throws WrongUse where the robot has no gaits and needs them, std::invalid_argument for a preset or plant
/// that there is not.
ExperimentInput experiment_input(const Experiment& experiment, const ExperimentRequest& request,
                                 const RobotConfig& robot);

struct FinishedExperiment {
  std::string name, question;
  std::string command;  ///< the line that makes it again
  ExperimentReport rows;
  ExperimentOutput output;  ///< without its rows
  std::string failure;      ///< why it has no rows; empty: it ran

  bool ok() const { return failure.empty() && rows.ok(); }
};

/// On drawn plants where they are asked for (drawn_plants.h). @throws what the experiment's run throws.
FinishedExperiment run_experiment(const Experiment& experiment, const ExperimentInput& input);

/// Experiments of many cases run one after the other, each on all threads; then the rest, each on one thread.
/// One that fails does not stop the others. Runs all of `request` but its preset.
/// @param on_progress how many experiments are done; may be empty.
/// @return in the order of `experiments`.
std::vector<FinishedExperiment> run_experiments(
    const std::vector<Experiment>& experiments, const ExperimentRequest& request, const RobotConfig& robot,
    const std::function<void(std::size_t, std::size_t)>& on_progress);

}  // namespace sprung
