/// sprung robot: what a robot's files say, whether they agree, and a folder to begin one's own with.
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <stdexcept>

#include "robots/overlay.h"
#include "robots/robot_loader.h"
#include "robots/yaml_text.h"
#include "simulation/plant/plant_draw.h"
#include "simulation/plant/plant_words.h"
#include "simulation/plant/robot_check.h"
#include "simulation/plant/sim_config.h"
#include "tools/commands.h"

namespace sprung::commands {
namespace {

namespace fs = std::filesystem;

/// Of `--plant draw=K` and family=NAME alone: what other changes do is what they say.
void print_draw(const RobotConfig& config, const std::vector<std::string>& plant) {
  std::map<std::string, double> changes = parse_plant(plant);
  const auto draw = sim::take_draw(changes);
  if (!draw || !changes.empty())
    throw WrongUse("robot show --plant: takes draw=K and family=NAME, no other change");
  sim::SimConfig drawn = sim::load_sim_config(config, {});
  for (const sim::DrawnValue& value : sim::draw_plant(config, sim::load_variation(config), *draw, drawn))
    std::printf("%s%s%s: %.6g%s%s\n", value.item.c_str(), value.item.empty() ? "" : ".",
                value.quantity.c_str(), value.value, value.unit.empty() ? "" : " ", value.unit.c_str());
}

int show(const std::string& robot, bool sim, const std::vector<std::string>& plant) {
  const RobotConfig config = load_robot(robot);
  if (!plant.empty()) {
    print_draw(config, plant);
    return kExitDone;
  }
  const std::string path = config.folder + (sim ? "/sim.yaml" : "/robot.yaml");
  const YamlMap file = YamlMap::load(path);
  if (sim)
    sim::read_sim_config(file, config);
  else
    read_robot(file);
  std::printf("# %s, typed out; behind each value where it was typed.\n%s", path.c_str(),
              explained_yaml_text(file).c_str());
  if (!sim)
    for (const OverlaidNumber& one : config.overlay) std::printf("# %s\n", overlaid_text(one).c_str());
  return kExitDone;
}

int check(const std::string& robot, bool real) {
  const RobotConfig config = load_robot(robot);
  const bool with_sim = !real && fs::exists(config.folder + "/sim.yaml");
  const auto found = sim::check_robot(config,
                                      with_sim ? sim::CheckAgainst::kModelAndSim : sim::CheckAgainst::kModel);
  for (const std::string& what : found) std::printf("%s\n", what.c_str());
  if (found.empty())
    std::printf("%s: robot.yaml agrees with model.xml%s\n", config.name.c_str(),
                with_sim ? " and sim.yaml" : "");
  return found.empty() ? kExitDone : kExitFailed;
}

std::string text_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void replace_first(std::string& text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at != std::string::npos) text.replace(at, from.size(), to);
}

/// The shipped files, comments and all, under the new robot's name.
int begin(const std::string& folder, const std::string& from) {
  const RobotConfig pattern = load_robot(from);
  const fs::path target = fs::absolute(folder).lexically_normal();
  const std::string name = (target.filename().empty() ? target.parent_path() : target).filename().string();
  if (fs::exists(target / "robot.yaml"))
    throw WrongUse(folder + " holds a robot.yaml already: name a folder that does not, or remove it");
  fs::create_directories(target);
  for (const char* file : {"robot.yaml", "sim.yaml", "variation.yaml", "terrain.yaml", "model.xml"}) {
    if (!fs::exists(fs::path(pattern.folder) / file)) continue;
    std::string text = text_of(fs::path(pattern.folder) / file);
    replace_first(text, "robot: " + pattern.name + "\n", "robot: " + name + "\n");
    replace_first(text, "model=\"" + pattern.name + "\"", "model=\"" + name + "\"");
    if (!(std::ofstream(target / file) << text))
      throw std::runtime_error((target / file).string() + ": cannot be written");
  }
  std::printf(
      "%s begins as %s. Next: docs/your_robot.md says what to change; then\n  sprung robot check %s\n"
      "  sprung up %s --sim\nIdentified friction is still that of %s: remove it, or sprung identify anew.\n",
      folder.c_str(), pattern.name.c_str(), folder.c_str(), folder.c_str(), pattern.name.c_str());
  return kExitDone;
}

}  // namespace

void add_robot(CommandLine& sprung) {
  const auto robot = std::make_shared<std::string>();
  const auto from = std::make_shared<std::string>("pegasus");
  const auto sim = std::make_shared<bool>(false);
  const auto real = std::make_shared<bool>(false);
  const auto plant = std::make_shared<std::vector<std::string>>();
  CommandLine& group = sprung.subcommand("robot",
                                         "Files of a robot: show them, check them, begin one's own.");
  group.example("sprung robot check pegasus");
  CommandLine& shown = group.subcommand(
      "show", "Print robot.yaml typed out, with where each value came from: file and line, or a default.");
  shown.option("robot", *robot, "name of a folder in robots/, or a folder", Need::kRequired);
  shown.flag("--sim", *sim, "sim.yaml instead");
  shown.option("--plant", *plant,
               "draw=K, family=NAME: what that draw of variation.yaml changes in sim.yaml, instead");
  shown.example("sprung robot show pegasus");
  shown.action([=] { return show(*robot, *sim, *plant); });
  CommandLine& checked = group.subcommand(
      "check", "Hold robot.yaml against model.xml and sim.yaml; status 1 where they differ.");
  checked.option("robot", *robot, "name of a folder in robots/, or a folder", Need::kRequired);
  checked.flag("--real", *real, "model.xml alone, as sprung up does on real buses");
  checked.example("sprung robot check ./my_robot");
  checked.action([=] { return check(*robot, *real); });
  CommandLine& made = group.subcommand("new", "Begin a robot of one's own as a copy of another.");
  made.option("folder", *robot, "to be made; its last part becomes the robot's name", Need::kRequired);
  made.option("--from", *from, "robot to begin with");
  made.example("sprung robot new my_robot --from pegasus");
  made.action([=] { return begin(*robot, *from); });
}

}  // namespace sprung::commands
