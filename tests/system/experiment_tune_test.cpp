/// `sprung experiment tune` as a command: files, that its fragment can be used, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ExperimentTune : public SystemTest {
 protected:
  std::string text(const std::string& name) const {
    std::ifstream file(folder_ / "out" / name);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  CommandResult tune(const std::string& options) const {
    return sprung(
        "experiment tune --vary hybrid_landing.stiffness.z=400:3000 --samples 2 --rounds 0 --plants 1 " +
        options);
  }
};

TEST_F(ExperimentTune, WritesPageRowsAndFragmentWithTheLineThatMakesThemAgain) {
  const CommandResult result = tune("--json --out " + (folder_ / "out").string() + " 2>/dev/null");
  EXPECT_EQ(result.status, 0) << result.output;
  const nlohmann::json printed = nlohmann::json::parse(result.output);
  EXPECT_EQ(printed, nlohmann::json::parse(text("tune.json")));
  EXPECT_EQ(printed["experiment"], "tune");
  EXPECT_EQ(printed["seed"], 1);
  EXPECT_GT(printed["simulated_s"], 5 * 2.0);  // three sets on a plant to tune on, two on one to report on
  const std::string line =
      "sprung experiment tune --robot single_leg --preset best --seed 1 --mode hybrid --vary "
      "hybrid_landing.stiffness.z=400:3000 --samples 2 --rounds 0 --plants 1 --objective landing_output "
      "--tune-seed 0";
  EXPECT_THAT(text("tune.html"), HasSubstr(line));
  EXPECT_THAT(text("tune.yaml"), AllOf(HasSubstr(line), HasSubstr("hybrid_landing:"), HasSubstr(" N/m")));
}

TEST_F(ExperimentTune, TableAndFragmentAreTheSameWhateverTheThreads) {
  const CommandResult one = tune("--jobs 1 2>/dev/null");
  EXPECT_EQ(one.status, 0);
  EXPECT_THAT(one.output, AllOf(HasSubstr("What was traded"), HasSubstr("presets:")));
  EXPECT_EQ(tune("--jobs 3 2>/dev/null").output, one.output);
}

TEST_F(ExperimentTune, ModeAndObjectiveThatWereAskedAreUsed) {
  const auto printed = [this](const std::string& options) {
    return nlohmann::json::parse(tune(options + " --json 2>/dev/null").output)["rows"];
  };
  const nlohmann::json hybrid = printed("");
  EXPECT_NE(printed("--mode torque"), hybrid);
  EXPECT_THAT(tune("--objective upright").output, HasSubstr("plants on which it does not end upright"));
}

TEST_F(ExperimentTune, WhatCannotBeDoneIsRefusedWithTheReason) {
  EXPECT_EQ(sprung("experiment tune").status, 2);  // nothing to vary
  const CommandResult no_range = sprung("experiment tune --vary hybrid_landing.stiffness.z");
  EXPECT_EQ(no_range.status, 1);
  EXPECT_THAT(no_range.output, HasSubstr("hybrid_landing.stiffness.z=400:3000"));
  EXPECT_THAT(sprung("experiment tune --vary no.such=1:2").output, HasSubstr("no.such"));
  EXPECT_THAT(tune("--seed 0").output, HasSubstr("must differ from --tune-seed"));
  const std::string vary = "experiment tune --vary hybrid_landing.stiffness.z=400:3000 ";
  EXPECT_THAT(sprung(vary + "--samples 0").output, HasSubstr("--samples must be 1 or more"));
  EXPECT_EQ(sprung(vary + "--plants 0").status, 1);
  EXPECT_EQ(tune("--mode wild").status, 2);
  EXPECT_EQ(tune("--objective beauty").status, 2);
  EXPECT_THAT(sprung("experiment tune --help").output, HasSubstr("xample"));
}

}  // namespace
}  // namespace sprung
