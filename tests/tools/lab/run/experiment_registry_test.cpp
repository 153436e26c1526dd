#include "tools/lab/run/experiment_registry.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "robots/robot_loader.h"

namespace sprung {
namespace {

using testing::HasSubstr;

TEST(ExperimentRegistry, EveryExperimentOfTheSingleLegHasItsOwnNameAndAPresetThatThereIs) {
  const RobotConfig robot = load_robot("single_leg");
  std::set<std::string> names;
  for (const ExperimentEntry& entry : experiments_of(robot)) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_NO_THROW(robot.preset(entry.preset)) << entry.name;
    EXPECT_FALSE(entry.question.empty()) << entry.name;
    EXPECT_TRUE(entry.run) << entry.name;
  }
  EXPECT_TRUE(names.count("jump"));
}

TEST(ExperimentRegistry, ARobotWithOnePresetOfAnotherNameRunsInIt) {
  for (const char* name : {"single_leg", "pegasus"}) {
    RobotConfig robot = load_robot(name);
    robot.presets.erase(robot.presets.begin());
    robot.presets.front().name = "soft";
    for (const ExperimentEntry& entry : experiments_of(robot)) EXPECT_EQ(entry.preset, "soft") << entry.name;
  }
}

TEST(ExperimentRegistry, ARobotThatWalksHasExperimentsOfItsOwnAndNoJumps) {
  const RobotConfig robot = load_robot("pegasus");
  std::set<std::string> names;
  for (const ExperimentEntry& entry : experiments_of(robot)) {
    EXPECT_TRUE(names.insert(entry.name).second) << entry.name;
    EXPECT_NO_THROW(robot.preset(entry.preset)) << entry.name;
    EXPECT_FALSE(entry.question.empty()) << entry.name;
  }
  for (const char* name : {"walk", "ground_error", "push", "endurance"})
    EXPECT_TRUE(names.count(name)) << name;
  EXPECT_FALSE(names.count("jump"));
}

TEST(ExperimentRegistry, TheCommandOfAnEntryRunsItAlone) {
  const ExperimentEntry entry{"jump", "paper", "", false, {}};
  EXPECT_EQ(entry.command("single_leg", 7),
            "sprung experiment jump --robot single_leg --preset paper --seed 7");
}

TEST(ExperimentRegistry, ARobotThatCannotStandIsRefusedWithTheReason) {
  for (const char* name : {"test_axis"}) {
    try {
      experiments_of(load_robot(name));
      FAIL() << name;
    } catch (const std::invalid_argument& error) {
      EXPECT_THAT(error.what(), HasSubstr(name));
      EXPECT_THAT(error.what(), HasSubstr("friction_sweep"));
    }
  }
}

}  // namespace
}  // namespace sprung
