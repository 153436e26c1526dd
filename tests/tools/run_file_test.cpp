#include "tools/launcher/run_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;

class RunFile : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() / ("sprung_run_" + std::to_string(getpid()));
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
    info.processes = {{"sprung-can-bridge", 12}};
    return info;
  }
  std::filesystem::path folder_;
};

TEST_F(RunFile, WhatIsWrittenIsReadBack) {
  write_run_file(sample());
  const auto info = read_run_file("default");
  ASSERT_TRUE(info);
  EXPECT_EQ(info->robot, "single_leg");
  EXPECT_EQ(info->session, 0x7123456789ABCDEF);
  ASSERT_EQ(info->processes.size(), 1u);
  EXPECT_EQ(info->processes[0].pid, 12);
}

TEST_F(RunFile, NothingRunningSaysHowToStart) {
  EXPECT_THAT([] { require_running("default", ""); },
              testing::ThrowsMessage<NotRunning>(
                  AllOf(HasSubstr("no robot is up"), HasSubstr("sprung up single_leg --sim"))));
}

TEST_F(RunFile, AnotherRobotIsNamed) {
  write_run_file(sample());
  EXPECT_EQ(require_running("default", "single_leg").robot, "single_leg");
  EXPECT_THAT([] { require_running("default", "pegasus"); },
              testing::ThrowsMessage<NotRunning>(HasSubstr("robot single_leg is up, not pegasus")));
}

TEST_F(RunFile, FileOfADeadLauncherIsNoRun) {
  RunInfo info = sample();
  info.launcher_pid = 0x3FFFFFFF;
  write_run_file(info);
  EXPECT_FALSE(read_run_file("default"));
  EXPECT_FALSE(std::filesystem::exists(run_file_path("default")));
}

TEST_F(RunFile, BrokenFileIsNoRun) {
  write_run_file(sample());
  std::ofstream(run_file_path("default")) << "{\"instance\": 3";
  EXPECT_FALSE(read_run_file("default"));
}

TEST_F(RunFile, InstancesAreApart) {
  RunInfo info = sample();
  info.instance = "second";
  write_run_file(info);
  EXPECT_FALSE(read_run_file("default"));
  EXPECT_TRUE(read_run_file("second"));
}

}  // namespace
}  // namespace sprung
