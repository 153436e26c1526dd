#include "tools/lab/study/study_worker.h"

#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "tools/lab/study/study_json.h"

namespace sprung {
namespace {

using Json = nlohmann::ordered_json;

Json error_json(std::int64_t number, const std::string& why) { return {{"run", number}, {"error", why}}; }

}  // namespace

std::string worker_answer(const std::string& line, LoadedRobot& loaded) {
  std::int64_t number = 0;
  try {
    const StudyRun run = run_of_json(line);
    number = run.number;
    const auto started = std::chrono::steady_clock::now();
    const std::string row = study_row(run, loaded);
    const double wall_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
    // Not parsed again: a row goes through as the bytes that it is.
    return "{\"run\":" + std::to_string(number) + ",\"row\":" + row + ",\"wall_s\":" + Json(wall_s).dump() +
           "}";
  } catch (const std::exception& error) {
    return error_json(number, error.what()).dump();
  }
}

WorkerAnswer answer_of(const std::string& line) {
  try {
    const Json json = Json::parse(line);
    WorkerAnswer answer;
    answer.number = json.at("run");
    if (json.contains("row")) answer.row = json.at("row").dump();
    answer.error = json.value("error", "");
    answer.wall_s = json.value("wall_s", 0.0);
    if (answer.row.empty() == answer.error.empty())
      throw std::invalid_argument("no answer of a worker: " + line);
    return answer;
  } catch (const nlohmann::json::exception& error) {
    throw std::invalid_argument(std::string("no answer of a worker: ") + error.what());
  }
}

int run_worker() {
  LoadedRobot loaded;
  for (std::string line; std::getline(std::cin, line);) {
    if (!line.empty()) std::cout << worker_answer(line, loaded) << "\n" << std::flush;
  }
  return std::cout ? 0 : 1;
}

}  // namespace sprung
