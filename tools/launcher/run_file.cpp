#include "tools/launcher/run_file.h"

#include <signal.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

namespace sprung {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

fs::path run_folder() {
  if (const char* folder = std::getenv("SPRUNG_RUN_DIR")) {
    return folder;
  }
  if (const char* folder = std::getenv("XDG_RUNTIME_DIR")) {
    return fs::path(folder) / "sprung";
  }
  return "/tmp/sprung-" + std::to_string(getuid());
}

Json to_json(const RunInfo& info) {
  Json out{{"instance", info.instance},
           {"robot", info.robot},
           {"robot_folder", info.robot_folder},
           {"preset", info.preset},
           {"clock", info.clock},
           {"simulation", info.simulation},
           {"session", info.session},
           {"epoch_us", info.epoch_us},
           {"lcm_url", info.lcm_url},
           {"log", info.log},
           {"launcher_pid", info.launcher_pid}};
  out["processes"] = Json::array();
  for (const RunningProcess& process : info.processes) {
    out["processes"].push_back({{"program", process.program}, {"pid", process.pid}});
  }
  return out;
}

RunInfo from_json(const Json& in) {
  RunInfo info;
  info.instance = in.at("instance");
  info.robot = in.at("robot");
  info.robot_folder = in.at("robot_folder");
  info.preset = in.at("preset");
  info.clock = in.at("clock");
  info.simulation = in.at("simulation");
  info.session = in.at("session");
  info.epoch_us = in.at("epoch_us");
  info.lcm_url = in.at("lcm_url");
  info.log = in.at("log");
  info.launcher_pid = in.at("launcher_pid");
  for (const Json& process : in.at("processes")) {
    info.processes.push_back({process.at("program"), process.at("pid")});
  }
  return info;
}

bool alive(std::int64_t pid) { return pid > 0 && (kill(static_cast<pid_t>(pid), 0) == 0 || errno == EPERM); }

}  // namespace

std::string run_file_path(const std::string& instance) {
  return (run_folder() / (instance + ".json")).string();
}

void write_run_file(const RunInfo& info) {
  const fs::path path = run_file_path(info.instance);
  fs::create_directories(path.parent_path());
  const fs::path draft = path.string() + "." + std::to_string(getpid());
  std::ofstream(draft) << to_json(info).dump(1) << "\n";
  fs::rename(draft, path);
}

void remove_run_file(const std::string& instance) {
  std::error_code ignored;
  fs::remove(run_file_path(instance), ignored);
}

std::optional<RunInfo> read_run_file(const std::string& instance) {
  std::ifstream in(run_file_path(instance));
  if (!in) {
    return std::nullopt;
  }
  try {
    RunInfo info = from_json(Json::parse(in));
    if (alive(info.launcher_pid)) {
      return info;
    }
  } catch (const Json::exception&) {
    // A file that is no run file tells of no run; it is removed like a stale one.
  }
  remove_run_file(instance);
  return std::nullopt;
}

RunInfo require_running(const std::string& instance, const std::string& robot) {
  const std::optional<RunInfo> info = read_run_file(instance);
  if (!info) {
    throw NotRunning("no robot is up (looked for " + run_file_path(instance) +
                     "). Start one first, for example: sprung up single_leg --sim");
  }
  if (!robot.empty() && robot != info->robot) {
    throw NotRunning("robot " + info->robot + " is up, not " + robot +
                     ". Leave out --robot, or: sprung down; sprung up " + robot);
  }
  return *info;
}

}  // namespace sprung
