#include "tools/lab/run/experiment_all.h"

#include <gtest/gtest.h>

#include <mutex>
#include <stdexcept>

namespace sprung {
namespace {

/// Answers with the number of threads that it was given.
ExperimentEntry entry(const std::string& name, bool many_cases) {
  return {name, "best", "?", many_cases, [name](const ExperimentInput& input) {
            ExperimentOutput output;
            output.rows.experiment = name;
            output.rows.rows = {{name + ".jobs", "", static_cast<double>(input.jobs), {}, {}, {}}};
            return output;
          }};
}

TEST(RunExperiments, BigOnesHaveAllThreadsAndTheOthersOneEachInTheOrderAsked) {
  ExperimentInput input;
  input.jobs = 3;
  std::vector<std::size_t> progress;
  const auto finished = run_experiments({entry("a", false), entry("b", true), entry("c", false)}, input,
                                        [&](std::size_t done, std::size_t count) {
                                          EXPECT_EQ(count, 3u);
                                          progress.push_back(done);
                                        });
  ASSERT_EQ(finished.size(), 3u);
  EXPECT_EQ(finished[0].output.rows.rows[0].name, "a.jobs");
  EXPECT_EQ(finished[0].output.rows.rows[0].value, 1.0);
  EXPECT_EQ(finished[1].output.rows.rows[0].name, "b.jobs");
  EXPECT_EQ(finished[1].output.rows.rows[0].value, 3.0);
  EXPECT_EQ(finished[2].output.rows.rows[0].name, "c.jobs");
  EXPECT_EQ(progress, (std::vector<std::size_t>{1, 2, 3}));
}

TEST(RunExperiments, OneThatFailsIsNamedAndDoesNotStopTheOthers) {
  ExperimentEntry broken = entry("broken", false);
  broken.run = [](const ExperimentInput&) -> ExperimentOutput { throw std::runtime_error("leg fell off"); };
  ExperimentEntry broken_big = broken;
  broken_big.many_cases = true;
  const auto finished = run_experiments({broken, broken_big, entry("good", false)}, {}, {});
  EXPECT_EQ(finished[0].failure, "leg fell off");
  EXPECT_EQ(finished[1].failure, "leg fell off");
  EXPECT_FALSE(finished[0].ok());
  EXPECT_TRUE(finished[2].ok());
}

TEST(FinishedExperiment, IsNotOkWhereARowIsBeyondItsBounds) {
  FinishedExperiment finished{entry("a", false), {}, ""};
  finished.output.rows.rows = {{"a.b", "mm", 5.0, {}, {}, 4.0}};
  EXPECT_FALSE(finished.ok());
  finished.output.rows.rows[0].value = 3.0;
  EXPECT_TRUE(finished.ok());
}

}  // namespace
}  // namespace sprung
