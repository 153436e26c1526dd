#include "tools/operate/launcher/run_description.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <lcm/lcm-cpp.hpp>
#include <set>
#include <thread>

#include "lcmtypes/channels.h"
#include "robots/robot_loader.h"
#include "runtime/node.h"
#include "runtime/own_port.h"
#include "runtime/process_status.h"
#include "tests/support/own_folder.h"
#include "tools/operate/launcher/lead_finder.h"
#include "tools/operate/launcher/recorder_plan.h"

namespace sprung {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

LaunchRequest request() {
  LaunchRequest request;
  request.robot = "single_leg";
  request.simulation = true;
  request.timeout_s = 0.2;
  request.lcm_url = lcm_url_on_port(own_port());
  return request;
}

/// Says what the launcher on the host with the bridge says, until it is destroyed.
class Lead {
 public:
  /// @param behind_us of its clock.
  Lead(const LaunchRequest& request, const std::string& robot, ProcessState state,
       std::int64_t behind_us = 0) {
    status_.process = kLauncherProgram;
    status_.robot = robot;
    status_.state = state;
    status_.host = "trunk";
    status_.utc_offset_us = utc_us() - 5'000'000 - behind_us;  // the run began 5 s ago
    node_ = std::make_unique<Node>(NodeOptions{request.lcm_url, 4711, 0, {}});
    thread_ = std::thread([this, behind_us] {
      auto publisher = node_->publisher<ProcessStatus>(channels::kProcessStatus);
      while (!done_) {
        status_.stamp.utime_us = utc_us() - behind_us - status_.utc_offset_us;
        publisher.publish(status_);
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
      }
    });
  }
  ~Lead() {
    done_ = true;
    thread_.join();
  }

