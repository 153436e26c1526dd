/// What preset `paper` reproduces stays what it is when a joint of the robot is identified; preset `best`
/// makes use of it.
#include <gtest/gtest.h>

#include <cmath>

#include "robots/robot_loader.h"
#include "tools/lab/jump/jump_experiment.h"

namespace sprung {
namespace {

RobotConfig single_leg(bool identified) {
  RobotConfig robot = load_robot("single_leg");
  for (JointConfig& joint : robot.joints) {
    if (!identified) continue;
    joint.friction.emplace();
    joint.friction->model = FrictionModelKind::kViscous;
    joint.friction->parameters.coulomb_Nm = 7.0;
    joint.friction->parameters.viscous_Nm_s_rad = 0.2;
  }
  return robot;
}

/// Of the three modes of S0; mode adaptive jumps under preset `best` whatever the preset.
std::vector<double> figures(bool identified, const std::string& preset) {
  const JumpExperiment experiment = run_jump_experiment(single_leg(identified), preset, SimOptions{},
                                                        run_in_process);
  std::vector<double> values;
  for (const MeasuredJump& jump : experiment.jumps) {
    if (jump.preset != preset) continue;
    for (const JumpQuantity& quantity : jump_quantities()) {
      const double value = jump.result.*quantity.value;
      values.push_back(std::isnan(value) ? -1.0 : value);
    }
  }
  return values;
}

TEST(IdentifiedFriction, FiguresOfPresetPaperStayTheSameToTheBit) {
  const std::vector<double> before = figures(false, "paper");
  EXPECT_FALSE(before.empty());
  EXPECT_EQ(figures(true, "paper"), before);
}

TEST(IdentifiedFriction, PresetBestMakesUseOfIt) { EXPECT_NE(figures(true, "best"), figures(false, "best")); }

}  // namespace
}  // namespace sprung
