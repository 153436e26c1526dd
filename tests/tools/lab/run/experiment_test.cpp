#include "tools/lab/run/experiment.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <stdexcept>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::HasSubstr;

/// Answers with the number of threads that it was given.
Experiment threads_experiment(const std::string& name, bool many_cases) {
  Experiment out;
  out.name = name;
  out.question = "How many?";
  out.takes = {Common::kPreset};
  out.many_cases = many_cases;
  out.run = [name](const ExperimentInput& input) {
    return ExperimentOutput{{row(name + ".jobs", "", input.parallel.jobs)}, 2.5};
  };
  return out;
}

const RobotConfig& leg() {
  static const RobotConfig robot = load_robot("single_leg");
  return robot;
}

TEST(OwnOptions, StandInTheLineThatRepeatsARun) {
  int seeds = 50;
  double minutes = 0.5;
  std::string joint, mode = "hybrid";
  std::vector<std::string> vary{"a=1:2", "b=3:4"};
  bool ablation = false;
  OwnOptions own;
  own.option("--seeds", seeds, "");
  own.option("--minutes", minutes, "");
  own.option("--joint", joint, "");
  own.choice("--mode", mode, {"hybrid", "torque"}, "");
  own.option("--vary", vary, "");
  own.flag("--ablation", ablation, "");
  EXPECT_EQ(own.words(), " --seeds 50 --minutes 0.5 --mode hybrid --vary a=1:2 --vary b=3:4");
  CommandLine line("experiment", "");
  own.add_to(line);
  line.action([] { return 0; });
  const char* const words[] = {"experiment", "--seeds", "3",      "--joint",
                               "knee",       "--mode",  "torque", "--ablation"};
  ASSERT_EQ(line.run(8, words), 0);
  EXPECT_EQ(own.words(),
            " --seeds 3 --minutes 0.5 --joint knee --mode torque --vary a=1:2 --vary b=3:4 --ablation");
  const char* const wrong[] = {"experiment", "--mode", "wild"};
  EXPECT_EQ(line.run(3, wrong), kExitWrongUse);
}

TEST(Named, IsTheValueOfThatName) {
  constexpr JumpMode kSome[] = {JumpMode::kTorque, JumpMode::kHybrid};
  EXPECT_EQ(names(kSome), (std::vector<std::string>{"torque", "hybrid"}));
  EXPECT_EQ(named(kSome, "hybrid"), JumpMode::kHybrid);
  EXPECT_THROW(named(kSome, "position"), std::invalid_argument);
}

TEST(ExperimentInput, HoldsWhatWasAskedAndTheLineThatRepeatsIt) {
  Experiment experiment = threads_experiment("jump", false);
  experiment.presets = {"best", "paper"};
  ExperimentRequest request;
  request.seed = 7;
  EXPECT_EQ(experiment_input(experiment, request, leg()).command,
            "sprung experiment jump --robot single_leg --preset best --seed 7");
  request.in_all = true;
  EXPECT_EQ(experiment_input(experiment, request, leg()).preset, "paper");
  int seeds = 3;
  experiment.own.option("--seeds", seeds, "");
  request.plant = {"noise_scale=2", "friction_scale=1.25"};
  request.separate = true;
  request.jobs = 4;
  const ExperimentInput input = experiment_input(experiment, request, leg());
  EXPECT_EQ(input.command,
            "sprung experiment jump --robot single_leg --preset paper --plant noise_scale=2 --plant "
            "friction_scale=1.25 --seed 7 --seeds 3 --separate");
  EXPECT_EQ(input.sim.seed, 7u);
  EXPECT_EQ(input.sim.plant.at("friction_scale"), 1.25);
  EXPECT_EQ(input.parallel.jobs, 1);  // separate processes run one after the other
  EXPECT_THROW(refuse_separate(input), std::invalid_argument);
}

