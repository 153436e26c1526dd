/// sprung log and sprung replay as they are used, by people who err.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "tests/support/paths.h"
#include "tests/tools/replay/logged_run_fixture.h"
#include "tests/tools/spy/run_command.h"
#include "tools/launcher/run_file.h"

namespace sprung {
namespace {

using test::Folder;
using test::run_sprung;
using testing::HasSubstr;

class LogCommands : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new Folder("log-commands");
    const test::LogsOf logs(folder_->path().string());
    test::run(test::jump_script_of(load_robot("single_leg"), 100));
    setenv("SPRUNG_RUN_DIR", folder_->path().c_str(), 1);
  }
  static void TearDownTestSuite() {
    delete folder_;
    folder_ = nullptr;
  }
  static std::string log() { return *folder_ / "single_leg-000.lcm"; }
  static std::string out() { return " -o " + (*folder_ / "out.lcm"); }
  static std::string no_log() {
    const std::string path = *folder_ / "no_log.txt";
    std::ofstream(path) << "time,torque\n1,2\n";
    return path;
  }
  static void expect(const std::string& arguments, int status, const char* text) {
    const test::CommandEnd end = run_sprung(arguments);
    EXPECT_EQ(end.status, status) << arguments << "\n" << end.output;
    EXPECT_THAT(end.output, HasSubstr(text)) << arguments;
  }

  static Folder* folder_;
};
Folder* LogCommands::folder_ = nullptr;

TEST_F(LogCommands, ReplayRefusesOptionsThatWouldChangeNothing) {
  const std::string into = "replay " + log() + " --into estimator,planner,controller ";
  for (const char* option :
       {"--loop", "--step", "--speed 2", "--remap A=B", "--lcm-url udpm://239.255.1.1:7000"})
    expect(into + option, 2, "are for a replay onto LCM");
  expect(into + "--channels JOINT_STATE", 2, "--into compares all");
  expect(into + "--diff " + log(), 2, "not both");
  for (const char* option : {"--robot single_leg", "--preset best", "--out x.lcm", "--json"})
    expect("replay " + log() + " " + option, 2, "need --into CORES");
  expect("replay " + log() + " --html x.html", 2, "--html needs");
  expect(into, 0, "\nidentical\n");
}

TEST_F(LogCommands, ReplayNeverOverwritesItsLog) {
  const auto size = std::filesystem::file_size(log());
  for (const char* option : {"--out ", "--html "})
    expect("replay " + log() + " --into estimator " + option + log(), 2, "is the log that is read");
  EXPECT_EQ(std::filesystem::file_size(log()), size);
}

TEST_F(LogCommands, ReplayOntoTheNetworkOfARobotThatIsUpIsRefusedWhateverItsInstance) {
  RunFile lock("second");
  RunInfo info;
  info.instance = "second";
  info.robot = "single_leg";
  info.lcm_url = "udpm://239.255.76.99:7799?ttl=1";
  lock.write(info);
  expect("replay " + log() + " --lcm-url udpm://239.255.76.99:7799", 2, "single_leg is up on");
}

TEST_F(LogCommands, WhatHasNothingInItFails) {
  expect("log cut " + log() + " --from 1000" + out(), 1, "has nothing in that time");
  expect("log filter " + log() + " --channels JOINT" + out(), 1, "has nothing in that time");
  expect("log cut " + log() + " --from 5 --to 3" + out(), 2, "ends before it begins");
  expect("log cut " + log() + " --from 0.05" + out(), 0, "events");
}

TEST_F(LogCommands, AFileThatIsNoLogIsNamed) {
  for (const char* command : {"info ", "repair ", "filter --channels X ", "merge "})
    expect("log " + (command + no_log()) + (std::string(command) == "info " ? "" : out()), 1,
           "holds no event: is it an LCM log?");
}

TEST_F(LogCommands, AnswerThatNobodyCouldReadIsAFailure) {
  const test::CommandEnd end =
      test::run_command("( " + test::bin_dir() + "/sprung log info " + log() + " > /dev/full )");
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.output, HasSubstr("standard output"));
}

}  // namespace
}  // namespace sprung
