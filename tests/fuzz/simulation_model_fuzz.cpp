/// A shipped model.xml with any edits, through MuJoCo's parser and our checks, and some steps of the plant
/// that comes of it. MuJoCo itself is not built for fuzzing: coverage is that of our own code.
#include <mujoco/mujoco.h>

#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "simulation/plant/plant.h"
#include "simulation/plant/robot_check.h"
#include "tests/fuzz/edited_text.h"
#include "tests/fuzz/fuzz.h"
#include "tests/fuzz/own_file.h"

namespace sprung::fuzz::simulation_model {
namespace {

struct Shipped {
  RobotConfig robot;
  sim::SimConfig sim;
  std::string model_xml;
};

Shipped read_shipped(const std::string& name) {
  Shipped shipped;
  shipped.robot = load_robot(test::source_dir() + "/robots/" + name);
  shipped.sim = sim::load_sim_config(shipped.robot, {});
  shipped.model_xml = text_of("robots/" + name + "/model.xml");
  shipped.robot.folder = own_folder();
  return shipped;
}

const std::vector<Shipped>& shipped() {
  static const std::vector<Shipped> all{read_shipped("single_leg"), read_shipped("test_axis"),
                                        read_shipped("pegasus")};
  return all;
}

std::vector<std::string> model_seeds() {
  std::vector<std::string> seeds;
  for (std::size_t i = 0; i < shipped().size(); ++i) {
    for (std::string& seed :
         edit_seeds(std::string(1, static_cast<char>(i)), lines_of(shipped()[i].model_xml).size()))
      seeds.push_back(std::move(seed));
  }
  return seeds;
}

void step(const Shipped& one) {
  sim::Plant plant(one.robot, one.sim.plant);
  plant.reset();
  const std::vector<double> torques(one.robot.joints.size(), 0.1);
  for (int i = 0; i < 4; ++i) plant.step(torques);
}

}  // namespace

SPRUNG_FUZZ(simulation_model, model_seeds) {
  const Shipped& one = shipped()[input.byte() % shipped().size()];
  write_file(own_folder() + "model.xml", edited(one.model_xml, input));
  try {
    step(one);
  } catch (const ConfigError&) {  // that is how mistakes are told
  }
}

}  // namespace sprung::fuzz::simulation_model
