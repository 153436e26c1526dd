#include "tools/lab/bring_up/never_identified.h"

#include <gtest/gtest.h>

namespace sprung {
namespace {

ReportRow judged(const std::string& name, double value) {
  return never_identified({row(name, "", value, between(0.0, 0.1))}).front();
}

TEST(NeverIdentified, TheModelIsDoubtedWithinASecond) {
  EXPECT_TRUE(judged("model_watch.misfit_within_1s", 1.0).ok());
  EXPECT_FALSE(judged("model_watch.misfit_within_1s", 0.5).ok());
}

TEST(NeverIdentified, BoundsHoldNinetyPercent) {
  EXPECT_TRUE(judged("estimator.bounds.pooled.coverage", 0.91).ok());
  EXPECT_FALSE(judged("estimator.bounds.pooled.coverage", 0.89).ok());
}

TEST(NeverIdentified, ContactIsFoundOnALegAndInEachGait) {
  for (const char* where : {"estimator.contact", "estimator.contact.trot"}) {
    EXPECT_TRUE(judged(std::string(where) + ".found", 97.5).ok());
    EXPECT_FALSE(judged(std::string(where) + ".found", 96.5).ok());
    EXPECT_TRUE(judged(std::string(where) + ".false_alarms", 1.5).ok());
    EXPECT_FALSE(judged(std::string(where) + ".false_alarms", 2.5).ok());
  }
}

TEST(NeverIdentified, TheAdaptiveLandingIsNoHarderThanThePapers) {
  for (const char* name : {"drop.adaptive_over_paper.ratio", "drop.adaptive_over_paper.worst_ratio",
                           "drop.adaptive_over_paper_500.ratio"}) {
    EXPECT_TRUE(judged(name, 0.9).ok()) << name;
    EXPECT_FALSE(judged(name, 1.1).ok()) << name;
  }
}

/// It is the one row of an experiment that failed.
TEST(NeverIdentified, ExperimentsThatHaveDemandsMustComeToTheirEnd) {
  for (const char* name : {"model_watch.completed", "estimator.completed", "drop.completed"})
    EXPECT_FALSE(judged(name, 0.0).ok()) << name;
  EXPECT_TRUE(judged("walk.completed", 0.0).ok());
}

TEST(NeverIdentified, OfTheRestNothingIsDemanded) {
  for (const char* name : {"estimator.push_off.rms", "walk.trot.speed", "model_watch.fits"}) {
    EXPECT_FALSE(judged(name, 5.0).low) << name;
    EXPECT_FALSE(judged(name, 5.0).high) << name;
  }
}

}  // namespace
}  // namespace sprung