 private:
  ProcessStatus status_;
  std::unique_ptr<Node> node_;
  std::atomic<bool> done_{false};
  std::thread thread_;
};

TEST(RunDescription, JoinedRunHasTheLeadsSessionAndBegin) {
  LaunchRequest joining = request();
  joining.timeout_s = 20.0;
  const Lead lead(joining, "single_leg", ProcessState::kReady);
  const RunInfo info = describe_joined_run(joining, load_robot("single_leg"));
  EXPECT_EQ(info.session, 4711);
  const std::int64_t age_us = monotonic_us() - info.epoch_us;
  EXPECT_GE(age_us, 5'000'000);
  EXPECT_LT(age_us, 40'000'000);
}

TEST(RunDescription, HostsWhoseClocksAreFarApartAreNotJoined) {
  LaunchRequest joining = request();
  joining.timeout_s = 20.0;
  const Lead lead(joining, "single_leg", ProcessState::kReady, 60'000'000);
  EXPECT_THAT([&] { describe_joined_run(joining, load_robot("single_leg")); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(HasSubstr("trunk"), HasSubstr("s apart"), HasSubstr("chrony"))));
}

TEST(RunDescription, NobodyLeadsSaysWhatToDo) {
  const auto join = [] { describe_joined_run(request(), load_robot("single_leg")); };
  EXPECT_THAT(join, testing::ThrowsMessage<std::runtime_error>(
                        testing::AllOf(HasSubstr("sprung up single_leg"), HasSubstr("ttl"))));
}

TEST(RunDescription, LeadOfAnotherRobotOrOneThatStopsIsNotJoined) {
  const LaunchRequest joining = request();
  {
    const Lead other(joining, "pegasus", ProcessState::kReady);
    EXPECT_FALSE(find_lead(joining.lcm_url, "single_leg", 0.2));
  }
  const Lead stopping(joining, "single_leg", ProcessState::kStopping);
  EXPECT_FALSE(find_lead(joining.lcm_url, "single_leg", 0.2));
}

TEST(EpochHere, ClocksOfTwoHostsMeetByUtc) {
  // The run began at UTC 1000 s. Here it is 1007.5 s, and this machine booted 100 s ago.
  EXPECT_EQ(epoch_here_us(1'000'000'000, 1'007'500'000, 100'000'000), 92'500'000);
}

/// A launcher of another version, whose status has another layout.
TEST(RunDescription, LeadThatCannotBeReadIsNamedAsSuch) {
  LaunchRequest joining = request();
  joining.timeout_s = 1.0;
  std::atomic<bool> done{false};
  std::thread lead([&] {
    lcm::LCM lcm(joining.lcm_url);
    const std::array<char, 64> strange{1, 2, 3, 4, 5, 6, 7, 8};
    while (!done) {
      lcm.publish(channels::kProcessStatus, strange.data(), strange.size());
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    }
  });
  EXPECT_THAT([&] { describe_joined_run(joining, load_robot("single_leg")); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::AllOf(HasSubstr("cannot be read"), HasSubstr("same commit"))));
  done = true;
  lead.join();
}

TEST(RunDescription, BusesAreThoseOfTheBridgeAsTheyAreInThisRun) {
  LaunchRequest asked = request();
  asked.can = {"leg=socketcan:can3"};
  RobotConfig robot = load_robot("single_leg");
  EXPECT_THAT(describe_run(asked, robot).buses, testing::ElementsAre("socketcan:can3"));
  robot.processes.back().host = "trunk";  // the bridge
  EXPECT_THAT(describe_run(asked, robot).buses, testing::IsEmpty());
  asked.can = {"arm=socketcan:can3"};
  EXPECT_THROW(describe_run(asked, load_robot("single_leg")), std::invalid_argument);
}

/// Others read it, from working folders of their own.
TEST(RunDescription, RobotFolderIsAbsoluteHoweverTheRobotWasNamed) {
  RobotConfig robot = load_robot("single_leg");
  const fs::path folder = fs::canonical(robot.folder);
  robot.folder = fs::proximate(folder).string();
  ASSERT_TRUE(fs::path(robot.folder).is_relative()) << robot.folder;
  EXPECT_EQ(describe_run(request(), robot).robot_folder, folder.string());
}

TEST(RunDescription, SessionsDiffer) {
  std::set<std::int64_t> sessions;
  for (int i = 0; i < 100; ++i) sessions.insert(describe_run(request(), load_robot("single_leg")).session);
  EXPECT_EQ(sessions.size(), 100u);
  EXPECT_EQ(sessions.count(0), 0u);
}

TEST(LogPath, NeverNamesAFileThatIsThere) {
  const fs::path folder = test::temp_dir() + "sprung_log_path";
  std::set<std::string> paths;
  for (int i = 0; i < 5; ++i) {
    const std::string path = log_path(folder.string(), "single_leg");
    EXPECT_TRUE(paths.insert(path).second);
    std::ofstream(path) << "x";
  }
  const fs::path split = log_path(folder.string(), "fennec");
  std::ofstream(folder / (split.stem().string() + "-000.lcm")) << "x";  // first part of a recording
  EXPECT_NE(log_path(folder.string(), "fennec"), split);
  EXPECT_EQ(lines_path("/a/x-2.lcm"), "/a/x-2.txt");
  fs::remove_all(folder);
}

TEST(RecorderPlan, OwnRecorderKnowsTheRunAndWhatWasTyped) {
  LaunchRequest asked = request();
  asked.command_line = "sprung up single_leg --sim";
  RunInfo info;
  info.session = 12;
  info.log = "/logs/x.lcm";
  const PlannedProcess planned = plan_recorder(asked, load_robot("single_leg"), info);
  EXPECT_EQ(planned.program, "sprung-recorder");
  EXPECT_THAT(planned.arguments, Contains("/logs/x.lcm"));
  EXPECT_THAT(planned.arguments, Contains("sprung up single_leg --sim"));
  EXPECT_TRUE(says_status(planned));
}

TEST(RecorderPlan, SplittingAndDiskReachTheRecorder) {
  LaunchRequest asked = request();
  asked.recording = {"JOINT.*", 100.0, 2.5, 50.0};
  RunInfo info;
  info.log = "/logs/x.lcm";
  const auto arguments = plan_recorder(asked, load_robot("single_leg"), info).arguments;
  const auto value = [&](const std::string& option) {
    const auto at = std::find(arguments.begin(), arguments.end(), option);
    return at == arguments.end() ? "(absent)" : *(at + 1);
  };
  EXPECT_EQ(value("--channels"), "JOINT.*");
  EXPECT_DOUBLE_EQ(std::stod(value("--split-mb")), 100.0);
  EXPECT_DOUBLE_EQ(std::stod(value("--split-min")), 2.5);
  EXPECT_DOUBLE_EQ(std::stod(value("--min-free-mb")), 50.0);
  EXPECT_EQ(value("--file"), "/logs/x.lcm");
  EXPECT_EQ(first_file("/logs/x.lcm", asked.recording), "/logs/x-000.lcm");
  EXPECT_EQ(first_file("/logs/x.lcm", RecordingRequest()), "/logs/x.lcm");
}

TEST(RecorderPlan, LcmsOwnLoggerKnowsNoneOfIt) {
  LaunchRequest asked = request();
  asked.recorder = "lcm-logger";
  asked.recording.split_MB = 1.0;
  EXPECT_THAT([&] { plan_recorder(asked, load_robot("single_leg"), RunInfo()); },
              testing::ThrowsMessage<std::invalid_argument>(HasSubstr("leave out --with lcm-logger")));
}

TEST(RecorderPlan, LcmsOwnLoggerWhereAsked) {
  LaunchRequest asked = request();
  asked.recorder = "lcm-logger";
  RunInfo info;
  info.log = "/logs/x.lcm";
  const PlannedProcess planned = plan_recorder(asked, load_robot("single_leg"), info);
  EXPECT_EQ(planned.program, "lcm-logger");
  EXPECT_THAT(planned.arguments, Contains("/logs/x.lcm"));
  EXPECT_THAT(planned.arguments, Not(Contains("--session")));
  EXPECT_FALSE(says_status(planned));
}

}  // namespace
}  // namespace sprung
