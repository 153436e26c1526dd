/// Logs of real processes: recorded, read and written by LCM's own programs too, replayed into the cores bit
/// for bit.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <lcm/lcm-cpp.hpp>
#include <map>
#include <vector>

#include "lcmtypes/channels.h"
#include "runtime/node.h"
#include "signals/modes.h"
#include "tests/support/paths.h"
#include "tests/system/system_fixture.h"
#include "tools/logs/log/reader.h"
#include "tools/logs/recorder/log_messages.h"
#include "tools/logs/replay/replay_run.h"

namespace sprung {
namespace {

using testing::HasSubstr;

class RecordReplay : public SystemTest {
 protected:
  void SetUp() override {
    SystemTest::SetUp();
    log_folder_ = folder_ / "logs";
  }
  /// The only log that `sprung up` wrote.
  std::string log() const {
    std::vector<std::string> found;
    for (const auto& entry : std::filesystem::directory_iterator(log_folder_)) {
      if (entry.path().extension() == ".lcm") found.push_back(entry.path().string());
    }
    EXPECT_EQ(found.size(), 1u);
    return found.empty() ? "" : found.front();
  }
  void down() {
    const CommandResult down = sprung("down");
    EXPECT_EQ(down.status, 0) << down.output;
    EXPECT_EQ(wait_for_up(), 0);
  }
  /// Whether a process of any session on our network comes to say that it lives.
  bool hears_status_of(const std::string& process) const {
    InputQueue<sprung_msgs::process_status_t> statuses(256);
    Node node(NodeOptions{lcm_url(), 0, 0, {}});
    node.subscribe_message(channels::kProcessStatus, CountLimits::none(), statuses);
    const Receiving receiving(node);
    for (const std::int64_t end_us = node.utime_us() + std::llround(1e6 * kTimeout_s);
         node.utime_us() < end_us;) {
      node.wait_for_input(node.utime_us() + 50'000);
      while (const auto status = statuses.pop()) {
        if (status->process == process) return true;
      }
    }
    return false;
  }
  static ReplayResult replay(const std::string& log) {
    ReplayRequest request;
    request.log = log;
    return run_replay(request);
  }
  static std::string why(const ReplayResult& result) {
    return (result.differences.first() ? result.differences.first()->text("in the log", "now") : "") + " " +
           result.counts.first_incomplete;
  }
  struct Event {
    std::string channel;
    std::vector<std::uint8_t> data;
    bool operator==(const Event& other) const { return channel == other.channel && data == other.data; }
  };
  /// By LCM's own reader.
  static std::vector<Event> read_by_lcm(const std::string& path) {
    lcm::LogFile log(path, "r");
    EXPECT_TRUE(log.good()) << path;
    std::vector<Event> out;
    while (const lcm::LogEvent* event = log.readNextEvent()) {
      const auto* const data = static_cast<const std::uint8_t*>(event->data);
      out.push_back({event->channel, {data, data + event->datalen}});
    }
    return out;
  }
  /// Without what recorders and LCM itself add.
  static std::vector<Event> of_the_robot(std::vector<Event> events) {
    const auto added = [](const Event& event) {
      return event.channel.rfind("L", 0) == 0 ? event.channel != channels::kLegCommand
                                              : event.channel == channels::kProcessStatus;
    };
    events.erase(std::remove_if(events.begin(), events.end(), added), events.end());
    return events;
  }
  std::string replace_in_robot(const std::string& from, const std::string& to) const {
    std::ifstream in(std::filesystem::path(robot_.folder) / "robot.yaml");
    std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const std::size_t at = text.find(from);
    EXPECT_NE(at, std::string::npos);
    const std::string path = (folder_ / "other.yaml").string();
    std::ofstream(path) << text.replace(at, from.size(), to);
    return path;
  }
};

TEST_F(RecordReplay, JumpOfSeparateProcessesInLockStepIsReproducedBitForBit) {
  up("lockstep", "--speed 4");
  ASSERT_EQ(sprung("stand").status, 0);
  const CommandResult jump = sprung("jump --count 2");
  ASSERT_EQ(jump.status, 0) << jump.output;
  ASSERT_EQ(sprung("sit").status, 0);
  down();
  const ReplayResult result = replay(log());
  EXPECT_TRUE(result.identical()) << why(result);
  EXPECT_EQ(result.counts.first_seq, 0);
  EXPECT_GT(result.counts.compared, 4 * 3000);
  EXPECT_EQ(result.flaws.unanswered, 0);

  const CommandResult same = sprung("replay " + log() + " --into estimator,planner,controller");
  EXPECT_EQ(same.status, 0);
  EXPECT_THAT(same.output, HasSubstr("\nidentical\n"));
  const std::string page = (folder_ / "difference.html").string();
  const CommandResult changed = sprung(
      "replay " + log() + " --into estimator,planner,controller --html " + page + " --robot " +
      replace_in_robot("friction_compensation: 0.9", "friction_compensation: 0.8"));
  EXPECT_EQ(changed.status, 1);
  EXPECT_THAT(changed.output, HasSubstr("first difference: LEG_COMMAND cycle"));
  EXPECT_THAT(changed.output, HasSubstr("legs[0].friction_compensation 0.9"));
  EXPECT_TRUE(std::filesystem::exists(page));
}

TEST_F(RecordReplay, LogBeginsWithWhatItIsOfAndEndsInOrderAfterAllOthers) {
  up("lockstep", "--speed 2");
  down();
  const std::vector<Event> events = read_by_lcm(log());
  ASSERT_GT(events.size(), 100u);
  EXPECT_EQ(events.front().channel, channels::kLogMetadata);
  EXPECT_EQ(events.back().channel, channels::kLogEnd);
  const auto metadata = read_log_metadata(events.front().data.data(), events.front().data.size());
  ASSERT_TRUE(metadata);
  EXPECT_EQ(metadata->robot, "single_leg");
  EXPECT_EQ(metadata->clock, "lockstep");
  EXPECT_THAT(metadata->command_line, HasSubstr("up single_leg"));
  EXPECT_THAT(metadata->robot_yaml, HasSubstr("robot: single_leg"));
  const auto end = read_log_end(events.back().data.data(), events.back().data.size());
  ASSERT_TRUE(end);
  EXPECT_EQ(static_cast<LogEndReason>(end->reason), LogEndReason::kAsked);
  EXPECT_EQ(end->missing, 0);
  EXPECT_EQ(end->events, static_cast<std::int64_t>(events.size()) - 1);
  // The last word of every other process is in it.
  std::map<std::string, std::int8_t> states;
  for (const Event& event : events) {
    sprung_msgs::process_status_t status;
    if (event.channel != channels::kProcessStatus) continue;
    ASSERT_GT(status.decode(event.data.data(), 0, static_cast<int>(event.data.size())), 0);
    states[status.process] = status.state;
  }
  for (const char* process : {"sprung-can-bridge", "sprung-torque-estimator", "sprung-leg-controller",
                              "sprung-motion-planner", "sprung-sim-drives"})
    EXPECT_EQ(states[process], static_cast<std::int8_t>(ProcessState::kStopping)) << process;
}

/// Events that lcm-logplayer sends from our log come back the same, recorded by sprung-recorder, and as far
/// as it keeps up by lcm-logger.
TEST_F(RecordReplay, LcmsOwnPlayerAndLoggerReadAndWriteTheSameFiles) {
  up("lockstep", "--speed 1");
  usleep(500'000);
  down();
  const std::string theirs = (folder_ / "lcm-logger.lcm").string(), ours = (folder_ / "sprung.lcm").string();
  {
    ChildProcess logger(system_program("lcm-logger", "liblcm-bin"),
                        {"--lcm-url=" + lcm_url(), "-q", "-f", theirs});
    ChildProcess recorder(test::bin_dir() + "/sprung-recorder",
                          {"--robot", "single_leg", "--session", "1", "--lcm-url", lcm_url(), "--file", ours},
                          Output::kCaptured);
    ASSERT_TRUE(hears_status_of("sprung-recorder"));
    ASSERT_TRUE(grows(theirs, 0)) << "it hears its own network's PROCESS_STATUS";
    ChildProcess player(system_program("lcm-logplayer", "liblcm-bin"), {"--lcm-url=" + lcm_url(), log()},
                        Output::kCaptured);
    ASSERT_TRUE(player.wait(kTimeout_s));
    EXPECT_EQ(player.ended(), 0);
    usleep(200'000);
    recorder.stop(5.0);
    logger.stop(5.0);
  }
  const std::vector<Event> played = of_the_robot(read_by_lcm(log()));
  EXPECT_TRUE(of_the_robot(read_by_lcm(ours)) == played);
  const std::vector<Event> logged = of_the_robot(read_by_lcm(theirs));
  EXPECT_GT(logged.size(), played.size() / 10);
  auto at = played.begin();  // it loses some, and changes none
  for (const Event& event : logged) {
    at = std::find(at, played.end(), event);
    ASSERT_TRUE(at != played.end()) << event.channel;
  }
  EXPECT_TRUE(replay(ours).identical()) << why(replay(ours));
}

TEST_F(RecordReplay, LogOfLcmsLoggerIsReplayedWithTheRobotThatTheProcessesNamed) {
  up("lockstep", "--speed 1 --with lcm-logger");
  ASSERT_EQ(sprung("stand").status, 0);
  down();
  const ReplayResult result = replay(log());  // what lcm-logger lost is missing
  EXPECT_GT(result.counts.compared, 1000);
  if (result.counts.incomplete == 0 && result.lockstep.every_message()) {
    EXPECT_TRUE(result.identical()) << why(result);
  }
  EXPECT_THAT(result.source, HasSubstr("preset best"));
}

/// Then all processes are told to end at once, and the bridge still brings its drives to rest.
TEST_F(RecordReplay, RecorderIsTheLastToStopAlsoWhenTheLauncherDies) {
  up("lockstep", "--speed 1");
  ASSERT_EQ(sprung("stand").status, 0);
  up_process().signal(SIGKILL);
  wait_for_up();
  ASSERT_TRUE(all_end(kTimeout_s));
  const std::vector<Event> events = read_by_lcm(log());
  ASSERT_FALSE(events.empty());
  EXPECT_EQ(events.back().channel, channels::kLogEnd);
  std::map<std::string, std::int8_t> states;
  for (const Event& event : events) {
    sprung_msgs::process_status_t status;
    if (event.channel == channels::kProcessStatus &&
        status.decode(event.data.data(), 0, static_cast<int>(event.data.size())) > 0)
      states[status.process] = status.state;
  }
  EXPECT_EQ(states["sprung-can-bridge"], static_cast<std::int8_t>(ProcessState::kStopping));
}

TEST_F(RecordReplay, RecorderRefusesADiskThatIsNearlyFull) {
  up("lockstep", "--speed 1");
  const CommandResult record = sprung("record " + (folder_ / "x.lcm").string() + " --min-free-mb 1000000000");
  EXPECT_EQ(record.status, 1);
  EXPECT_THAT(record.output, HasSubstr("make room"));
}

TEST_F(RecordReplay, SplitRecordingIsReplayedPartByPart) {
  log_folder_.clear();
  up("lockstep", "--speed 1");
  const std::string file = (folder_ / "split.lcm").string();
  ChildProcess record(test::bin_dir() + "/sprung", {"record", file, "--split-mb", "1"}, Output::kCaptured);
  EXPECT_TRUE(grows(folder_ / "split-001.lcm", 100'000));
  record.signal(SIGINT);
  ASSERT_TRUE(record.wait(kTimeout_s));
  EXPECT_EQ(record.ended(), 0);
  EXPECT_THAT(record.output(), HasSubstr("0 cycles missing"));
  for (const char* part : {"split-000.lcm", "split-001.lcm"}) {
    log::Reader reader((folder_ / part).string());
    log::Event event;
    ASSERT_TRUE(reader.next(event)) << part;
    EXPECT_EQ(event.channel, channels::kLogMetadata) << part;
  }
}

/// In real time inputs are skipped and come late; what was used stands in the messages.
class RealTimeRecordReplay : public RecordReplay {};

TEST_F(RealTimeRecordReplay, JumpIsReproducedBitForBit) {
  up("realtime");
  ASSERT_EQ(sprung("stand").status, 0);
  (void)sprung("jump");  // whether it lands well on a busy machine is not the matter
  down();
  const ReplayResult result = replay(log());
  EXPECT_TRUE(result.identical()) << why(result);
  EXPECT_GT(result.counts.compared, 1000);
}

TEST_F(RealTimeRecordReplay, PegasusStandsAndIsReproducedBitForBit) {
  robot_ = load_robot("pegasus");
  up("realtime");
  ASSERT_EQ(sprung("home --from link").status, 0);
  ASSERT_EQ(sprung("stand").status, 0);
  down();
  const ReplayResult result = replay(log());
  EXPECT_TRUE(result.identical()) << why(result);
}

/// Everything that pegasus does in its demo.
TEST_F(RecordReplay, PegasusWalksInLockStepAndIsReproducedBitForBit) {
  robot_ = load_robot("pegasus");
  up("lockstep");
  ASSERT_EQ(sprung("home --from link").status, 0);
  ASSERT_EQ(sprung("stand").status, 0);
  ASSERT_EQ(sprung("walk --speed 0.2 --turn 0.1").status, 0);
  usleep(1'000'000);
  ASSERT_EQ(sprung("stop").status, 0);
  down();
  const ReplayResult result = replay(log());
  EXPECT_TRUE(result.identical()) << why(result);
  EXPECT_GT(result.counts.compared, 4 * 2000);
}

}  // namespace
}  // namespace sprung
