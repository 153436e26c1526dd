#include "tools/operate/launcher/run_file.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <set>
#include <thread>

#include "runtime/key_source.h"
#include "tools/operate/launcher/run_folder.h"

namespace sprung {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

namespace {

constexpr int kLockTries = 20;

Json to_json(const RunInfo& info) {
  Json out{{"instance", info.instance}, {"robot", info.robot},       {"robot_folder", info.robot_folder},
           {"preset", info.preset},     {"clock", info.clock},       {"simulation", info.simulation},
           {"session", info.session},   {"epoch_us", info.epoch_us}, {"lcm_url", info.lcm_url},
           {"log", info.log},           {"can", info.can},           {"launcher_pid", info.launcher_pid}};
  out["maintenance"] = info.maintenance;
  out["plant"] = info.plant;
  out["buses"] = info.buses;
  out["via"] = info.via;
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
  info.plant = in.value("plant", std::vector<std::string>{});  // other versions' runs are runs
  info.maintenance = in.at("maintenance");
  info.session = in.at("session");
  info.epoch_us = in.at("epoch_us");
  info.lcm_url = in.at("lcm_url");
  info.log = in.at("log");
  info.can = in.at("can").get<std::vector<std::string>>();
  info.launcher_pid = in.at("launcher_pid");
  info.buses = in.at("buses").get<std::vector<std::string>>();
  for (const Json& process : in.at("processes")) {
    info.processes.push_back({process.at("program"), process.at("pid")});
  }
  info.via = in.at("via");
  return info;
}

std::string lock_path(const std::string& instance) { return (run_folder() / (instance + ".lock")).string(); }

int open_lock(const std::string& instance, int flags) {
  return open(lock_path(instance).c_str(), flags | O_CLOEXEC | O_NOFOLLOW, 0644);
}

/// Whether a launcher lives: its lock cannot be had.
bool held(const std::string& instance) {
  const int lock = open_lock(instance, O_RDONLY);
  if (lock < 0) {
    return false;
  }
  const bool taken = flock(lock, LOCK_SH | LOCK_NB) != 0;
  close(lock);
  return taken;
}

std::optional<RunInfo> read_description(const std::string& instance) {
  std::ifstream in(run_file_path(instance));
  if (!in) return std::nullopt;
  try {
    return from_json(Json::parse(in));
  } catch (const Json::exception&) {
    return std::nullopt;
  }
}

std::set<std::string> described_instances() {
  std::set<std::string> instances;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(checked_run_folder(), none)) {
    if (entry.path().extension() == ".json") instances.insert(entry.path().stem().string());
  }
  return instances;
}

/// Not one that got the same number later: its command line begins with the program.
bool still_runs(const RunningProcess& process) {
  std::ifstream in("/proc/" + std::to_string(process.pid) + "/cmdline", std::ios::binary);
  std::string program;
  std::getline(in, program, '\0');
  return fs::path(program).filename() == process.program;
}

}  // namespace

std::string run_text(const RunInfo& info) { return to_json(info).dump(1); }

RunInfo parse_run(const std::string& text) { return from_json(Json::parse(text)); }

std::string run_file_path(const std::string& instance) {
  return (run_folder() / (instance + ".json")).string();
}

std::string run_key_path(const std::string& instance) {
  return (run_folder() / (instance + ".key")).string();
}

NodeOptions commanding(const RunInfo& info) {
  NodeOptions options{info.lcm_url, info.session, info.epoch_us, {}};
  options.key = read_key_file(run_key_path(info.instance));
  options.lockstep = info.clock == "lockstep";
  return options;
}

RunFile::RunFile(const std::string& instance) : instance_(instance) {
  made_run_folder();
  lock_ = open_lock(instance, O_RDWR | O_CREAT);
  if (lock_ < 0) {
    throw std::runtime_error("cannot write " + lock_path(instance) + ": " + std::strerror(errno));
  }
  // A reader's look at the lock takes a moment: do not mistake it for a launcher.
  for (int tries = 0; flock(lock_, LOCK_EX | LOCK_NB) != 0; ++tries) {
    if (tries == kLockTries) {
      close(lock_);
      const std::optional<RunInfo> other = read_run_file(instance);
      throw std::runtime_error("robot " + (other ? other->robot : "(starting)") +
                               " is up already as instance '" + instance +
                               "'. Use it, or end it with: sprung down");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

RunFile::~RunFile() {
  std::error_code ignored;
  if (written_) fs::remove(run_file_path(instance_), ignored);
  if (key_written_) fs::remove(run_key_path(instance_), ignored);
  close(lock_);
}

void RunFile::write_key(const MessageKey& key) {
  write_key_file(run_key_path(instance_), key);
  key_written_ = true;
}

void RunFile::write(const RunInfo& info) {
  const fs::path path = run_file_path(instance_);
  const fs::path draft = path.string() + "." + std::to_string(getpid());
  std::ofstream out(draft);
  out << run_text(info) << "\n";
  out.close();
  if (!out) {
    throw std::runtime_error("cannot write " + draft.string() + ": is the disk full?");
  }
  fs::rename(draft, path);
  written_ = true;
}

std::optional<RunInfo> read_run_file(const std::string& instance) {
  checked_run_folder();
  return held(instance) ? read_description(instance) : std::nullopt;
}

std::vector<RunInfo> runs_that_are_up() {
  std::vector<RunInfo> runs;
  for (const std::string& instance : described_instances()) {
    if (auto info = read_run_file(instance)) runs.push_back(std::move(*info));
  }
  return runs;
}

std::vector<RunningProcess> left_behind(const std::string& own_instance) {
  std::vector<RunningProcess> left;
  for (const std::string& instance : described_instances()) {
    if (instance != own_instance && held(instance)) continue;
    const auto info = read_description(instance);
    if (!info) continue;
    std::copy_if(info->processes.begin(), info->processes.end(), std::back_inserter(left), still_runs);
  }
  return left;
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
