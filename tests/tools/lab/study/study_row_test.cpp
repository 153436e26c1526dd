#include "tools/lab/study/study_row.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"
#include "tests/support/paths.h"
#include "tests/support/refusal.h"
#include "tests/tools/lab/study/sample_study.h"
#include "tools/lab/study/study_json.h"

namespace sprung {
namespace {

using testing::HasSubstr;

std::string row_of(const StudyRun& run) {
  LoadedRobot loaded;
  return study_row(run, loaded);
}

TEST(StudyRow, IsTheSameBytesEachTimeAndReadsBack) {
  const test::OwnFolder folder("row");
  const StudyRun run = study_runs(test::study_of(test::kSampleStudy, folder.path()))[3];
  const std::string row = row_of(run);
  EXPECT_EQ(row_of(run), row);
  EXPECT_EQ(row.find('\n'), std::string::npos);
  const StudyResult result = result_of(row);
  EXPECT_EQ(result.number, 4);
  EXPECT_EQ(result.study, run.study);
  EXPECT_EQ(result.failure, "");
  EXPECT_FALSE(result.rows.empty());
  EXPECT_EQ(result.command.rfind("sprung experiment step_response --robot single_leg --seed 2", 0), 0u);
}

TEST(StudyRow, NumbersThatAreSetReachTheRobot) {
  const test::OwnFolder folder("row");
  const std::vector<StudyRun> runs = study_runs(test::study_of(test::kSampleStudy, folder.path()));
  const StudyResult soft = result_of(row_of(runs[0])), firm = result_of(row_of(runs[4]));
  ASSERT_EQ(soft.rows.size(), firm.rows.size());
  bool differs = false;
  for (std::size_t i = 0; i < soft.rows.size(); ++i)
    differs = differs || soft.rows[i].value != firm.rows[i].value;
  EXPECT_TRUE(differs);
}

TEST(StudyRow, ARobotThatWasReadIsUsedAgainForTheSameBytes) {
  const test::OwnFolder folder("row");
  const std::vector<StudyRun> runs = study_runs(test::study_of(test::kSampleStudy, folder.path()));
  LoadedRobot loaded;
  for (const std::size_t i : {0, 1, 4, 5, 0}) EXPECT_EQ(study_row(runs[i], loaded), row_of(runs[i])) << i;
}

TEST(StudyRow, ARobotWhoseFilesChangedIsReadAnew) {
  const test::OwnFolder folder("row");
  const std::string robot = folder.path() / "leg";
  std::filesystem::copy(test::source_dir() + "/robots/single_leg", robot,
                        std::filesystem::copy_options::recursive);
  StudyRun run;
  run.experiment = "step_response";
  run.robot = robot;
  LoadedRobot loaded;
  EXPECT_EQ(result_of(study_row(run, loaded)).failure, "");
  std::ofstream(robot + "/robot.yaml", std::ios::app) << "\nno_such_key: 1\n";
  EXPECT_THAT(result_of(study_row(run, loaded)).failure, HasSubstr("no_such_key"));
}

TEST(StudyRow, ARunThatFailsIsARowWithTheReason) {
  StudyRun run;
  run.number = 1;
  run.experiment = "step_response";
  run.robot = "single_leg";
  run.plant = {"no_such_key=1"};
  const StudyResult result = result_of(row_of(run));
  EXPECT_THAT(result.failure, HasSubstr("no_such_key"));
  EXPECT_TRUE(result.rows.empty());
}

TEST(StudyOrigin, IsAnotherOneWhenAFileOfTheRobotIs) {
  const test::OwnFolder folder("origin");
  const std::string robot = folder.path() / "leg";
  std::filesystem::copy(test::source_dir() + "/robots/single_leg", robot,
                        std::filesystem::copy_options::recursive);
  const std::string before = origin_of(robot).files;
  EXPECT_EQ(before, origin_of("single_leg").files);
  std::ofstream(robot + "/sim.yaml", std::ios::app) << "\n# another one\n";
  EXPECT_NE(origin_of(robot).files, before);
}

TEST(StudyResult, WhatIsNoRowIsRefused) {
  for (const char* text : {"", "{}", "[]", R"({"run":1,"experiment":"jump","robot":"r"})"})
    EXPECT_FALSE(test::refusal_of<std::invalid_argument>([&] { (void)result_of(text); }).empty()) << text;
}

}  // namespace
}  // namespace sprung
