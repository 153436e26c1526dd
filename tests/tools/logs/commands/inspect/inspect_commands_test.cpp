/// sprung topics and sprung watch as they are used.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/support/own_folder.h"
#include "tests/support/paths.h"
#include "tests/tools/logs/spy/network_sender.h"
#include "tests/tools/logs/spy/run_command.h"

namespace sprung {
namespace {

using test::run_sprung;
using testing::HasSubstr;
using Json = nlohmann::json;

class InspectCommands : public testing::Test {
 protected:
  std::string here() const { return " --url '" + sender_.url() + "'"; }
  test::NetworkSender sender_;
};

TEST_F(InspectCommands, TopicsShowsWhatIsOnTheNetwork) {
  const auto end = run_sprung("topics --for 0.6" + here());
  EXPECT_EQ(end.status, 0) << end.output;
  EXPECT_THAT(end.output, HasSubstr("JOINT_STATE       joint_state_t"));
  EXPECT_THAT(end.output, HasSubstr("MOTION_STATE      motion_state_t"));
}

TEST_F(InspectCommands, TopicsAsJson) {
  const Json all = Json::parse(run_sprung("topics --json --for 0.6" + here()).output);
  ASSERT_EQ(all.size(), 2u);
  EXPECT_EQ(all[0]["channel"], "JOINT_STATE");
  EXPECT_GT(all[0]["rate_hz"], 10.0);
  EXPECT_GT(all[0]["missing"], 0);  // the sender leaves four of five cycles out
}

TEST_F(InspectCommands, TopicsOfASilentNetworkSaysWhatToDo) {
  const auto end = run_sprung("topics --for 0.2 --url '" + test::own_lcm_url() + "'");
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.output, HasSubstr("sprung up"));
}

TEST_F(InspectCommands, WatchPrintsChosenFieldsWithUnits) {
  const auto end = run_sprung("watch 'JOINT_STATE.joints[0].gear_output_torque_Nm' --count 3 --for 20" +
                              here());
  EXPECT_EQ(end.status, 0) << end.output;
  EXPECT_THAT(end.output, HasSubstr("joints[0].gear_output_torque_Nm  500 Nm"));
  EXPECT_EQ(std::count(end.output.begin(), end.output.end(), '\n'), 3);
}

TEST_F(InspectCommands, WatchAsJsonIsAnObjectALine) {
  const auto end = run_sprung(
      "watch MOTION_STATE.state JOINT_STATE.joints.gear_output_torque_Nm --json --rate 0 --count 20 --for "
      "20" +
      here());
  std::istringstream lines(end.output);
  std::string line;
  int joints = 0, motions = 0;
  while (std::getline(lines, line)) {
    const Json message = Json::parse(line);
    joints += message["channel"] == "JOINT_STATE" && message["fields"].size() == 2 ? 1 : 0;
    motions += message["channel"] == "MOTION_STATE" && message["fields"].size() == 1 ? 1 : 0;
  }
  EXPECT_EQ(joints + motions, 20);
  EXPECT_GT(joints, 5);
  EXPECT_GT(motions, 5);
}

TEST_F(InspectCommands, WatchKeepsToItsRate) {
  const auto end = run_sprung("watch MOTION_STATE.seq --rate 5 --for 1" + here());
  EXPECT_LE(std::count(end.output.begin(), end.output.end(), '\n'), 6);
  EXPECT_THAT(end.output, HasSubstr("seq"));
}

TEST_F(InspectCommands, WatchOfAFieldThatIsNotIsWrongUse) {
  const auto end = run_sprung("watch JOINT_STATE.nothing --for 20" + here());
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.output, HasSubstr("has no field 'nothing'"));
}

/// A log that is replayed onto a network of its own: no robot is up there.
TEST_F(InspectCommands, WatchHasTheNamesOfALogOrOfARobotThatIsNotUp) {
  const std::string watch = "watch 'JOINT_STATE.joints[hip].gear_output_torque_Nm' --count 1 --for 20" +
                            here();
  const auto without = run_sprung(watch);
  EXPECT_EQ(without.status, 2);
  EXPECT_THAT(without.output, HasSubstr("joints have names with --names-of LOG or ROBOT"));
  const std::string folder = testing::TempDir() + "watch_names_" + std::to_string(getpid());
  ASSERT_EQ(run_sprung("experiment --logs " + folder + " jump").status, 0);
  for (const std::string& from : {std::string("single_leg"), folder + "/single_leg-000.lcm"}) {
    const auto end = run_sprung(watch + " --names-of " + from);
    EXPECT_EQ(end.status, 0) << end.output;
    EXPECT_THAT(end.output, HasSubstr("joints[hip].gear_output_torque_Nm  500 Nm"));
  }
  EXPECT_EQ(run_sprung(watch + " --names-of no_such_robot").status, 1);
  std::filesystem::remove_all(folder);
}

TEST_F(InspectCommands, WatchOfASilentChannelFails) {
  const auto end = run_sprung("watch SILENT --for 0.3" + here());
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.output, HasSubstr("sprung topics"));
}

TEST_F(InspectCommands, WatchOfAPatternOfChannelsIsWrongUseAndSaysWhatPatternsAreFor) {
  for (const char* target : {"'*'", "'JOINT_STATE|MOTION_STATE'"}) {
    const auto end = run_sprung("watch --for 2 " + std::string(target) + here());
    EXPECT_EQ(end.status, 2) << target << end.output;
    EXPECT_THAT(end.output, HasSubstr("JOINT_STATE.joints[*]"));
  }
}

TEST_F(InspectCommands, TopicsNeedsTimeToListen) {
  const auto end = run_sprung("topics --for -1" + here());
  EXPECT_EQ(end.status, 2) << end.output;
  EXPECT_THAT(end.output, HasSubstr("--for"));
}

TEST_F(InspectCommands, OwnTypesAreReadFromTheirFiles) {
  const std::string path = test::temp_dir() + "own.lcm";
  std::ofstream(path) << "package own; struct thing_t { double length_m; }";
  EXPECT_EQ(run_sprung("topics --for 0.3 --types " + path + here()).status, 0);
  std::ofstream(path) << "package own; struct thing_t { lost_t x; }";
  const auto end = run_sprung("topics --for 0.3 --types " + path + here());
  EXPECT_EQ(end.status, 2);
  EXPECT_THAT(end.output, HasSubstr("no type lost_t"));
  std::remove(path.c_str());
  EXPECT_EQ(run_sprung("topics --types " + path + here()).status, 2);
}

TEST_F(InspectCommands, SpyWithoutATerminalNamesTheOtherCommands) {
  const auto end = run_sprung("spy" + here() + " </dev/null");
  EXPECT_THAT(end.output, HasSubstr("sprung watch"));
}

/// Its keys would never come, and it would ask for them without end.
TEST_F(InspectCommands, SpyWithoutKeysNamesTheOtherCommands) {
  const std::string spy = test::bin_dir() + "/sprung spy --url \"" + test::own_lcm_url() + "\" </dev/null";
  const auto end = test::run_command("timeout -s KILL 10 script -qec '" + spy + "' /dev/null");
  EXPECT_EQ(end.status, 1) << end.output;
  EXPECT_THAT(end.output, HasSubstr("sprung watch"));
}

TEST_F(InspectCommands, AnInstanceThatIsNotUpIsRefused) {
  const auto end = run_sprung("topics --instance nobody");
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.output, HasSubstr("nobody"));
}

}  // namespace
}  // namespace sprung
