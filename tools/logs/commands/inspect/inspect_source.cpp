#include <poll.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>

#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "runtime/stop_request.h"
#include "tools/logs/commands/inspect/inspect_commands.h"
#include "tools/logs/fields/lcm_files.h"
#include "tools/logs/fields/lcm_text.h"
#include "tools/logs/log/robot_names.h"
#include "tools/operate/launcher/run_file.h"

namespace sprung::commands {

namespace {

std::string text_of(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw WrongUse("cannot read " + path + ": --types wants .lcm files");
  return {std::istreambuf_iterator<char>(file), {}};
}

std::unique_ptr<fields::TypeTable> types_with(const std::vector<std::string>& paths) {
  auto types = std::make_unique<fields::TypeTable>();
  types->add(fields::lcm_files());
  std::vector<std::string> texts;
  texts.reserve(paths.size());
  for (const std::string& path : paths) texts.push_back(text_of(path));
  try {
    types->add({texts.begin(), texts.end()});
  } catch (const fields::BadLcmText& bad) {
    throw WrongUse(std::string("--types: ") + bad.what());
  }
  return types;
}

/// What can be watched can be watched without names too, also where somebody is editing the robot's file.
std::vector<fields::ListNames> names_or_told(const std::string& folder) {
  try {
    return log::names_of_robot(load_robot(folder)).lists;
  } catch (const ConfigError& error) {
    std::fprintf(
        stderr, "%s\njoints, legs and actuators have numbers and no names: say joints[0], not joints[knee]\n",
        error.what());
    return {};
  }
}

/// Of a robot, or of a log that is replayed here.
std::vector<fields::ListNames> names_of(const std::string& log_or_robot) {
  if (!std::filesystem::is_regular_file(log_or_robot))
    return log::names_of_robot(load_robot(log_or_robot)).lists;
  log::Reader reader(log_or_robot);
  log::RobotNames names = log::names_in_log(reader);
  if (!names.missing.empty()) std::fprintf(stderr, "%s\n", names.missing.c_str());
  return std::move(names.lists);
}

}  // namespace

void add_inspect_options(CommandLine& command, InspectRequest& request) {
  command.option("--instance", request.instance, "which run");
  command.option("--url", request.url, "LCM address; default that of the robot that is up");
  command.option("--names-of", request.names_of,
                 "whose joints have names: an LCM log, for one that is replayed, or a robot; default: the "
                 "one that is up");
  command.option("--types", request.types, ".lcm file of types that are not sprung's");
}

InspectSource inspect_source(const InspectRequest& request) {
  InspectSource source;
  source.types = types_with(request.types);
  source.url = request.url;
  if (source.url.empty()) {
    const bool wanted = request.instance != InspectRequest().instance;
    const auto run = wanted ? require_running(request.instance, "") : read_run_file(request.instance);
    source.url = run ? run->lcm_url : kDefaultLcmUrl;
    source.title = run ? run->robot : "no robot is up";
    if (run && request.names_of.empty()) source.names = names_or_told(run->robot_folder);
  }
  if (!request.names_of.empty()) source.names = names_of(request.names_of);
  source.title += (source.title.empty() ? "" : ", ") + source.url;
  return source;
}

void wait_or_stop(int wait_ms) noexcept {
  pollfd stop{stop_fd(), POLLIN, 0};
  poll(&stop, 1, wait_ms);
}

}  // namespace sprung::commands
