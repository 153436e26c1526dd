/// `sprung experiment foot_return` and `step_response` as commands: files, exit status, refusals.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/system/system_fixture.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class ExperimentLeg : public SystemTest {};

TEST_F(ExperimentLeg, StepResponseWritesPageAndRowsAndTheLineThatMakesThemAgain) {
  const std::string out = (folder_ / "out").string();
  const CommandResult result = sprung(
      "experiment step_response --seed 3 --plant noise_scale=2 --json --out " + out + " 2>/dev/null");
  EXPECT_EQ(result.status, 0) << result.output;
  const nlohmann::json printed = nlohmann::json::parse(result.output);
  const nlohmann::json written = nlohmann::json::parse(std::ifstream(out + "/step_response.json"));
  EXPECT_EQ(printed, written);
  EXPECT_EQ(printed["seed"], 3);
  EXPECT_EQ(printed["preset"], "paper");
  EXPECT_GT(printed["simulated_s"], 1.0);
  EXPECT_GT(printed["rows"].size(), 4u);
  std::ifstream page(out + "/step_response.html");
  const std::string html{std::istreambuf_iterator<char>(page), {}};
  EXPECT_THAT(html, HasSubstr("sprung experiment step_response --robot single_leg --preset paper --plant "
                              "noise_scale=2 --seed 3"));
}

TEST_F(ExperimentLeg, SameSeedGivesTheSameRowsAndAnotherOneOthers) {
  const auto rows = [this](const std::string& options) {
    return nlohmann::json::parse(
        sprung("experiment step_response --json " + options + " 2>/dev/null").output)["rows"];
  };
  const nlohmann::json first = rows("--seed 1 --plant noise_scale=20");
  EXPECT_EQ(rows("--seed 1 --plant noise_scale=20"), first);
  EXPECT_NE(rows("--seed 2 --plant noise_scale=20"), first);
}

TEST_F(ExperimentLeg, FolderThatCannotBeMadeIsNamed) {
  const CommandResult result = sprung("experiment step_response --out /dev/null/here");
  EXPECT_EQ(result.status, 1);
  EXPECT_THAT(result.output, HasSubstr("/dev/null/here"));
}

TEST_F(ExperimentLeg, WhatCannotBeDoneIsRefusedWithTheReason) {
  for (const std::string name : {"foot_return", "step_response"}) {
    const CommandResult axis = sprung("experiment " + name + " --robot test_axis");
    EXPECT_EQ(axis.status, 1) << name;
    EXPECT_THAT(axis.output, HasSubstr("test_axis")) << name;
    const CommandResult preset = sprung("experiment " + name + " --preset worst");
    EXPECT_EQ(preset.status, 1) << name;
    EXPECT_THAT(preset.output, HasSubstr("paper, best")) << name;
    EXPECT_THAT(sprung("experiment " + name + " --plant friction").output, HasSubstr("KEY=NUMBER")) << name;
    EXPECT_EQ(sprung("experiment " + name + " --sed 1").status, 2) << name;
    EXPECT_THAT(sprung("experiment " + name + " --help").output, AllOf(HasSubstr("xample"), HasSubstr(name)));
  }
}

}  // namespace
}  // namespace sprung
