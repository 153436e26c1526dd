#include "tools/lab/run/experiments.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::HasSubstr;

std::set<std::string> names_of(const std::vector<Experiment>& experiments) {
  std::set<std::string> out;
  for (const Experiment& experiment : experiments) out.insert(experiment.name);
  return out;
}

TEST(Experiments, EveryOneHasItsOwnNameAQuestionARunAndAnExample) {
  for (const Experiment& experiment : experiments()) {
    EXPECT_FALSE(experiment.what.empty()) << experiment.name;
    EXPECT_EQ(experiment.question.back(), '?') << experiment.name;
    EXPECT_TRUE(experiment.run) << experiment.name;
    EXPECT_THAT(experiment.example, HasSubstr("--")) << experiment.name;
    EXPECT_NO_THROW(load_robot(experiment.robot)) << experiment.name;
  }
  EXPECT_EQ(names_of(experiments()).size(), experiments().size());
}

TEST(Experiments, OptionsOfOneTableAreNotThoseOfAnother) {
  const auto endurance = [](const std::vector<Experiment>& all) {
    return *std::find_if(all.begin(), all.end(), [](const Experiment& e) { return e.name == "endurance"; });
  };
  const Experiment changed = endurance(experiments());
  changed.shorten();
  EXPECT_EQ(changed.own.words(), " --seeds 20 --ensemble 1 --minutes 1");
  EXPECT_EQ(endurance(experiments()).own.words(), " --seeds 20 --ensemble 1 --minutes 10");
}

TEST(Experiments, ALegJumpsAndARobotThatWalksHasExperimentsOfItsOwn) {
  EXPECT_EQ(names_of(experiments_of(load_robot("single_leg"))),
            (std::set<std::string>{"jump", "foot_return", "step_response", "drop", "jump_ensemble",
                                   "adaptation", "estimator", "model_watch", "bring_up"}));
  EXPECT_EQ(names_of(experiments_of(load_robot("pegasus"))),
            (std::set<std::string>{"foot_return", "stand_push", "walk", "ground_error", "push", "endurance",
                                   "adaptation", "estimator", "model_watch", "bring_up", "odometry"}));
}

TEST(Experiments, AJointAloneHasThoseThatNeedNoLeg) {
  EXPECT_EQ(names_of(experiments_of(load_robot("test_axis"))),
            (std::set<std::string>{"friction_sweep", "drag", "estimator", "model_watch"}));
}

/// Its plants are another ensemble than variation.yaml's draws.
TEST(Experiments, APlantIsOfThoseInAllThatTakeOne) {
  Experiment takes, other;
  takes.name = "takes";
  takes.takes = {Common::kPlant};
  other.name = "other";
  takes.run = other.run = [](const ExperimentInput& in) {
    return ExperimentOutput{{row("plant", "", static_cast<double>(in.sim.plant.size()))}};
  };
  ExperimentRequest request;
  request.plant = {"draw=7"};
  const auto finished = run_experiments({takes, other}, request, load_robot("single_leg"), {});
  EXPECT_EQ(finished.at(0).rows.rows.at(0).value, 1.0);
  EXPECT_EQ(finished.at(1).rows.rows.at(0).value, 0.0);
}

TEST(Experiments, PresetsThatTheRobotHasNotAreItsUsualOne) {
  for (const char* name : {"single_leg", "pegasus"}) {
    RobotConfig robot = load_robot(name);
    for (const bool in_all : {false, true}) {
      ExperimentRequest request;
      request.in_all = in_all;
      for (const Experiment& experiment : experiments_of(robot))
        EXPECT_NO_THROW(robot.preset(experiment_input(experiment, request, robot).preset)) << experiment.name;
    }
    robot.presets.erase(robot.presets.begin());
    robot.presets.front().name = "soft";
    for (const Experiment& experiment : experiments_of(robot))
      EXPECT_EQ(experiment_input(experiment, {}, robot).preset, "soft") << experiment.name;
  }
}

}  // namespace
}  // namespace sprung
