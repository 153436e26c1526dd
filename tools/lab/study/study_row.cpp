#include "tools/lab/study/study_row.h"

#include <sprung_version.h>

#include <algorithm>
#include <filesystem>
#include <new>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>

#include "robots/robot_loader.h"
#include "robots/text_hash.h"
#include "robots/yaml_reader.h"
#include "tools/lab/run/experiment_line.h"
#include "tools/lab/study/study_json.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;
namespace fs = std::filesystem;

const RobotConfig& robot_for(const ExperimentRequest& request, const std::string& files,
                             LoadedRobot& loaded) {
  std::string what = request.robot + "\n" + files;
  for (const std::string& number : request.set) what += "\n" + number;
  if (what == loaded.what) return loaded.robot;
  loaded.what.clear();  // should it throw
  loaded.robot = robot_of(request);
  loaded.what = what;
  return loaded.robot;
}

/// One thread: an engine has its own, and no bit depends on their number.
FinishedExperiment finished(const StudyRun& run, const std::string& files, LoadedRobot& loaded) {
  const std::unique_ptr<AskedExperiment> asked = asked_experiment(words_of(run));
  asked->request.jobs = 1;
  const RobotConfig& robot = robot_for(asked->request, files, loaded);
  return run_experiment(asked->experiment, experiment_input(asked->experiment, asked->request, robot));
}

/// The same text wherever the robot is installed.
std::string without_place(std::string text, const std::string& folder) {
  for (std::size_t at = 0; (at = text.find(folder, at)) != std::string::npos;)
    text.replace(at, folder.size(), fs::path(folder).filename().string());
  return text;
}

std::string command_of(const StudyRun& run) {
  std::string text = "sprung experiment";
  for (const std::string& word : words_of(run)) text += " " + shell_word(word);
  return text + " --json";
}

void run_into(const StudyRun& run, const std::string& files, LoadedRobot& loaded, Json& out) {
  try {
    const FinishedExperiment done = finished(run, files, loaded);
    out["failure"] = "";
    out["simulated_s"] = done.rows.simulated_s;
    out["rows"] = rows_json(done.rows.rows);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::system_error&) {  // of files, threads, processes: another machine may have them
    throw;
  } catch (const std::exception& error) {
    out["failure"] = without_place(error.what(), robot_folder(run.robot));
    out["rows"] = Json::array();
  }
}

}  // namespace

StudyOrigin origin_of(const std::string& robot) {
  std::vector<std::string> files;
  for (const fs::directory_entry& file : fs::directory_iterator(robot_folder(robot))) {
    const std::string kind = file.path().extension().string();
    if (kind == ".yaml" || kind == ".xml") files.push_back(file.path().string());
  }
  std::sort(files.begin(), files.end());
  std::string text;
  for (const std::string& file : files)
    text += fs::path(file).filename().string() + "\n" + text_of_file(file);
  return {SPRUNG_VERSION "-" SPRUNG_GIT_HASH, hash_digits(hash_text(text))};
}

std::string study_row(const StudyRun& run, LoadedRobot& loaded) {
  Json out = Json::parse(run_json(run));
  StudyRun numberless = run;
  numberless.number = 0;
  numberless.study.clear();
  out["hash"] = hash_digits(hash_text(run_json(numberless)));
  const StudyOrigin origin = origin_of(run.robot);
  out["version"] = origin.version;
  out["files"] = origin.files;
  out["command"] = command_of(run);
  run_into(run, origin.files, loaded, out);
  return out.dump();
}

StudyResult result_of(const std::string& row) {
  try {
    const Json json = Json::parse(row);
    StudyResult out;
    out.run = run_of_json(row);
    out.number = out.run.number;
    out.study = out.run.study;
    out.origin = {json.at("version"), json.at("files")};
    out.command = json.at("command");
    out.failure = json.at("failure");
    out.rows = rows_of_json(json.at("rows"));
    return out;
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("no row of a study: ") + error.what());
  }
}

}  // namespace sprung
