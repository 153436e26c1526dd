/// A shipped sim.yaml with any edits.
#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "simulation/plant/sim_config.h"
#include "tests/fuzz/edited_text.h"
#include "tests/fuzz/fuzz.h"

namespace sprung::fuzz::simulation_sim_config {
namespace {

struct Shipped {
  RobotConfig robot;
  std::string sim_yaml;
};

const std::vector<Shipped>& shipped() {
  static const std::vector<Shipped> all = [] {
    std::vector<Shipped> read;
    for (const std::string name : {"single_leg", "test_axis", "pegasus", "fennec"})
      read.push_back(
          {load_robot(test::source_dir() + "/robots/" + name), text_of("robots/" + name + "/sim.yaml")});
    return read;
  }();
  return all;
}

std::vector<std::string> sim_seeds() {
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < shipped().size(); ++i) {
    for (std::string& seed :
         edit_seeds(std::string(1, static_cast<char>(i)), lines_of(shipped()[i].sim_yaml).size()))
      seeds.push_back(std::move(seed));
  }
  return seeds;
}

}  // namespace

SPRUNG_FUZZ(simulation_sim_config, sim_seeds) {
  const Shipped& one = shipped()[input.byte() % shipped().size()];
  try {
    sim::SimConfig config = sim::read_sim_config(YamlMap::parse(edited(one.sim_yaml, input), "sim.yaml"),
                                                 one.robot);
    sim::apply_plant_changes({{"friction_scale", 1.1}, {"mass_scale", 0.9}}, config);
    require(config.drives.size() == one.robot.actuators.size(), "a drive for each actuator");
    require(config.plant.joints.size() == one.robot.joints.size(), "a joint for each");
  } catch (const ConfigError&) {  // that is how mistakes are told
  }
}

}  // namespace sprung::fuzz::simulation_sim_config
