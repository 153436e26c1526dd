#include "estimator/identification/model_selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace sprung::identification {
namespace {

using testing::HasSubstr;

TEST(ModelSelection, TheSimplestWithinOneStandardErrorOfTheBestIsChosen) {
  // Behind by 0.01 +- 0.0058: no. Behind by 0.003 +- 0.0058: yes, and simpler than the best.
  const std::vector<Candidate> candidates = {{"poor", 3, {{0.11, 0.12, 0.10}}},
                                             {"enough", 5, {{0.103, 0.113, 0.093}}},
                                             {"best", 9, {{0.10, 0.10, 0.10}}}};
  const Selection found = select(candidates);
  EXPECT_EQ(found.best, 2u);
  EXPECT_EQ(found.chosen, 1u);
  EXPECT_THAT(found.why, HasSubstr("'enough' (5 parameters) is behind the best one, 'best' (9 parameters)"));
}

TEST(ModelSelection, AClearlyBetterModelIsChosenHoweverManyParameters) {
  const Selection found = select({{"a", 1, {{0.5, 0.6}}}, {"b", 12, {{0.1, 0.2}}}});
  EXPECT_EQ(found.chosen, 1u);
  EXPECT_THAT(found.why, HasSubstr("smallest error"));
}

TEST(ModelSelection, OfEquallySimpleOnesTheBetterIsChosen) {
  const std::vector<Candidate> candidates = {
      {"worse", 4, {{0.12, 0.09}}}, {"better", 4, {{0.11, 0.09}}}, {"best", 6, {{0.10, 0.09}}}};
  EXPECT_EQ(select(candidates).chosen, 1u);
}

TEST(ModelSelection, AFitThatEndsOnABoundIsNotChosenWhereAnotherDoesNot) {
  const std::vector<Candidate> candidates = {{"sound", 4, {{0.3, 0.4}}}, {"strained", 9, {{0.1, 0.2}, true}}};
  const Selection found = select(candidates);
  EXPECT_EQ(found.chosen, 0u);
  EXPECT_THAT(found.why, HasSubstr("'strained' (9 parameters) is left out, since its fit ends on a bound"));
  EXPECT_EQ(select({candidates[1]}).chosen, 0u) << "but something must be chosen";
}

TEST(ModelSelection, AHundredthOfTheErrorIsNoReasonForAParameterHoweverSure) {
  const std::vector<Candidate> candidates = {{"simple", 4, {{0.1005, 0.2005}}}, {"rich", 9, {{0.1, 0.2}}}};
  EXPECT_EQ(select(candidates).chosen, 0u) << "behind by 0.0005 +- 0, a three-hundredth";
  EXPECT_EQ(select({{"simple", 4, {{0.102, 0.202}}}, candidates[1]}).chosen, 1u);
}

TEST(ModelSelection, OneCandidateIsChosen) { EXPECT_EQ(select({{"only", 4, {{0.1, 0.2}}}}).chosen, 0u); }

TEST(ModelSelection, TheRuleIsSaid) { EXPECT_THAT(selection_criterion(), HasSubstr("one-standard-error")); }

}  // namespace
}  // namespace sprung::identification
