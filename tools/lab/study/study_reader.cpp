#include "tools/lab/study/study_reader.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <limits>
#include <set>
#include <stdexcept>

#include "robots/overlay.h"
#include "robots/robot_loader.h"
#include "robots/robot_numbers.h"
#include "signals/spelling.h"
#include "simulation/plant/plant_words.h"
#include "simulation/sim_core.h"
#include "tools/lab/run/experiment_line.h"
#include "tools/lab/study/study_json.h"

namespace sprung {
namespace {

constexpr double kAny = std::numeric_limits<double>::max();
constexpr std::int64_t kMostRuns = 10'000'000;             // a row is a file: beyond, split the study
constexpr std::int64_t kMostDraw = std::int64_t{1} << 53;  // exact as a number of --plant

/// "3" or "1..20". @throws ConfigError at the key.
std::vector<std::uint64_t> range_of(const YamlMap& map, const std::string& key) {
  const std::string text = map.text(key);
  char* end = nullptr;
  const auto whole = [&](const char* from) { return std::strtoull(from, &end, 10); };
  const bool begins = !text.empty() && text.front() != '.' && text.back() != '.' &&
                      text.find_first_not_of("0123456789.") == std::string::npos;
  const std::uint64_t first = begins ? whole(text.c_str()) : 0;
  std::uint64_t last = first;
  const bool is_range = begins && std::string(end).rfind("..", 0) == 0;
  if (is_range) last = whole(end + 2);
  if (!begins || *end != '\0' || last > static_cast<std::uint64_t>(kMostDraw))
    map.fail(key, "found '" + text + "', expected whole numbers: 3, or 1..20");
  if (last < first)
    map.fail(key, "the range " + text + " is turned round: " + std::to_string(last) + ".." +
                      std::to_string(first) + " is meant?");
  if (last - first >= static_cast<std::uint64_t>(kMostRuns)) map.fail(key, text + " are too many");
  std::vector<std::uint64_t> out;
  for (std::uint64_t n = first; n <= last; ++n) out.push_back(n);
  return out;
}

std::vector<std::uint64_t> range_or(const YamlMap& map, const std::string& key,
                                    const std::vector<std::uint64_t>& otherwise) {
  return map.has(key) ? range_of(map, key) : otherwise;
}

/// The keys of a map of texts, as "KEY=VALUE".
std::vector<std::string> changes_of(const YamlMap& map) {
  std::vector<std::string> out;
  for (const YamlKey& key : map.tree().keys) out.push_back(key.name + "=" + map.text(key.name));
  return out;
}

std::vector<std::vector<std::string>> plants_of(const YamlMap& map) {
  std::vector<std::vector<std::string>> plants;
  if (map.has("plants"))
    for (const YamlMap& one : map.list("plants")) plants.push_back(changes_of(one));
  if (!map.has("draws") && !map.has("families")) return plants;
  const std::vector<std::string> families = map.has("families") ? map.texts("families")
                                                                : std::vector<std::string>{""};
  for (const std::string& family : families) {
    for (const std::uint64_t draw : range_or(map, "draws", {1})) {
      plants.emplace_back();
      if (!family.empty()) plants.back().push_back("family=" + family);
      plants.back().push_back("draw=" + std::to_string(draw));
    }
  }
  return plants;
}

/// The error of something else, at a key of the study.
template <class Try>
auto or_fail(const YamlMap& map, const std::string& key, Try&& attempt) {
  try {
    return attempt();
  } catch (const std::exception& error) {
    map.fail(key, error.what());
  }
}

class StudyReader {
 public:
  explicit StudyReader(const std::string& path) : file_(YamlMap::load(path)) { study_.file = path; }

  Study read() {
    study_.name = file_.text("study");
    study_.experiment = file_.text("experiment");
    read_robot_file();
    if (file_.has("preset")) study_.preset = file_.text("preset");
    read_options();
    study_.timeout_s = file_.quantity_or("timeout", "s", 1e-3, 1e7, study_.timeout_s);
    if (file_.has("show")) study_.show = file_.texts("show");
    read_parameters();
    study_.plants = plants_of(file_);
    if (study_.plants.empty()) study_.plants.emplace_back();
    study_.seeds = range_or(file_, "seeds", {1});
    if (file_.has("tune")) read_tuning(file_.map("tune"));
    file_.finish();
    check_experiment();
    for (const StudyParameter& one : study_.parameters) check_ends(one);
    check_plants(study_.plants, file_, plants_key());
    if (study_.tuning) {
      check_plants(study_.tuning->validate, file_.map("tune"), "validate");
      check_plants(study_.tuning->held_out, file_.map("tune"), "held_out");
    }
    if (!study_.tuning && run_count(study_) > kMostRuns)
      file_.fail("study", std::to_string(run_count(study_)) + " runs are too many: at most " +
                              std::to_string(kMostRuns) + "; split it");
    return study_;
  }