TEST(ExperimentInput, WhatCannotBeIsRefused) {
  Experiment experiment = threads_experiment("walk", true);
  ExperimentRequest request;
  request.preset = "worst";
  EXPECT_THROW(experiment_input(experiment, request, leg()), std::invalid_argument);
  request.preset = "";
  request.plant = {"friction"};
  EXPECT_THROW(experiment_input(experiment, request, leg()), std::invalid_argument);
  request.plant = {};
  experiment.needs_gaits = true;
  try {
    experiment_input(experiment, request, leg());
    FAIL() << "a leg alone walks";
  } catch (const WrongUse& error) {
    EXPECT_THAT(error.what(), HasSubstr("experiment walk needs a robot that walks; single_leg has no gaits"));
  }
}

TEST(RunExperiment, RowsStandUnderWhatTheyWereRunOn) {
  ExperimentRequest request;
  request.seed = 5;
  request.preset = "paper";
  const Experiment experiment = threads_experiment("a", false);
  const FinishedExperiment finished = run_experiment(experiment,
                                                     experiment_input(experiment, request, leg()));
  EXPECT_EQ(finished.rows.experiment, "a");
  EXPECT_EQ(finished.rows.robot, "single_leg");
  EXPECT_EQ(finished.rows.preset, "paper");
  EXPECT_EQ(finished.rows.seed, 5u);
  EXPECT_EQ(finished.rows.simulated_s, 2.5);
  ASSERT_EQ(finished.rows.rows.size(), 1u);
  EXPECT_EQ(finished.question, "How many?");
}

TEST(RunExperiments, BigOnesHaveAllThreadsAndTheOthersOneEachInTheOrderAsked) {
  ExperimentRequest request;
  request.jobs = 3;
  std::vector<std::size_t> progress;
  const auto finished = run_experiments(
      {threads_experiment("a", false), threads_experiment("b", true), threads_experiment("c", false)},
      request, leg(), [&](std::size_t done, std::size_t count) {
        EXPECT_EQ(count, 3u);
        progress.push_back(done);
      });
  ASSERT_EQ(finished.size(), 3u);
  EXPECT_EQ(finished[0].rows.rows[0].name, "a.jobs");
  EXPECT_EQ(finished[0].rows.rows[0].value, 1.0);
  EXPECT_EQ(finished[1].rows.rows[0].name, "b.jobs");
  EXPECT_EQ(finished[1].rows.rows[0].value, 3.0);
  EXPECT_EQ(finished[2].rows.rows[0].name, "c.jobs");
  EXPECT_EQ(progress, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(RunExperiments, OneThatFailsIsNamedAndDoesNotStopTheOthers) {
  Experiment broken = threads_experiment("broken", false);
  broken.run = [](const ExperimentInput&) -> ExperimentOutput { throw std::runtime_error("leg fell off"); };
  Experiment broken_big = broken;
  broken_big.many_cases = true;
  const auto finished = run_experiments({broken, broken_big, threads_experiment("good", false)}, {}, leg(),
                                        {});
  EXPECT_EQ(finished[0].failure, "leg fell off");
  EXPECT_EQ(finished[0].rows.preset, "best");
  EXPECT_EQ(finished[1].failure, "leg fell off");
  EXPECT_FALSE(finished[0].ok());
  EXPECT_TRUE(finished[2].ok());
}

TEST(RunExperiments, ShortensBeforeItWritesTheLine) {
  double minutes = 10.0;
  Experiment experiment = threads_experiment("endurance", true);
  experiment.own.option("--minutes", minutes, "");
  experiment.shorten = [&minutes] { minutes = 1.0; };
  EXPECT_THAT(run_experiments({experiment}, {}, leg(), {})[0].command, HasSubstr("--minutes 1"));
}

TEST(FinishedExperiment, IsNotOkWhereARowIsBeyondItsBounds) {
  FinishedExperiment finished;
  finished.rows.rows = {row("a.b", "mm", 5.0, at_most(4.0))};
  EXPECT_FALSE(finished.ok());
  finished.rows.rows[0].value = 3.0;
  EXPECT_TRUE(finished.ok());
}

}  // namespace
}  // namespace sprung
