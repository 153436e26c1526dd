#include "tools/lab/terrain/terrain_experiment.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>

#include "robots/config_error.h"
#include "robots/robot_loader.h"
#include "tools/lab/run/experiment_line.h"

namespace sprung {
namespace {

TerrainTask slope() { return {"slope_up", "a ramp, up", "deg", {2.0, 4.0, 8.0}, {}, {{"trot", 4.0}}}; }

TerrainOutcome reached(const TerrainTask& task, const std::string& gait, int level) {
  TerrainOutcome out;
  out.task = &task;
  out.gait = gait;
  out.level = level;
  return out;
}

TEST(TerrainExperiment, RowIsTheHardestLevelAgainstWhatIsWantedOfThatGait) {
  const TerrainTask task = slope();
  EXPECT_EQ(terrain_row(reached(task, "trot", 1)).name, "terrain.slope_up.trot.level");
  EXPECT_EQ(terrain_row(reached(task, "trot", 2)).value, 8.0);
  EXPECT_TRUE(terrain_row(reached(task, "trot", 1)).ok());
  EXPECT_FALSE(terrain_row(reached(task, "trot", 0)).ok());
  EXPECT_TRUE(std::isnan(terrain_row(reached(task, "trot", -1)).value));
  EXPECT_FALSE(terrain_row(reached(task, "trot", -1)).ok());
  EXPECT_TRUE(terrain_row(reached(task, "amble", -1)).ok());  // nothing is wanted of it
}

TEST(TerrainExperiment, OfFrictionLessIsHarder) {
  TerrainTask task = slope();
  task.levels = {0.8, 0.4, 0.2};
  task.wanted = {{"trot", 0.4}};
  EXPECT_FALSE(terrain_row(reached(task, "trot", 0)).ok());
  EXPECT_TRUE(terrain_row(reached(task, "trot", 2)).ok());
}

TEST(TerrainExperiment, PayloadRowsAreTheWorstOfWhoPassedTheHardestLevel) {
  const TerrainTask task = slope();
  TerrainOutcome outcome = reached(task, "trot", 1);
  TerrainRun near, far, fell;
  near.stood_mass_off_kg = 1.0;
  far.stood_mass_off_kg = 2.5;
  far.walked_com_off_m = 0.012;
  fell.why = "fell: tilted";
  outcome.tried = {{2, {fell}}, {1, {near, far, fell}}};
  const std::vector<ReportRow> rows = payload_rows(outcome);
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_EQ(rows[0].name, "terrain.payload.trot.stood_mass_off");
  EXPECT_EQ(rows[0].value, 2.5);
  EXPECT_NEAR(rows[3].value, 12.0, 1e-9);
  EXPECT_TRUE(std::isnan(rows[2].value)) << "nobody said";
  EXPECT_TRUE(payload_rows(reached(task, "trot", -1)).empty());
}

TEST(TerrainExperiment, SectionTellsWhoDidNotPassAndWhy) {
  const TerrainTask task = slope();
  TerrainOutcome outcome = reached(task, "trot", 0);
  TerrainRun passed, fell;
  passed.draw = 1001.0;
  fell.draw = 1002.0;
  fell.why = "fell: tilted";
  fell.vitals.fell = true;
  fell.vitals.fell_at_s = 3.5;
  outcome.tried = {{1, {passed, fell}}};
  EXPECT_EQ(outcome.tried.front().passed(), 1);
  const auto how_to_see = [](double level, double draw) {
    return report::number_text(level) + ", " + report::number_text(draw);
  };
  const report::Section section = terrain_section(outcome, how_to_see);
  ASSERT_EQ(section.tables.size(), 2u);
  ASSERT_EQ(section.tables.back().rows.size(), 1u);
  const auto& row = section.tables.back().rows.front();
  EXPECT_EQ(row[1].text, "1002");
  EXPECT_EQ(row[2].text, "fell: tilted");
  EXPECT_EQ(row[3].text, "3.5");
  EXPECT_EQ(row[4].text, "4, 1002");
  outcome.tried = {{1, {passed}}};
  EXPECT_EQ(terrain_section(outcome, how_to_see).tables.size(), 1u);
}

TEST(TerrainExperiment, PageOfAFailureIsNamedAfterWhatWasTriedAndLedTo) {
  const TerrainTask task = slope();
  TerrainOutcome outcome = reached(task, "trot", 0);
  EXPECT_EQ(terrain_page_name(outcome, 2, 1012.0), "terrain.slope_up.trot.8.draw1012");
  TerrainRun fell;
  fell.why = "fell: tilted";
  fell.page = "a.html";
  outcome.tried = {{2, {fell}}};
  const report::Section section = terrain_section(outcome, [](double, double) { return ""; });
  EXPECT_EQ(section.tables.back().rows.front()[2].link, "a.html");
}

/// A trot on the steepest ramp does not pass; what is asked to be played again falls as it did.
TEST(TerrainExperiment, OfWhoDoesNotPassThereIsAPageWhereThereIsAFolderForIt) {
  Experiment experiment = terrain_experiment();
  CommandLine line("terrain", "");
  experiment.own.add_to(line);
  line.action([] { return 0; });
  const char* const words[] = {"terrain", "--only", "slope_up", "--gait", "trot",
                               "--level", "21.3",   "--runs",   "1"};
  ASSERT_EQ(line.run(9, words), 0);
  ExperimentRequest request;
  request.robot = "pegasus";
  ExperimentInput input = experiment_input(experiment, request, load_robot("pegasus"));
  std::vector<std::string> pages;
  int robots = 0;
  InProcessRobot::observe_all_by([&](const RobotConfig&, const std::string&, const SimOptions&) {
    ++robots;
    return nullptr;
  });
  input.play_page = [&](const std::string& name, const std::function<void()>& again) {
    pages.push_back(name);
    robots = 0;
    again();
    return name + ".html";
  };
  const ExperimentOutput out = experiment.run(input);
  InProcessRobot::observe_all_by({});
  ASSERT_EQ(pages, std::vector<std::string>{"terrain.slope_up.trot.21.3.draw1011"});
  EXPECT_EQ(robots, 1) << "the first is the one that is played";
  EXPECT_EQ(out.sections.front().tables.back().rows.front()[2].link, pages.front() + ".html");
}

ExperimentOutput tried(const char* option, const char* value) {
  Experiment experiment = terrain_experiment();
  CommandLine line("terrain", "");
  experiment.own.add_to(line);
  line.action([] { return 0; });
  const char* const words[] = {"terrain", option, value};
  EXPECT_EQ(line.run(3, words), 0);
  ExperimentRequest request;
  request.robot = "pegasus";
  return experiment.run(experiment_input(experiment, request, load_robot("pegasus")));
}

TEST(TerrainExperiment, WrongWordsAreRefused) {
  EXPECT_THROW(tried("--gait", "amble"), std::invalid_argument);
  EXPECT_THROW(tried("--gait", "stand"), std::invalid_argument);
  EXPECT_THROW(tried("--distance", "0"), std::invalid_argument);
  EXPECT_THROW(tried("--runs", "0"), std::invalid_argument);
  EXPECT_THROW(tried("--level", "8.5"), std::invalid_argument);
  EXPECT_THROW(tried("--level", "8.4"), std::invalid_argument) << "slopes have it, others have not";
}

TEST(TerrainExperiment, AWorldThatThereIsNotIsRefusedBeforeAnythingRuns) {
  EXPECT_THROW(tried("--world", "mars"), ConfigError);
}

/// What is asked for beside the tasks is in it, and sprung takes it.
TEST(TerrainExperiment, CommandThatShowsAFailureRepeatsThatRunAlone) {
  const auto words_of = [](const TerrainTask& task) {
    const std::string line = terrain_repeat(
        " --robot pegasus --preset best --set a=1 --plant draw=3 --seed 2", reached(task, "trot", 0), 0.5,
        1002.0, 4.0);
    EXPECT_EQ(line.rfind("sprung experiment --logs F terrain ", 0), 0u) << line;
    std::istringstream in(line.substr(std::string("sprung experiment --logs F ").size()));
    std::vector<std::string> words;
    for (std::string word; in >> word && word.find(';') == std::string::npos;) words.push_back(word);
    words.push_back("1");  // of "--runs 1;"
    return words;
  };
  for (const TerrainTask& task : {slope(), world_task("some/hills.yaml")}) {
    const auto asked = asked_experiment(words_of(task));
    EXPECT_EQ(asked->request.seed, 2u);
    EXPECT_EQ(asked->request.set, std::vector<std::string>{"a=1"});
    EXPECT_EQ(asked->request.plant, (std::vector<std::string>{"draw=3", "draw=1002"}));
    const std::string own = asked->experiment.own.words();
    for (const char* part : {" --gait trot", " --level 0.5", " --runs 1", " --distance 4"})
      EXPECT_NE(own.find(part), std::string::npos) << own;
    EXPECT_NE(own.find(task.world.empty() ? " --only slope_up" : " --world some/hills.yaml"),
              std::string::npos)
        << own;
  }
}

TEST(TerrainExperiment, ItDrawsItsPlantsItself) {
  ExperimentRequest request;
  request.robot = "pegasus";
  request.plants = 3;
  EXPECT_THROW(experiment_input(terrain_experiment(), request, load_robot("pegasus")), WrongUse);
}

}  // namespace
}  // namespace sprung