 private:
  void read_robot_file() {
    study_.robot = file_.text("robot");
    robot_ = or_fail(file_, "robot", [&] { return load_robot(study_.robot); });
  }

  void read_options() {
    if (!file_.has("options")) return;
    const YamlMap options = file_.map("options");
    for (const YamlKey& key : options.tree().keys) {
      const std::string value = options.text(key.name);
      for (const char* elsewhere : {"robot", "preset", "set", "plant", "seed", "separate", "jobs"}) {
        if (key.name == elsewhere)
          options.fail(key.name,
                       "is no option of a study: robot, preset, parameters, plants and seeds have keys of "
                       "their own, and a run is one thread of one process");
      }
      if (value == "false") continue;
      study_.options.push_back("--" + key.name);
      if (value != "true") study_.options.push_back(value);
    }
  }

  void read_parameters() {
    study_.samples = static_cast<int>(file_.integer_or("samples", 1, kMostRuns, 0));
    if (study_.samples > 0 && !file_.has("parameters"))
      file_.fail("samples", "there are no parameters: they would all be the same");
    if (!file_.has("parameters")) return;
    const YamlMap robot_file = YamlMap::load(robot_.folder + "/robot.yaml");
    const YamlMap parameters = file_.map("parameters");
    for (const auto& [path, map] : parameters.entries()) {
      StudyParameter one;
      one.path = path;
      try {
        std::tie(one.present, one.unit) = robot_file.quantity_at(path);
      } catch (const ConfigError&) {
        const std::set<std::string> numbers = robot_numbers(study_.robot);
        parameters.fail(path, robot_.folder + "/robot.yaml has no number of this name" +
                                  did_you_mean(path, {numbers.begin(), numbers.end()}));
      }
      read_values(map, one);
      study_.parameters.push_back(one);
    }
  }

