/// `sprung study` as commands: the contract of docs/studies.md, typed.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"
#include "tests/tools/lab/study/sample_study.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

class StudyCommand : public SystemTest {
 protected:
  std::string file(const std::string& name) const { return (folder_ / name).string(); }
  std::string text(const std::string& name) const {
    std::ifstream in(file(name));
    return {std::istreambuf_iterator<char>(in), {}};
  }
  CommandResult study(const std::string& arguments) const { return sprung("study " + arguments); }
  void SetUp() override {
    SystemTest::SetUp();
    study_ = test::written(test::kSampleStudy, file("study.yaml"));
  }
  std::string study_;
};

TEST_F(StudyCommand, RunsWhatIsMissingAndCollectsTheTable) {
  const std::string run = "run " + study_ + " --out " + file("out");
  EXPECT_EQ(study(run + " --runs 1..3 -j 2").status, 0);
  const CommandResult some = study("collect " + file("out"));
  EXPECT_EQ(some.status, 1);
  EXPECT_THAT(some.output,
              AllOf(HasSubstr("3 of 8 runs"), HasSubstr("missing: 4..8"), HasSubstr("sprung study run")));
  const std::string first = text("out/rows/2.json");
  const CommandResult rest = study(run);
  EXPECT_THAT(rest.output, HasSubstr("5 of 5 runs kept"));
  EXPECT_EQ(text("out/rows/2.json"), first);
  const CommandResult all = study("collect " + file("out"));
  EXPECT_EQ(all.status, 0) << all.output;
  EXPECT_THAT(text("out/table.csv"), HasSubstr("\n8,2,friction_scale=1.2,6280,"));
  EXPECT_THAT(text("out/index.html"), HasSubstr("Study sample"));
}

TEST_F(StudyCommand, WorkersBetweenPipesGiveTheSameBytesAsRun) {
  EXPECT_EQ(study("run " + study_ + " --out " + file("run")).status, 0);
  const std::string program = program_folder() + "/sprung study ";
  const CommandResult piped = study("expand " + study_ + " --missing " + file("piped") + " | " + program +
                                    "worker | " + program + "keep " + study_ + " --out " + file("piped"));
  EXPECT_EQ(piped.status, 0) << piped.output;
  for (int n = 1; n <= 8; ++n) {
    const std::string row = "/rows/" + std::to_string(n) + ".json";
    EXPECT_FALSE(text("run" + row).empty());
    EXPECT_EQ(text("piped" + row), text("run" + row)) << n;
  }
}

TEST_F(StudyCommand, ARowIsRepeatedByTheCommandThatItNames) {
  EXPECT_EQ(study("run " + study_ + " --runs 4 --out " + file("out")).status, 0);
  const nlohmann::json row = nlohmann::json::parse(text("out/rows/4.json"));
  const std::string command = row["command"];
  ASSERT_EQ(command.rfind("sprung ", 0), 0u);
  const nlohmann::json again = nlohmann::json::parse(sprung(command.substr(7) + " 2>/dev/null").output);
  ASSERT_EQ(again["rows"].size(), row["rows"].size());
  for (std::size_t i = 0; i < row["rows"].size(); ++i)
    EXPECT_EQ(again["rows"][i]["value"], row["rows"][i]["value"]);
}

TEST_F(StudyCommand, WhatMakesNoSenseIsRefusedAndWhatIsDoneStays) {
  EXPECT_EQ(study("run " + study_ + " --runs 1..2 --out " + file("out")).status, 0);
  EXPECT_THAT(study("run " + study_ + " --runs 3..1 --out " + file("out")).output,
              HasSubstr("1..3 is meant"));
  EXPECT_THAT(study("expand " + study_ + " --runs 1..9").output, HasSubstr("has 8 runs"));
  std::string other = test::kSampleStudy;
  other.replace(other.find("sample"), 6, "second");
  const std::string second = test::written(other, file("second.yaml"));
  EXPECT_THAT(study("run " + second + " --out " + file("out")).output,
              AllOf(HasSubstr("another study"), HasSubstr("take another folder")));
  EXPECT_FALSE(text("out/rows/2.json").empty());
  EXPECT_THAT(study("collect " + file("nowhere")).output, HasSubstr("no folder of a study"));
  EXPECT_THAT(study("show " + file("none.yaml")).output, HasSubstr("none.yaml"));
}

TEST_F(StudyCommand, ABadAnswerIsSaidAndThoseAfterItAreKept) {
  const std::string program = program_folder() + "/sprung study ";
  const CommandResult kept = study("expand " + study_ + " --runs 1..2 | " + program +
                                   "worker | (echo '{\"run\":9,\"row\":{\"run'; cat) | " + program + "keep " +
                                   study_ + " --out " + file("out"));
  EXPECT_THAT(kept.output, HasSubstr("no answer of a worker"));
  EXPECT_EQ(kept.status, 1);
  EXPECT_FALSE(text("out/rows/1.json").empty());
  EXPECT_FALSE(text("out/rows/2.json").empty());
}

TEST_F(StudyCommand, AStudyThatIsTunedIsNotRunAsAGrid) {
  const std::string tuned = test::source_dir() + "/examples/studies/jump_height.yaml";
  const CommandResult refused = study("run " + tuned + " --out " + file("out"));
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.output, HasSubstr("python3 -m sprung_study tune"));
  EXPECT_EQ(study("expand " + tuned).status, 2);
  const CommandResult claimed = study("keep " + tuned + " --out " + file("tuned") + " < /dev/null");
  EXPECT_EQ(claimed.status, 0) << claimed.output;
  EXPECT_FALSE(text("tuned/study.json").empty());
}

TEST_F(StudyCommand, ShowIsOneObjectForEngines) {
  const nlohmann::json shown = nlohmann::json::parse(study("show " + study_).output);
  EXPECT_EQ(shown["study"], "sample");
  EXPECT_EQ(shown["runs"], 8);
  EXPECT_EQ(shown["parameters"][0]["unit"], "N/m");
}

TEST_F(StudyCommand, ExamplesAreStudies) {
  int count = 0;
  for (const auto& example : std::filesystem::directory_iterator(test::source_dir() + "/examples/studies")) {
    const CommandResult shown = study("show " + example.path().string());
    EXPECT_EQ(shown.status, 0) << shown.output;
    ++count;
  }
  EXPECT_GE(count, 3);
}

}  // namespace
}  // namespace sprung
