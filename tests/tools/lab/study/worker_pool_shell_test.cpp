#include "tools/lab/study/worker_pool_shell.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/own_folder.h"
#include "tests/support/paths.h"
#include "tests/tools/lab/study/sample_study.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class WorkerPool : public testing::Test {
 protected:
  PoolResult run(const StudyFolder& folder, PoolOptions options) const {
    return run_pool(runs_, folder, options);
  }
  static std::vector<std::string> worker() { return {test::bin_dir() + "/sprung", "study", "worker"}; }
  /// A real worker that, each time it is started, answers so many runs and then dies in the middle of one.
  static std::vector<std::string> dying_after(int answers) {
    const std::string feed = "for i in $(seq " + std::to_string(answers) +
                             "); do read -r line; echo \"$line\"; done | ";
    return {"/bin/sh", "-c", feed + worker()[0] + " study worker; kill -9 $$"};
  }
  std::string out() const { return folder_.path() / "out"; }

  test::OwnFolder folder_{"pool"};
  const Study study_ = test::study_of(test::kSampleStudy, folder_.path());
  const std::vector<StudyRun> runs_ = study_runs(study_);
};

TEST_F(WorkerPool, OneAndThreeWorkersGiveTheSameBytes) {
  const StudyFolder one(out() + "1", study_), three(out() + "3", study_);
  const PoolResult alone = run(one, {1, 60.0, worker()}), many = run(three, {3, 60.0, worker()});
  EXPECT_EQ(alone.kept, 8);
  EXPECT_EQ(many.kept, 8);
  for (const StudyRun& one_run : runs_) EXPECT_EQ(one.row(one_run.number), three.row(one_run.number));
}

TEST_F(WorkerPool, RunsOfWorkersThatDieAreGivenToOthers) {
  const StudyFolder folder(out(), study_);
  const PoolResult result = run(folder, {2, 60.0, dying_after(2)});
  EXPECT_EQ(result.kept, 8);
  EXPECT_EQ(result.failed, 0);
  EXPECT_GE(result.workers_lost, 2);
}

TEST_F(WorkerPool, ARunThatEndsEveryWorkerIsGivenUpAndSaid) {
  const StudyFolder folder(out(), study_);
  const PoolResult result = run(folder, {2, 60.0, {"/bin/sh", "-c", "read -r line; exit 3"}});
  EXPECT_EQ(result.kept, 0);
  EXPECT_EQ(result.failed, 8);
  EXPECT_THAT(folder.failures().at(1), HasSubstr("ended 10 times, the last one: exit status 3"));
}

TEST_F(WorkerPool, ARunThatHangsIsStoppedAndSaid) {
  const StudyFolder folder(out(), study_);
  const PoolResult result = run(folder, {8, 0.2, {"/bin/sleep", "600"}});
  EXPECT_EQ(result.failed, 8);
  EXPECT_EQ(result.workers_lost, 0);
  EXPECT_THAT(folder.failures().at(8), HasSubstr("longer than 0.2 s"));
}

TEST_F(WorkerPool, StopsWhenAskedAndKeepsWhatIsDone) {
  const StudyFolder folder(out(), study_);
  PoolOptions options{1, 60.0, worker()};
  options.stops = [&] { return folder.done().size() >= 2; };
  const PoolResult result = run(folder, options);
  EXPECT_TRUE(result.stopped);
  EXPECT_EQ(folder.done().size(), 2u);
}

}  // namespace
}  // namespace sprung