  void read_values(const YamlMap& map, StudyParameter& one) {
    if (map.has("values")) {
      if (study_.samples > 0 || file_.has("tune"))
        map.fail("values", "samples and a search need a range: from and to, please");
      one.values = map.quantities("values", one.unit, -kAny, kAny);
      if (one.values.empty()) map.fail("values", "there is none");
      const auto [least, most] = std::minmax_element(one.values.begin(), one.values.end());
      one.from = *least;
      one.to = *most;
      return;
    }
    one.from = map.quantity("from", one.unit, -kAny, kAny);
    one.to = map.quantity("to", one.unit, -kAny, kAny);
    if (!(one.from < one.to)) map.fail("to", "the range is turned round: `from` is below `to`");
    one.logarithmic = one.from > 0.0 && one.to >= 4.0 * one.from;  // ratios count, not differences
    if (map.has("scale")) {
      const std::string scale = map.text("scale");
      if (scale != "log" && scale != "linear")
        map.fail("scale", "found '" + scale + "', expected log or linear");
      one.logarithmic = scale == "log";
      if (one.logarithmic && one.from <= 0.0) map.fail("scale", "log needs a range above 0");
    }
    const auto points = map.integer_or("points", 2, 100'000, 3);
    for (std::int64_t i = 0; i < points; ++i)
      one.values.push_back(one.at(static_cast<double>(i) / static_cast<double>(points - 1)));
  }

  void read_tuning(const YamlMap& map) {
    StudyTuning tuning;
    tuning.trials = static_cast<int>(map.integer_or("trials", 1, 1'000'000, tuning.trials));
    tuning.runs = map.integer_or("runs", 1, kMostRuns, 0);
    tuning.seed = static_cast<std::uint64_t>(map.integer_or("seed", 0, 2'000'000'000, 0));
    if (map.has("prunes")) tuning.prunes = map.flag("prunes");
    tuning.finalists = static_cast<int>(map.integer_or("finalists", 1, 1000, tuning.finalists));
    if (map.has("validate")) tuning.validate = plants_of(map.map("validate"));
    if (map.has("held_out")) tuning.held_out = plants_of(map.map("held_out"));
    for (const YamlMap& goal : map.list("goals")) tuning.goals.push_back(goal_of(goal));
    if (tuning.goals.empty()) map.fail("goals", "at least one is needed");
    if (!tuning.validate.empty() && tuning.goals.size() > 1)
      map.fail("validate", "chooses by one goal; of several the page shows what they trade");
    if (study_.parameters.empty()) map.fail("goals", "there is nothing to tune: the study has no parameters");
    study_.tuning = tuning;
  }

  static StudyGoal goal_of(const YamlMap& map) {
    const auto choice = [&](const char* key, const std::string& usual, const std::string& other) {
      const std::string found = map.has(key) ? map.text(key) : usual;
      if (found != usual && found != other)
        map.fail(key, "found '" + found + "', expected " + usual + " or " + other);
      return found == usual;
    };
    StudyGoal goal;
    goal.name = map.text("name");
    goal.is_least = choice("want", "least", "most");
    goal.is_worst = choice("over", "worst", "mean");
    for (const YamlMap& one : map.list("of")) {
      StudyTerm term;
      term.row = one.text("row");
      term.weight = one.quantity_or("weight", "", -kAny, kAny, 1.0);
      if (one.has("above")) term.above = one.quantity("above", "", -kAny, kAny);
      if (one.has("about")) term.about = one.quantity("about", "", -kAny, kAny);
      term.unreached = one.quantity("unreached", "", -kAny, kAny);
      goal.terms.push_back(term);
    }
    if (goal.terms.empty()) map.fail("of", "at least one row is needed");
    return goal;
  }

  StudyRun plain_run() const {
    StudyRun run;
    run.experiment = study_.experiment;
    run.robot = study_.robot;
    run.preset = study_.preset;
    run.options = study_.options;
    return run;
  }

  void check_experiment() const {
    const std::string key = study_.options.empty() ? "experiment" : "options";
    const auto asked = or_fail(file_, key, [&] { return asked_experiment(words_of(plain_run())); });
    or_fail(file_, "experiment",
            [&] { return experiment_input(asked->experiment, asked->request, robot_).preset; });
    if (!study_.parameters.empty() && asked->experiment.reads_files)
      file_.fail("parameters", "experiment " + study_.experiment +
                                   " reads robot.yaml itself: no number of it can be varied");
    const bool has_plants = study_.plants.size() > 1 || !study_.plants.front().empty() ||
                            (study_.tuning &&
                             study_.tuning->validate.size() + study_.tuning->held_out.size() > 0);
    if (has_plants && asked->experiment.takes.count(Common::kPlant) == 0)
      file_.fail("experiment", study_.experiment + " takes no --plant: it has plants of its own");
  }

  /// robot.yaml's own bounds hold at both ends.
  void check_ends(const StudyParameter& one) const {
    for (const double value : {one.from, one.to})
      or_fail(file_.map("parameters"), one.path, [&] {
        return load_robot(study_.robot, {{one.path, value}}).hash;
      });
  }

  /// First and last say of a thousand draws what all say: they differ by their number alone.
  void check_plants(const std::vector<std::vector<std::string>>& plants, const YamlMap& map,
                    const std::string& key) const {
    std::set<std::string> seen;
    for (const std::vector<std::string>& plant : plants) {
      std::string keys;
      for (const std::string& change : plant) keys += change.rfind("draw=", 0) == 0 ? "draw " : change + " ";
      if (seen.insert(keys).second) check_plant(plant, map, key);
    }
  }

  std::string plants_key() const {
    return file_.has("plants") ? "plants" : file_.has("families") ? "families" : "draws";
  }

  void check_plant(const std::vector<std::string>& plant, const YamlMap& map, const std::string& key) const {
    or_fail(map, key, [&] {
      SimOptions options;
      options.plant = parse_plant(plant);
      return SimCore(robot_, options).cycle();
    });
  }

  YamlMap file_;
  RobotConfig robot_;
  Study study_;
};

}  // namespace

Study read_study(const std::string& path) { return StudyReader(path).read(); }

}  // namespace sprung
