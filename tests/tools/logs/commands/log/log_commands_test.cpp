/// sprung log and sprung replay as they are used, by people who err.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "lcmtypes/channels.h"
#include "sprung_msgs/can_trace_t.hpp"
#include "tests/support/paths.h"
#include "tests/tools/logs/replay/logged_run_fixture.h"
#include "tests/tools/logs/spy/run_command.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/log/writer.h"
#include "tools/logs/recorder/log_messages.h"
#include "tools/operate/launcher/run_file.h"

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
  /// The log with the robot.yaml in it changed, or without it where `change` says so.
  template <class Change>
  static std::string rewritten(const char* name, Change change) {
    const std::string path = *folder_ / name;
    log::Reader reader(log());
    log::Writer writer(path);
    for (log::Event event; reader.next(event);) {
      auto metadata = event.channel == channels::kLogMetadata ? read_log_metadata(event.data, event.size)
                                                              : std::optional<sprung_msgs::log_metadata_t>();
      if (!metadata) {
        writer.write(event);
      } else if (change(metadata->robot_yaml)) {
        const std::vector<std::uint8_t> bytes = message_bytes(*metadata);
        writer.write(event.time_us, event.channel, bytes.data(), bytes.size());
      }
    }
    writer.close();
    return path;
  }
  /// The log with one more event: node 2 of the leg's bus has answered a SYNC.
  static std::string with_a_frame(const std::string& path) {
    const std::string longer = *folder_ / "traced.lcm";
    log::Reader reader(path);
    log::Writer writer(longer);
    for (log::Event event; reader.next(event);) writer.write(event);
    sprung_msgs::can_trace_t trace{};
    trace.n = 1;
    trace.frames.resize(1);
    trace.frames[0].can_id = 0x182;
    trace.frames[0].dlc = 8;
    const std::vector<std::uint8_t> bytes = message_bytes(trace);
    writer.write(0, channels::kCanTrace, bytes.data(), bytes.size());
    writer.close();
    return longer;
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

/// Of a robot whose file on disk has other names by now, or was never here.
TEST_F(LogCommands, JointsHaveTheNamesThatStandInTheLog) {
  const std::string renamed = rewritten("renamed.lcm", [](std::string& yaml) {
    for (std::size_t at = 0; (at = yaml.find("knee", at)) != std::string::npos; at += 4)
      yaml.replace(at, 4, "shin");
    return true;
  });
  const std::string field = " --fields 'JOINT_STATE.joints[shin].gear_output_torque_Nm' ";
  expect("log csv " + renamed + field + "--names", 0, "JOINT_STATE.joints[shin].gear_output_torque_Nm (Nm)");
  expect("log plot " + renamed + field + "-o " + (*folder_ / "shin.html"), 0, "shin.html");
  expect("log csv " + renamed + " --fields 'JOINT_STATE.joints[1].gear_torque_Nm'", 1,
         "did you mean 'JOINT_STATE.joints[shin].gear_output_torque_Nm'");
  expect("can dump --log " + with_a_frame(renamed), 0, "shin");
  expect("log filter " + renamed + " --channels JOINT_STATE" + out(), 0, "events");
  expect("log csv " + (*folder_ / "out.lcm") + field, 0, "cycle");
}

TEST_F(LogCommands, ALogWithoutItsRobotSaysSoAndWhatFollowsFromThat) {
  const std::string bare = rewritten("bare.lcm", [](std::string&) { return false; });
  const char* const says = "bare.lcm: no robot.yaml is in it";
  expect("log info " + bare, 0, says);
  expect("log csv " + bare + " --fields 'JOINT_STATE.joints[1].status'", 0, says);
  expect("log csv " + bare + " --fields 'JOINT_STATE.joints[knee].status'", 1,
         "say joints[0], not joints[knee]");
  expect("log plot " + bare + " --fields JOINT_STATE.n_joints -o " + (*folder_ / "n.html"), 0, says);
  expect("log mcap " + bare + " -o " + (*folder_ / "bare.mcap"), 0,
         "no robot.yaml is in it, so none is attached");
  expect("can dump --log " + bare, 0, "buses, nodes and objects have numbers and no names");
  expect("log diff " + log() + " " + bare, 0, "no LOG_METADATA in the second log");
}

TEST_F(LogCommands, APictureThatNobodyDrawsIsRefusedWithThoseThatThereAre) {
  const std::string plot = "log plot " + log() + " --fields JOINT_STATE.n_joints -o ";
  expect(plot + (*folder_ / "n.svg"), 2, "SVG is no longer written; .html can be zoomed and printed");
  expect(plot + (*folder_ / "n.jpg"), 2, "its name ends in .html or .png");
}

TEST_F(LogCommands, AnEncodingOfMcapThatIsGoneIsRefusedWithWhatReadsTheOther) {
  expect("log mcap " + log() + " --encoding json -o " + (*folder_ / "json.mcap"), 2, "PlotJuggler read it");
}

TEST_F(LogCommands, AFileThatIsNoLogIsNamed) {
  for (const char* command : {"info ", "repair ", "filter --channels X ", "merge "})
    expect("log " + (command + no_log()) + (std::string(command) == "info " ? "" : out()), 1,
           "holds no event: is it an LCM log?");
}

TEST_F(LogCommands, AnswerThatNobodyCouldReadIsAFailure) {
  const test::CommandEnd end = test::run_command("( " + test::bin_dir() + "/sprung log info " + log() +
                                                 " > /dev/full )");
  EXPECT_EQ(end.status, 1);
  EXPECT_THAT(end.output, HasSubstr("standard output"));
}

TEST_F(LogCommands, ReaderThatHasSeenEnoughIsNoFailure) {
  const test::CommandEnd end = test::run_command("bash -o pipefail -c '(sleep 0.2; " + test::bin_dir() +
                                                 "/sprung robot show pegasus) | true'");
  EXPECT_EQ(end.status, 0) << end.output;
  EXPECT_EQ(end.output, "");
}

}  // namespace
}  // namespace sprung
