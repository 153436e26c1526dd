#include "runtime/command_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/command_info.h"

namespace sprung {
namespace {

using ::testing::AnyOf;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;

class CommandLineTest : public ::testing::Test {
 protected:
  CommandLineTest() {
    line_.option("--text", text_, "a text");
    line_.option("-n,--count", count_, "a count");
    line_.option("--big", big_, "a 64 bit number");
    line_.option("--seed", seed_, "an unsigned number");
    line_.option("--height", height_, "a number");
    line_.option("--plant", plant_, "key=value, several times");
    line_.option("--pair", pair_, "two numbers");
    line_.choice("--clock", clock_, {"lockstep", "realtime"}, "a choice");
    line_.flag("--json", json_, "a flag");
    line_.example("tool --count 3");
    line_.action([this] { return ++ran_, result_; });
  }

  int run(std::vector<const char*> words) {
    words.insert(words.begin(), "tool");
    ::testing::internal::CaptureStdout();
    ::testing::internal::CaptureStderr();
    const int status = line_.run(static_cast<int>(words.size()), words.data());
    out_ = ::testing::internal::GetCapturedStdout();
    error_ = ::testing::internal::GetCapturedStderr();
    return status;
  }

  CommandLine line_{"tool", "Does a thing."};
  std::string text_ = "default";
  int count_ = 1;
  std::int64_t big_ = 0;
  std::uint64_t seed_ = 0;
  double height_ = 0.0;
  std::vector<std::string> plant_;
  std::array<double, 2> pair_{1.0, 2.0};
  std::string clock_ = "lockstep";
  bool json_ = false;
  int ran_ = 0;
  int result_ = kExitDone;
  std::string out_;
  std::string error_;
};

TEST_F(CommandLineTest, WithoutWordsDefaultsStay) {
  EXPECT_EQ(run({}), kExitDone);
  EXPECT_EQ(ran_, 1);
  EXPECT_EQ(text_, "default");
  EXPECT_EQ(clock_, "lockstep");
  EXPECT_FALSE(json_);
}

TEST_F(CommandLineTest, ReadsEveryKindOfOption) {
  EXPECT_EQ(run({"--text", "a b", "-n", "-3", "--big=-9223372036854775808", "--seed", "18446744073709551615",
                 "--height", "-1.5e-3", "--plant", "a=1", "--plant", "b=2", "--clock", "realtime", "--json",
                 "--pair", "-2", "3.5"}),
            kExitDone);
  EXPECT_EQ(text_, "a b");
  EXPECT_EQ(count_, -3);
  EXPECT_EQ(big_, std::numeric_limits<std::int64_t>::min());
  EXPECT_EQ(seed_, std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(height_, -1.5e-3);
  EXPECT_THAT(plant_, ElementsAre("a=1", "b=2"));
  EXPECT_EQ(clock_, "realtime");
  EXPECT_TRUE(json_);
  EXPECT_EQ(pair_, (std::array<double, 2>{-2.0, 3.5}));
}

TEST_F(CommandLineTest, WrongUseIsTwoAndSaysWhatIsWrong) {
  const std::vector<std::vector<const char*>> wrong{
      {"--nope"},         {"--count", "x"},         {"--count"},
      {"--count", "1.5"}, {"--seed", "-1"},         {"--height", "1m"},
      {"word"},           {"--clock", "sundial"},   {"--count", "99999999999"},
      {"--pair", "1"},    {"--pair", "1", "2", "3"}};
  for (const auto& words : wrong) {
    EXPECT_EQ(run(words), kExitWrongUse) << words[0];
    EXPECT_NE(error_, "") << words[0];
    EXPECT_EQ(out_, "") << words[0];
  }
  EXPECT_EQ(ran_, 0);
}

TEST_F(CommandLineTest, NobodyMayTypeANumberThatIsNotFinite) {
  for (const char* text : {"nan", "NaN", "-nan", "inf", "INFINITY", "-inf", "nan(1)", "1e999", "-1e999"}) {
    for (const std::string& typed : {std::string("--height=") + text, std::string("--pair=") + text}) {
      std::vector<const char*> words{typed.c_str()};
      if (typed.rfind("--pair", 0) == 0) words.push_back("2");
      EXPECT_EQ(run(words), kExitWrongUse) << typed;
      EXPECT_THAT(error_, HasSubstr("must be a finite number, not " + std::string(text))) << typed;
    }
  }
  EXPECT_EQ(run({"--pair", "2", "nan"}), kExitWrongUse);
  EXPECT_EQ(run({"--height", "nan"}), kExitWrongUse);
  EXPECT_EQ(run({"--count", "nan"}), kExitWrongUse);
  EXPECT_EQ(run({"--seed", "inf"}), kExitWrongUse);
  EXPECT_EQ(ran_, 0);
}

TEST_F(CommandLineTest, WhatIsNotGivenMayStayNaN) {
  height_ = std::nan("");
  EXPECT_EQ(run({}), kExitDone);
  EXPECT_TRUE(std::isnan(height_));
}

TEST_F(CommandLineTest, HelpShowsTheExampleAndTheDefaults) {
  EXPECT_EQ(run({"--help"}), kExitDone);
  EXPECT_THAT(out_, HasSubstr("Does a thing."));
  EXPECT_THAT(out_, HasSubstr("Example:\n  tool --count 3"));
  EXPECT_THAT(out_, AnyOf(HasSubstr("=default"), HasSubstr("[default]"))) << "CLI11 before 2.4, and since";
  EXPECT_EQ(ran_, 0);
}

TEST_F(CommandLineTest, VersionNamesTheProgram) {
  EXPECT_EQ(run({"--version"}), kExitDone);
  EXPECT_EQ(out_.rfind("tool ", 0), 0U) << out_;
  EXPECT_EQ(ran_, 0);
}

TEST_F(CommandLineTest, StatusOfTheActionIsReturned) {
  result_ = kExitFailed;
  EXPECT_EQ(run({}), kExitFailed);
}

TEST_F(CommandLineTest, ActionThatThrowsFailsWithItsText) {
  line_.action([]() -> int { throw std::runtime_error("disk full; free some space"); });
  EXPECT_EQ(run({}), kExitFailed);
  EXPECT_EQ(error_, "tool: disk full; free some space\n");
}

TEST_F(CommandLineTest, ActionThatFindsWrongUseIsTwo) {
  line_.action([]() -> int { throw WrongUse("no preset 'x'"); });
  EXPECT_EQ(run({}), kExitWrongUse);
  EXPECT_THAT(error_, HasSubstr("no preset 'x'"));
  EXPECT_THAT(error_, HasSubstr("--help"));
}

TEST_F(CommandLineTest, RequiredOptionIsRequired) {
  std::string robot;
  line_.option("--robot", robot, "which robot", Need::kRequired);
  EXPECT_EQ(run({}), kExitWrongUse);
  EXPECT_THAT(error_, HasSubstr("--robot"));
  EXPECT_EQ(run({"--robot", "x"}), kExitDone);
  EXPECT_EQ(robot, "x");
}

TEST_F(CommandLineTest, AnOptionThatIsNoneIsNamedWithTheOneThatWasMeant) {
  EXPECT_EQ(run({"--hieght", "1"}), kExitWrongUse);
  EXPECT_EQ(error_,
            "tool: no option '--hieght'; did you mean '--height'?\nRun 'tool --help' for what it takes.\n");
  EXPECT_EQ(run({"--something"}), kExitWrongUse);
  EXPECT_EQ(error_, "tool: no option '--something'\nRun 'tool --help' for what it takes.\n");
}

TEST_F(CommandLineTest, AnOptionThatIsGoneSaysWhatToDoInsteadAndIsNotShown) {
  line_.gone("--colour", "everything is grey now: leave it out");
  EXPECT_EQ(run({"--colour", "red"}), kExitWrongUse);
  EXPECT_EQ(error_,
            "tool: --colour: everything is grey now: leave it out\nRun 'tool --help' for what it takes.\n");
  EXPECT_EQ(ran_, 0);
  EXPECT_EQ(run({"--help"}), kExitDone);
  EXPECT_THAT(out_, Not(HasSubstr("--colour")));
  for (const OptionInfo& option : line_.info().options) EXPECT_NE(option.name, "--colour");
  run({"--colur", "red"});
  EXPECT_THAT(error_, Not(HasSubstr("did you mean '--colour'")));
}

TEST_F(CommandLineTest, AWordTooManyIsNamed) {
  EXPECT_EQ(run({"here", "there"}), kExitWrongUse);
  EXPECT_THAT(error_, HasSubstr("one word too many: 'here'"));
}

class SubcommandTest : public CommandLineTest {
 protected:
  SubcommandTest() {
    CommandLine& jump = line_.subcommand("jump", "Jump.");
    jump.option("--height", jump_height_, "how high");
    jump.example("tool jump --height 0.2");
    jump.action([this] { return ++jumped_, kExitDone; });
    CommandLine& log = line_.subcommand("log", "Logs.");
    CommandLine& info = log.subcommand("info", "About a log.");
    info.option("file", file_, "the log", Need::kRequired);
    info.option("more", more_, "and others");
    info.action([this] { return ++informed_, kExitFailed; });
  }
  double jump_height_ = 0.1;
  std::string file_;
  std::vector<std::string> more_;
  int jumped_ = 0;
  int informed_ = 0;
};

TEST_F(SubcommandTest, OnlyTheChosenOneRuns) {
  EXPECT_EQ(run({"jump", "--height", "0.2"}), kExitDone);
  EXPECT_EQ(jump_height_, 0.2);
  EXPECT_EQ(jumped_, 1);
  EXPECT_EQ(ran_ + informed_, 0);
}

TEST_F(SubcommandTest, NestedOneRunsAndTakesPositionals) {
  EXPECT_EQ(run({"log", "info", "a.log", "b.log", "c.log"}), kExitFailed);
  EXPECT_EQ(file_, "a.log");
  EXPECT_THAT(more_, ElementsAre("b.log", "c.log"));
  EXPECT_EQ(informed_, 1);
}

TEST_F(SubcommandTest, OneMustBeGivenAndKnown) {
  EXPECT_EQ(run({}), kExitWrongUse);
  EXPECT_EQ(run({"hop"}), kExitWrongUse);
  EXPECT_EQ(run({"log"}), kExitWrongUse);
  EXPECT_EQ(run({"log", "info"}), kExitWrongUse);
  EXPECT_EQ(ran_ + jumped_ + informed_, 0);
}

TEST_F(SubcommandTest, ACommandThatIsNoneIsNamedWithTheOneThatWasMeant) {
  EXPECT_EQ(run({"jmp", "--height", "0.2"}), kExitWrongUse);
  EXPECT_EQ(error_,
            "tool: no command 'jmp'; did you mean 'jump'?\nThere are: jump, log\nRun 'tool --help' for what "
            "it takes.\n");
  EXPECT_EQ(run({"log", "inof", "a.log"}), kExitWrongUse);
  EXPECT_EQ(error_,
            "tool: no command 'inof'; did you mean 'info'?\nThere are: info\nRun 'tool log --help' for what "
            "it takes.\n");
}

TEST_F(SubcommandTest, WithoutACommandAllOfThemAreNamed) {
  EXPECT_EQ(run({}), kExitWrongUse);
  EXPECT_THAT(error_, HasSubstr("which command?\nThere are: jump, log\n"));
}

TEST_F(SubcommandTest, AMistakeLeadsToTheHelpOfItsOwnCommand) {
  EXPECT_EQ(run({"jump", "--hieght", "0.2"}), kExitWrongUse);
  EXPECT_EQ(
      error_,
      "tool: no option '--hieght'; did you mean '--height'?\nRun 'tool jump --help' for what it takes.\n");
  EXPECT_EQ(run({"log", "info"}), kExitWrongUse);
  EXPECT_THAT(error_, ::testing::AllOf(HasSubstr("file is required"), HasSubstr("'tool log info --help'")));
  EXPECT_EQ(run({"jump", "--height", "high"}), kExitWrongUse);
  EXPECT_THAT(error_,
              ::testing::AllOf(HasSubstr("--height"), HasSubstr("high"), HasSubstr("'tool jump --help'")));
}

TEST_F(SubcommandTest, WrongUseThatTheActionFindsLeadsToItsOwnHelpToo) {
  CommandLine& hop = line_.subcommand("hop", "Hop.");
  hop.action([]() -> int { throw WrongUse("on which leg?"); });
  EXPECT_EQ(run({"hop"}), kExitWrongUse);
  EXPECT_EQ(error_, "tool: on which leg?\nRun 'tool hop --help' for what it takes.\n");
}

TEST_F(SubcommandTest, HelpOfASubcommandIsItsOwn) {
  EXPECT_EQ(run({"jump", "--help"}), kExitDone);
  EXPECT_THAT(out_, HasSubstr("tool jump --height 0.2"));
  EXPECT_EQ(jumped_, 0);
}

TEST(CommandLineParse, FillsTheVariablesAndRunsNothing) {
  CommandLine line("program", "what");
  int count = 1;
  line.option("--count", count, "how many");
  line.action([]() -> int { throw std::runtime_error("was run"); });
  line.parse({"--count", "3"});
  EXPECT_EQ(count, 3);
}

TEST(CommandLineParse, SaysWhatIsWrong) {
  CommandLine line("program", "what");
  int count = 1;
  line.option("--count", count, "how many");
  const auto said = [&](const std::vector<std::string>& words) -> std::string {
    try {
      line.parse(words);
    } catch (const WrongUse& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(said({"--count", "many"}), testing::HasSubstr("--count"));
  EXPECT_THAT(said({"--cuont", "3"}), testing::HasSubstr("did you mean"));
  EXPECT_THAT(said({"--help"}), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace sprung
