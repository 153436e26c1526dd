#include "tools/lab/study/study_folder_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <filesystem>
#include <fstream>

#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tests/tools/lab/study/sample_study.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

class StudyFolderTest : public testing::Test {
 protected:
  std::string out() const { return folder_.path() / "out"; }
  std::string refusal(const std::function<void()>& act) const {
    return test::refusal_of<std::runtime_error>(act);
  }
  test::OwnFolder folder_{"study_folder"};
  const Study study_ = test::study_of(test::kSampleStudy, folder_.path());
  const std::vector<StudyRun> runs_ = study_runs(study_);
  LoadedRobot loaded_;
};

TEST_F(StudyFolderTest, KeepsRowsAndSaysWhichAreThere) {
  const StudyFolder folder(out(), study_);
  const std::string row = study_row(runs_[2], loaded_);
  folder.keep(row);
  folder.keep(row);
  EXPECT_TRUE(folder.has(3));
  EXPECT_FALSE(folder.has(1));
  EXPECT_THAT(folder.done(), ElementsAre(3));
  EXPECT_EQ(folder.row(3), row);
  EXPECT_EQ(StudyFolder(out()).runs(), 8);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out() + "/rows"), {}), 1)
      << "nothing is left beside";
}

TEST_F(StudyFolderTest, AnotherStudyIsRefusedAndWhatIsThereStays) {
  StudyFolder(out(), study_).keep(study_row(runs_[0], loaded_));
  std::string text = test::kSampleStudy;
  text.replace(text.find("1..2"), 4, "1..3");
  const Study other = test::study_of(text, folder_.path());
  EXPECT_THAT(refusal([&] { StudyFolder(out(), other); }),
              AllOf(HasSubstr(out()), HasSubstr("take another folder")));
  EXPECT_THAT(StudyFolder(out()).done(), ElementsAre(1));
  EXPECT_THAT(refusal([&] { StudyFolder(out()).keep(study_row(study_runs(other)[0], loaded_)); }),
              HasSubstr("another study"));
}

TEST_F(StudyFolderTest, RowsOfAnotherBuildAreRefused) {
  const StudyFolder folder(out(), study_);
  std::string row = study_row(runs_[0], loaded_);
  const std::size_t at = row.find("\"version\":\"") + 11;
  row.replace(at, 1, "9");
  EXPECT_THAT(refusal([&] { folder.keep(row); }), AllOf(HasSubstr("made with sprung 9"), HasSubstr("run 1")));
}

TEST_F(StudyFolderTest, FailuresAreForgottenWhenTheirRowComes) {
  const StudyFolder folder(out(), study_);
  folder.note_failure(1, "too late");
  folder.note_failure(2, "its worker ended");
  folder.keep(study_row(runs_[0], loaded_));
  EXPECT_EQ(folder.failures(), (std::map<std::int64_t, std::string>{{2, "its worker ended"}}));
}

TEST_F(StudyFolderTest, ADiskThatIsFullIsSaidAndLeavesNoHalfRow) {
  const StudyFolder folder(out(), study_);
  folder.keep(study_row(runs_[0], loaded_));
  const std::string row = study_row(runs_[1], loaded_);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit before{};
  getrlimit(RLIMIT_FSIZE, &before);
  const rlimit full{100, before.rlim_max};
  setrlimit(RLIMIT_FSIZE, &full);
  const std::string said = refusal([&] { folder.keep(row); });
  setrlimit(RLIMIT_FSIZE, &before);
  EXPECT_THAT(said,
              AllOf(HasSubstr("rows/2.json cannot be written"), HasSubstr("run the same command again")));
  EXPECT_THAT(folder.done(), ElementsAre(1));
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(out() + "/rows"), {}), 1);
  folder.keep(row);
  EXPECT_THAT(folder.done(), ElementsAre(1, 2));
}

TEST_F(StudyFolderTest, WhatIsNoFolderOfAStudyIsSaid) {
  EXPECT_THAT(refusal([&] { StudyFolder(folder_.path()); }), HasSubstr("no study.json"));
}

TEST_F(StudyFolderTest, TimesAreKeptBesideTheRows) {
  const StudyFolder folder(out(), study_);
  folder.note_time(1, 0.5);
  folder.note_time(2, 0.25);
  std::ifstream times(out() + "/times.jsonl");
  const std::string text{std::istreambuf_iterator<char>(times), {}};
  EXPECT_EQ(text, "{\"run\":1,\"wall_s\":0.5}\n{\"run\":2,\"wall_s\":0.25}\n");
}

}  // namespace
}  // namespace sprung
