#include "tools/lab/run/experiment_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/config_error.h"
#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(ExperimentLine, WordsFillTheRequest) {
  const auto asked = asked_experiment({"jump", "--robot", "single_leg", "--seed", "7", "--set",
                                       "presets.best.stand_length=0.44", "--plant", "draw=3", "--plant",
                                       "kt_scale=1.1"});
  EXPECT_EQ(asked->experiment.name, "jump");
  EXPECT_EQ(asked->request.seed, 7u);
  EXPECT_THAT(asked->request.plant, ElementsAre("draw=3", "kt_scale=1.1"));
  EXPECT_EQ(robot_of(asked->request).preset("best").stand_length_m, 0.44);
}

TEST(ExperimentLine, OwnOptionsAreOfThisExperimentAlone) {
  const auto asked = asked_experiment({"jump", "--mode", "torque"});
  EXPECT_EQ(asked->experiment.own.words(), " --mode torque");
  EXPECT_EQ(asked_experiment({"jump"})->experiment.own.words(), " --mode all");
}

TEST(ExperimentLine, TheLineThatRepeatsARunHasTheNumbersThatAreSet) {
  const auto asked = asked_experiment({"jump", "--set", "presets.best.stand_length=0.44"});
  const ExperimentInput input = experiment_input(asked->experiment, asked->request, robot_of(asked->request));
  EXPECT_THAT(input.command, HasSubstr("--set presets.best.stand_length=0.44"));
}

std::string wrong_use(const std::vector<std::string>& words) {
  return test::refusal_of<WrongUse>([&] {
    const auto asked = asked_experiment(words);
    (void)experiment_input(asked->experiment, asked->request, robot_of(asked->request));
  });
}

TEST(ExperimentLine, WhatMakesNoSenseIsSaid) {
  EXPECT_THAT(wrong_use({}), HasSubstr("there are: jump"));
  EXPECT_THAT(wrong_use({"jumpp"}), HasSubstr("did you mean"));
  EXPECT_THAT(wrong_use({"jump", "--sed", "3"}), HasSubstr("--sed"));
  EXPECT_THAT(wrong_use({"jump", "--set", "nothing"}), HasSubstr("KEY=NUMBER"));
  EXPECT_THAT(wrong_use({"jump", "--set", "a=0.4 m"}), HasSubstr("number alone"));
  EXPECT_THAT(wrong_use({"jump", "--set", "presets.best.stand_length=0.44", "--set",
                         "presets.best.stand_length=0.45"}),
              HasSubstr("twice"));
  EXPECT_THAT(wrong_use({"jump", "--separate", "--set", "presets.best.stand_length=0.44"}),
              HasSubstr("one process"));
  EXPECT_THAT(wrong_use({"bring_up", "--set", "presets.best.stand_length=0.44"}),
              HasSubstr("reads robot.yaml itself"));
}

TEST(ExperimentLine, NumbersThatTheRobotHasNotAreNamedWithTheFile) {
  const auto said = [](const std::string& number) {
    return test::refusal_of<ConfigError>([&] {
      (void)robot_of(asked_experiment({"jump", "--set", number})->request);
    });
  };
  EXPECT_THAT(said("presets.best.none=1"), AllOf(HasSubstr("robot.yaml"), HasSubstr("presets.best.none")));
  EXPECT_THAT(said("presets.best.stand_length=-3"), HasSubstr("stand_length"));
}

}  // namespace
}  // namespace sprung
