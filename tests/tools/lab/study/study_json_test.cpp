#include "tools/lab/study/study_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/support/refusal.h"

namespace sprung {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

StudyRun run() {
  return {
      17,         "0a", "jump", "single_leg", "best", {"--mode", "hybrid"}, {{"presets.best.x", 0.1 + 0.2}},
      {"draw=3"}, 5};
}

TEST(RunJson, IsOneLineAndReadsBackToTheBit) {
  const std::string line = run_json(run());
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const StudyRun read = run_of_json(line);
  EXPECT_EQ(run_json(read), line);
  EXPECT_EQ(read.number, 17);
  EXPECT_EQ(read.parameters.at("presets.best.x"), 0.1 + 0.2);
  EXPECT_EQ(read.seed, 5u);
}

TEST(RunJson, WordsAreTheCommandWithAllDigits) {
  EXPECT_THAT(words_of(run()),
              ElementsAre("jump", "--robot", "single_leg", "--seed", "5", "--preset", "best", "--mode",
                          "hybrid", "--set", "presets.best.x=0.30000000000000004", "--plant", "draw=3"));
}

TEST(ShellWord, IsQuotedWhereAShellWouldReadItOtherwise) {
  EXPECT_EQ(shell_word("presets.best.x=0.5"), "presets.best.x=0.5");
  EXPECT_EQ(shell_word("ro bot"), "'ro bot'");
  EXPECT_EQ(shell_word("it's"), "'it'\\''s'");
  EXPECT_EQ(shell_word(""), "''");
}

TEST(RunJson, WhatIsNoRunIsRefused) {
  for (const char* line :
       {"", "{", "[1]", "17", R"({"run":1})", R"({"run":"x","experiment":"jump","robot":"r"})",
        R"({"run":1,"experiment":"jump","robot":"r","parameters":{"a":"b"}})"}) {
    EXPECT_THAT(test::refusal_of<std::invalid_argument>([&] { (void)run_of_json(line); }),
                HasSubstr("no run"))
        << line;
  }
}

}  // namespace
}  // namespace sprung
