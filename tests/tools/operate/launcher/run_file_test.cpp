#include "tools/operate/launcher/run_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "runtime/key_source.h"
#include "tests/support/own_folder.h"
#include "tools/operate/launcher/child_process.h"

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RunFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = test::temp_dir() + "sprung_run";
    setenv("SPRUNG_RUN_DIR", folder_.c_str(), 1);
  }
  void TearDown() override {
    std::filesystem::remove_all(folder_);
    unsetenv("SPRUNG_RUN_DIR");
  }
  RunInfo sample() const {
    RunInfo info;
    info.robot = "single_leg";
    info.session = 0x7123456789ABCDEF;
    info.lcm_url = "udpm://239.255.76.67:7667?ttl=0";
    info.launcher_pid = getpid();
    info.can = {"leg=socketcan:can1"};
    info.plant = {"world=stairs"};
    info.processes = {{"sprung-can-bridge", 12}};
    return info;
  }
  std::filesystem::path folder_;
};

TEST_F(RunFileTest, WhatIsWrittenIsReadBack) {
  RunFile file("default");
  file.write(sample());
  const auto info = read_run_file("default");
  ASSERT_TRUE(info);
  EXPECT_EQ(info->robot, "single_leg");
  EXPECT_EQ(info->session, 0x7123456789ABCDEF);
  EXPECT_EQ(info->can, std::vector<std::string>{"leg=socketcan:can1"});
  EXPECT_EQ(info->plant, std::vector<std::string>{"world=stairs"});
  ASSERT_EQ(info->processes.size(), 1u);
  EXPECT_EQ(info->processes[0].pid, 12);
}

TEST_F(RunFileTest, ARunOfAVersionThatDidNotSayItsPlantIsARun) {
  const std::string text = run_text(sample());
  const std::size_t at = text.find("\"plant\"");
  ASSERT_NE(at, std::string::npos);
  const std::string former = text.substr(0, at) + text.substr(text.find("\"buses\""));
  EXPECT_EQ(parse_run(former).robot, "single_leg");
  EXPECT_TRUE(parse_run(former).plant.empty());
}

TEST_F(RunFileTest, KeyLiesBesideForItsOwnerAloneAndGoesWithTheRun) {
  const auto key = random_key();
  {
    RunFile file("default");
    file.write_key(*key);
    file.write(sample());
    const NodeOptions options = commanding(*read_run_file("default"));
    EXPECT_EQ(options.key->bytes(), key->bytes());
    EXPECT_EQ(options.session, sample().session);
    using std::filesystem::perms;
    EXPECT_EQ(std::filesystem::status(run_key_path("default")).permissions(),
              perms::owner_read | perms::owner_write);
  }
  EXPECT_FALSE(std::filesystem::exists(run_key_path("default")));
  EXPECT_THROW(commanding(sample()), std::runtime_error);
}

TEST_F(RunFileTest, AllThatAreUpAreListed) {
  EXPECT_TRUE(runs_that_are_up().empty());
  RunFile one("one"), two("two");
  RunInfo info = sample();
  info.instance = "one";
  info.buses = {"socketcan:can1"};
  one.write(info);
  info.instance = "two";
  two.write(info);
  { RunFile("gone").write(info); }
  const auto all = runs_that_are_up();
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0].instance, "one");
  EXPECT_EQ(all[0].buses, std::vector<std::string>{"socketcan:can1"});
  EXPECT_EQ(all[1].instance, "two");
}

