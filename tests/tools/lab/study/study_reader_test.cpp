#include "tools/lab/study/study_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "robots/config_error.h"
#include "tests/support/own_folder.h"
#include "tests/support/refusal.h"
#include "tests/tools/lab/study/sample_study.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class StudyReader : public testing::Test {
 protected:
  Study read(const std::string& text) const { return test::study_of(text, folder_.path()); }
  /// The sample with one text in the place of another.
  std::string with(const std::string& from, const std::string& to) const {
    std::string text = test::kSampleStudy;
    return text.replace(text.find(from), from.size(), to);
  }
  std::string refusal(const std::string& text) const {
    return test::refusal_of<ConfigError>([&] { (void)read(text); });
  }
  test::OwnFolder folder_{"study"};
};

TEST_F(StudyReader, ReadsWhatTheFileSays) {
  const Study study = read(test::kSampleStudy);
  EXPECT_EQ(study.name, "sample");
  ASSERT_EQ(study.parameters.size(), 1u);
  EXPECT_EQ(study.parameters[0].unit, "N/m");
  EXPECT_EQ(study.parameters[0].present, 6280.0);
  EXPECT_EQ(study.plants.size(), 2u);
  EXPECT_EQ(study.plants[1], std::vector<std::string>{"friction_scale=1.2"});
  EXPECT_EQ(study.seeds, (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(run_count(study), 8);
}

TEST_F(StudyReader, DrawsAndFamiliesArePlants) {
  const Study study = read(
      with("plants: [{}, {friction_scale: 1.2}]", "draws: 2..4\nfamilies: [coulomb, erob_50]"));
  ASSERT_EQ(study.plants.size(), 6u);
  EXPECT_EQ(study.plants[0], (std::vector<std::string>{"family=coulomb", "draw=2"}));
  EXPECT_EQ(study.plants[5], (std::vector<std::string>{"family=erob_50", "draw=4"}));
}

TEST_F(StudyReader, AnUnknownNumberIsRefusedWithLineAndTheNearest) {
  EXPECT_THAT(refusal(with("torque_jump.stiffness.z", "torque_jump.stifness.z")),
              AllOf(HasSubstr("study.yaml:5"), HasSubstr("presets.best.torque_jump.stiffness.z")));
}

TEST_F(StudyReader, RangesTurnedRoundAreRefused) {
  EXPECT_THAT(refusal(with("{values: [3000 N/m, 6280 N/m]}", "{from: 3000 N/m, to: 400 N/m}")),
              AllOf(HasSubstr("study.yaml:5"), HasSubstr("turned round")));
  EXPECT_THAT(refusal(with("1..2", "2..1")), AllOf(HasSubstr("study.yaml:7"), HasSubstr("1..2 is meant")));
}

TEST_F(StudyReader, RangesBeyondWhatTheRobotMayHoldAreRefusedAtTheirKey) {
  EXPECT_THAT(refusal(with("3000 N/m", "-3000 N/m")),
              AllOf(HasSubstr("study.yaml:5"), HasSubstr("robot.yaml")));
  EXPECT_THAT(refusal(with("3000 N/m", "3000 N")), HasSubstr("study.yaml:5"));
}

TEST_F(StudyReader, KeysThatNoPlantHasAreRefused) {
  EXPECT_THAT(refusal(with("friction_scale", "friction_skale")),
              AllOf(HasSubstr("study.yaml:6"), HasSubstr("friction_skale")));
  EXPECT_THAT(refusal(with("plants: [{}, {friction_scale: 1.2}]", "families: [coulom]\ndraws: 1..2")),
              AllOf(HasSubstr("study.yaml:6"), HasSubstr("coulom")));
}

TEST_F(StudyReader, ExperimentRobotOptionsAndKeysAreChecked) {
  EXPECT_THAT(refusal(with("step_response", "step_respons")),
              AllOf(HasSubstr(":2"), HasSubstr("did you mean")));
  EXPECT_THAT(refusal(with("single_leg", "double_leg")), AllOf(HasSubstr(":3"), HasSubstr("double_leg")));
  EXPECT_THAT(refusal(with("seeds: 1..2", "options: {mood: good}")),
              AllOf(HasSubstr(":7"), HasSubstr("--mood")));
  EXPECT_THAT(refusal(with("seeds:", "seed:")), HasSubstr("seeds"));
  EXPECT_THAT(refusal(with("step_response", "bring_up")), HasSubstr("reads robot.yaml itself"));
  EXPECT_THAT(refusal(with("step_response", "walk")), HasSubstr("has no gaits"));
}

constexpr const char* kTuning =
    "tune:\n"
    "  trials: 5\n"
    "  held_out: {draws: 8..9}\n"
    "  goals:\n"
    "    - {name: rise, over: mean, of: [{row: step_response.thrust.rise, about: 4, weight: 2, unreached: "
    "99}]}\n";

TEST_F(StudyReader, TuningHasGoalsAndHeldOutPlants) {
  const Study study = read(with("{values: [3000 N/m, 6280 N/m]}", "{from: 3000 N/m, to: 6280 N/m}") +
                           kTuning);
  ASSERT_TRUE(study.tuning);
  EXPECT_EQ(study.tuning->trials, 5);
  EXPECT_EQ(study.tuning->held_out.size(), 2u);
  ASSERT_EQ(study.tuning->goals.size(), 1u);
  EXPECT_TRUE(study.tuning->goals[0].is_least);
  EXPECT_FALSE(study.tuning->goals[0].is_worst);
  EXPECT_EQ(study.tuning->goals[0].terms[0].about, 4.0);
  EXPECT_FALSE(study.tuning->goals[0].terms[0].above);
  EXPECT_EQ(study.tuning->goals[0].terms[0].unreached, 99.0);
}

TEST_F(StudyReader, PlantsThatAreHeldOutAreCheckedAtTheirKey) {
  std::string text = with("{values: [3000 N/m, 6280 N/m]}", "{from: 3000 N/m, to: 6280 N/m}") + kTuning;
  text.replace(text.find("{draws: 8..9}"), 13, "{families: [nope]}");
  EXPECT_THAT(refusal(text), AllOf(HasSubstr("study.yaml:10"), HasSubstr("nope")));
}

TEST_F(StudyReader, WhatMeansNothingIsRefused) {
  EXPECT_THAT(refusal(with("seeds: 1..2", "options: {seed: 3}")), HasSubstr("keys of their own"));
  EXPECT_THAT(refusal(with("1..2", "..")), HasSubstr("whole numbers"));
  EXPECT_THAT(refusal(test::kSampleStudy + std::string(kTuning)), HasSubstr("need a range"));
  std::string text = with("seeds: 1..2", "samples: 3");
  text.erase(text.find("parameters:"), text.find("plants:") - text.find("parameters:"));
  EXPECT_THAT(refusal(text), HasSubstr("all be the same"));
}

TEST_F(StudyReader, TuningOfNothingIsRefused) {
  std::string text = test::kSampleStudy + std::string(kTuning);
  text.erase(text.find("parameters:"), text.find("plants:") - text.find("parameters:"));
  EXPECT_THAT(refusal(text), HasSubstr("nothing to tune"));
}

}  // namespace
}  // namespace sprung
