#include "tools/lab/study/study_json.h"

#include <algorithm>
#include <cctype>
#include <cstring>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "robots/overlay.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

Json parameter_json(const StudyParameter& one) {
  return {{"path", one.path},    {"unit", one.unit}, {"present", one.present},
          {"from", one.from},    {"to", one.to},     {"logarithmic", one.logarithmic},
          {"values", one.values}};
}

Json term_json(const StudyTerm& one) {
  Json term = {{"row", one.row}, {"weight", one.weight}, {"unreached", one.unreached}};
  if (one.about) term["about"] = *one.about;
  if (one.above) term["above"] = *one.above;
  return term;
}

Json goal_json(const StudyGoal& goal) {
  Json terms = Json::array();
  for (const StudyTerm& one : goal.terms) terms.push_back(term_json(one));
  return {{"name", goal.name},
          {"want", goal.is_least ? "least" : "most"},
          {"over", goal.is_worst ? "worst" : "mean"},
          {"of", terms}};
}

Json tuning_json(const Study& study) {
  const StudyTuning& tuning = *study.tuning;
  Json goals = Json::array();
  for (const StudyGoal& goal : tuning.goals) goals.push_back(goal_json(goal));
  return {{"trials", tuning.trials},
          {"runs", tuning.runs},
          {"seed", tuning.seed},
          {"prunes", tuning.prunes},
          {"finalists", tuning.finalists},
          {"validate", tuning.validate},
          {"held_out", tuning.held_out},
          {"first_sets", first_sets(study)},
          {"goals", goals}};
}

Json json_of(const StudyRun& run) {
  Json parameters = Json::object();
  for (const auto& [path, value] : run.parameters) parameters[path] = value;
  return {{"run", run.number},        {"study", run.study},   {"experiment", run.experiment},
          {"robot", run.robot},       {"preset", run.preset}, {"options", run.options},
          {"parameters", parameters}, {"plant", run.plant},   {"seed", run.seed}};
}

StudyRun run_of(const Json& json) {
  StudyRun run;
  run.number = json.at("run");
  run.study = json.value("study", "");
  run.experiment = json.at("experiment");
  run.robot = json.at("robot");
  run.preset = json.value("preset", "");
  if (json.contains("options")) run.options = json.at("options").get<std::vector<std::string>>();
  if (json.contains("parameters"))
    for (const auto& [path, value] : json.at("parameters").items()) run.parameters[path] = value;
  if (json.contains("plant")) run.plant = json.at("plant").get<std::vector<std::string>>();
  run.seed = json.value("seed", std::uint64_t{1});
  return run;
}

}  // namespace

std::string study_json(const Study& study) {
  Json parameters = Json::array();
  for (const StudyParameter& one : study.parameters) parameters.push_back(parameter_json(one));
  Json out = {{"study", study.name},         {"experiment", study.experiment}, {"robot", study.robot},
              {"preset", study.preset},      {"options", study.options},       {"parameters", parameters},
              {"samples", study.samples},    {"plants", study.plants},         {"seeds", study.seeds},
              {"timeout_s", study.timeout_s}};
  if (study.tuning) out["tuning"] = tuning_json(study);
  return out.dump();
}

std::string run_json(const StudyRun& run) { return json_of(run).dump(); }

StudyRun run_of_json(const std::string& line) {
  try {
    return run_of(Json::parse(line));
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("no run, as `sprung study expand` prints one: ") + error.what());
  }
}

std::string shell_word(const std::string& word) {
  const auto is_plain = [](unsigned char c) {
    return std::isalnum(c) != 0 || std::strchr("_./=,:+-@%", c) != nullptr;
  };
  if (!word.empty() && std::all_of(word.begin(), word.end(), is_plain)) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::vector<std::string> words_of(const StudyRun& run) {
  std::vector<std::string> words = {run.experiment, "--robot", run.robot, "--seed", std::to_string(run.seed)};
  if (!run.preset.empty()) words.insert(words.end(), {"--preset", run.preset});
  words.insert(words.end(), run.options.begin(), run.options.end());
  for (const auto& [path, value] : run.parameters)
    words.insert(words.end(), {"--set", path + "=" + exact_text(value)});
  for (const std::string& change : run.plant) words.insert(words.end(), {"--plant", change});
  return words;
}

}  // namespace sprung