TEST_F(RunFileTest, ProcessesOfALauncherThatWasKilledAreFoundAsLongAsTheyRun) {
  ChildProcess sleeper("/bin/sleep", {"1000"});
  RunInfo info = sample();
  info.processes = {{"sleep", sleeper.pid()}, {"sprung-can-bridge", sleeper.pid()}, {"sleep", 0}};
  const pid_t launcher = fork();
  if (launcher == 0) {
    RunFile file("killed");
    file.write(info);
    _exit(0);  // without a destructor
  }
  waitpid(launcher, nullptr, 0);
  EXPECT_FALSE(read_run_file("killed"));
  const auto left = left_behind("mine");
  ASSERT_EQ(left.size(), 1u) << "only where the program fits";
  EXPECT_EQ(left[0].pid, sleeper.pid());
  const RunFile again("killed");
  EXPECT_EQ(left_behind("killed").size(), 1u) << "whoever has the lock now";
  EXPECT_TRUE(left_behind("mine").empty()) << "of a run that is up nothing is left behind";
  sleeper.stop(5.0);
  EXPECT_TRUE(left_behind("killed").empty());
}

/// Else the second try would begin beside what made the first one stop.
TEST_F(RunFileTest, LauncherThatGivesUpBeforeItWroteLeavesWhatAKilledOneWrote) {
  ChildProcess sleeper("/bin/sleep", {"1000"});
  RunInfo info = sample();
  info.processes = {{"sleep", sleeper.pid()}};
  const pid_t launcher = fork();
  if (launcher == 0) {
    RunFile file("killed");
    file.write(info);
    _exit(0);  // without a destructor
  }
  waitpid(launcher, nullptr, 0);
  { const RunFile gives_up("killed"); }
  EXPECT_EQ(left_behind("killed").size(), 1u);
  EXPECT_EQ(left_behind("mine").size(), 1u);
  sleeper.stop(5.0);
}

TEST_F(RunFileTest, NothingRunningSaysHowToStart) {
  EXPECT_THAT([] { require_running("default", ""); },
              testing::ThrowsMessage<NotRunning>(
                  AllOf(HasSubstr("no robot is up"), HasSubstr("sprung up single_leg --sim"))));
}

TEST_F(RunFileTest, AnotherRobotIsNamed) {
  RunFile file("default");
  file.write(sample());
  EXPECT_EQ(require_running("default", "single_leg").robot, "single_leg");
  EXPECT_THAT([] { require_running("default", "pegasus"); },
              testing::ThrowsMessage<NotRunning>(HasSubstr("robot single_leg is up, not pegasus")));
}

TEST_F(RunFileTest, SecondLauncherIsRefusedAndTheFirstStaysKnown) {
  RunFile file("default");
  file.write(sample());
  EXPECT_THAT([] { RunFile second("default"); },
              testing::ThrowsMessage<std::runtime_error>(HasSubstr("robot single_leg is up already")));
  EXPECT_TRUE(read_run_file("default"));
}

TEST_F(RunFileTest, EndOfTheLauncherEndsTheRun) {
  { RunFile(std::string("default")).write(sample()); }
  EXPECT_FALSE(read_run_file("default"));
  RunFile next("default");
  EXPECT_FALSE(read_run_file("default"));  // nothing written yet
}

TEST_F(RunFileTest, DeathOfTheLauncherEndsTheRunThoughItsFileStays) {
  const pid_t child = fork();
  if (child == 0) {
    RunFile file("default");
    file.write(sample());
    _exit(0);  // no destructor, as after SIGKILL
  }
  waitpid(child, nullptr, 0);
  EXPECT_TRUE(std::filesystem::exists(run_file_path("default")));
  EXPECT_FALSE(read_run_file("default"));
  RunFile next("default");
  next.write(sample());
  EXPECT_TRUE(read_run_file("default"));
}

TEST_F(RunFileTest, BrokenFileIsNoRunAndIsNotRemoved) {
  RunFile file("default");
  file.write(sample());
  std::ofstream(run_file_path("default")) << "{\"instance\": 3";
  EXPECT_FALSE(read_run_file("default"));
  EXPECT_TRUE(std::filesystem::exists(run_file_path("default")));
}

TEST_F(RunFileTest, InstancesAreApart) {
  RunFile file("second");
  RunInfo info = sample();
  info.instance = "second";
  file.write(info);
  EXPECT_FALSE(read_run_file("default"));
  EXPECT_TRUE(read_run_file("second"));
}

}  // namespace
}  // namespace sprung
