#include "tools/lab/study/study.h"

#include <gtest/gtest.h>

#include <set>

namespace sprung {
namespace {

Study two_by_three() {
  Study study;
  study.experiment = "jump";
  study.robot = "single_leg";
  study.parameters = {{"a", "N/m", 2.0, 1.0, 4.0, false, {1.0, 4.0}},
                      {"b", "", 0.5, 0.0, 1.0, false, {0.0, 0.5, 1.0}}};
  study.plants = {{"draw=1"}, {"draw=2"}};
  study.seeds = {7, 8};
  return study;
}

TEST(StudySets, AreEveryCombinationTheLastParameterFirstThrough) {
  const auto sets = study_sets(two_by_three());
  ASSERT_EQ(sets.size(), 6u);
  EXPECT_EQ(sets[0], (std::vector<double>{1.0, 0.0}));
  EXPECT_EQ(sets[1], (std::vector<double>{1.0, 0.5}));
  EXPECT_EQ(sets[5], (std::vector<double>{4.0, 1.0}));
}

TEST(StudySets, SamplesLieInTheRangesAndNoTwoAreTheSame) {
  Study study = two_by_three();
  study.samples = 50;
  std::set<std::vector<double>> seen;
  for (const std::vector<double>& set : study_sets(study)) {
    EXPECT_TRUE(seen.insert(set).second);
    EXPECT_GE(set[0], 1.0);
    EXPECT_LE(set[0], 4.0);
  }
  EXPECT_EQ(seen.size(), 50u);
}

TEST(StudySets, OneWithoutNumbersWhereNothingIsVaried) {
  Study study = two_by_three();
  study.parameters.clear();
  EXPECT_EQ(study_sets(study), std::vector<std::vector<double>>(1));
  EXPECT_EQ(run_count(study), 4);
}

TEST(FirstSets, BeginWithTheRobotsOwnNumbersThenFillTheRangesEvenly) {
  Study study = two_by_three();
  study.parameters[0].present = 9.0;  // beyond its range
  study.tuning = StudyTuning{};
  study.tuning->trials = 50;
  const auto sets = first_sets(study);
  ASSERT_EQ(sets.size(), 30u);
  EXPECT_EQ(sets[0], (std::vector<double>{4.0, 0.5}));
  EXPECT_EQ(sets[1], (std::vector<double>{2.5, 0.5}));
  int low = 0;
  for (std::size_t i = 1; i < sets.size(); ++i) low += sets[i][1] < 0.5 ? 1 : 0;
  EXPECT_NEAR(low, 14.5, 2.0);
  study.tuning->seed = 1;
  EXPECT_NE(first_sets(study)[1], sets[1]);
}

TEST(StudyRuns, StandSetByPlantBySeedAndAreNumberedFromOne) {
  const std::vector<StudyRun> runs = study_runs(two_by_three());
  ASSERT_EQ(runs.size(), 24u);
  EXPECT_EQ(run_count(two_by_three()), 24);
  EXPECT_EQ(runs[0].number, 1);
  EXPECT_EQ(runs[1].seed, 8u);
  EXPECT_EQ(runs[2].plant, std::vector<std::string>{"draw=2"});
  EXPECT_EQ(runs[3].parameters.at("b"), 0.0);
  EXPECT_EQ(runs[4].parameters.at("b"), 0.5);
  EXPECT_EQ(runs[23].number, 24);
}

TEST(StudyHash, IsAnotherOneForAnotherStudyAlone) {
  const std::string same = study_hash(two_by_three());
  Study study = two_by_three();
  study.file = "elsewhere.yaml";
  study.timeout_s = 5.0;
  EXPECT_EQ(study_hash(study), same);
  study.seeds.push_back(9);
  EXPECT_NE(study_hash(study), same);
}

TEST(StudyParameter, LogarithmicRangesCountByRatio) {
  const StudyParameter one{"a", "", 1.0, 1.0, 100.0, true, {}};
  EXPECT_EQ(one.at(0.0), 1.0);
  EXPECT_EQ(one.at(0.5), 10.0);
  EXPECT_EQ(one.at(1.0), 100.0);
}

TEST(StudyParameter, FourDigitsStayWithinTheRange) {
  const StudyParameter one{"a", "", 1.0, 0.123456, 0.123457, false, {}};
  EXPECT_GE(one.at(0.5), one.from);
  EXPECT_LE(one.at(0.5), one.to);
}

TEST(RangesText, JoinsWhatFollows) {
  EXPECT_EQ(ranges_text({}), "");
  EXPECT_EQ(ranges_text({3}), "3");
  EXPECT_EQ(ranges_text({1, 2, 4, 5, 6, 9}), "1,2,4..6,9");
}

}  // namespace
}  // namespace sprung
