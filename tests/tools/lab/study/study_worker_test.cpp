#include "tools/lab/study/study_worker.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tests/tools/lab/study/sample_study.h"
#include "tools/lab/study/study_json.h"
#include "tools/lab/study/study_row.h"

namespace sprung {
namespace {

using testing::HasSubstr;

std::string answer_to(const std::string& line) {
  LoadedRobot loaded;
  return worker_answer(line, loaded);
}

TEST(StudyWorker, AnswersARunWithItsRow) {
  const test::OwnFolder folder("worker");
  const StudyRun run = study_runs(test::study_of(test::kSampleStudy, folder.path()))[1];
  const WorkerAnswer answer = answer_of(answer_to(run_json(run)));
  EXPECT_EQ(answer.number, 2);
  EXPECT_EQ(answer.error, "");
  LoadedRobot loaded;
  EXPECT_EQ(answer.row, study_row(run, loaded)) << "the bytes go through an engine as they are";
  EXPECT_GT(answer.wall_s, 0.0);
}

TEST(StudyWorker, ABadLineIsAnErrorAndNoEnd) {
  for (const char* line : {"{", "no", R"({"run":3})"}) {
    const WorkerAnswer answer = answer_of(answer_to(line));
    EXPECT_EQ(answer.row, "");
    EXPECT_THAT(answer.error, HasSubstr("no run"));
  }
}

TEST(StudyWorker, ARobotThatThereIsNotIsAnErrorOfTheMachine) {
  const WorkerAnswer answer = answer_of(answer_to(R"({"run":3,"experiment":"jump","robot":"none_such"})"));
  EXPECT_EQ(answer.number, 3);
  EXPECT_THAT(answer.error, HasSubstr("none_such"));
}

TEST(WorkerAnswer, WhatIsNoneIsRefused) {
  for (const char* line : {"", "{}", R"({"run":1})", R"({"run":1,"row":{},"error":"both"})"})
    EXPECT_FALSE(test::refusal_of<std::invalid_argument>([&] { (void)answer_of(line); }).empty()) << line;
}

}  // namespace
}  // namespace sprung
