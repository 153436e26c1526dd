#include "tools/logs/log/log_info.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>

#include "tests/tools/logs/log/robot_sample.h"
#include "tools/logs/log/info_text.h"
#include "tools/logs/log/time_span.h"

namespace sprung::log {
namespace {

using testing::HasSubstr;
using testing::Not;

class LogInfoTest : public testing::Test {
 protected:
  LogInfo info(const std::vector<Kept>& events) {
    write_all(path_, events);
    Reader reader(path_);
    return collect_info(reader, {"front"});
  }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
};

TEST_F(LogInfoTest, CountsWhatIsThere) {
  const LogInfo found = info(robot_events(501));
  EXPECT_EQ(found.events, 1 + 2 * 501 + 6 + 1);
  EXPECT_EQ(found.sessions, 1u);
  EXPECT_EQ(found.begin_us, kSampleBegin_us + 300);
  EXPECT_NEAR(found.duration_s, 1.002, 1e-6);  // LOG_END comes a cycle after the last
  EXPECT_NEAR(found.received_s, 1.002, 1e-6);
  const ChannelReport& joints = found.channels.at("JOINT_STATE");
  EXPECT_EQ(joints.type, "joint_state_t");
  EXPECT_EQ(joints.messages, 501);
  EXPECT_NEAR(joints.rate_Hz(), 500.0, 1e-6);
  EXPECT_EQ(joints.bytes, 501 * joint_event(0).data.size());
  EXPECT_TRUE(joints.cyclic);
  EXPECT_EQ(found.missing(), 0);
  EXPECT_FALSE(found.channels.at("SAFETY_STATE").cyclic);
  EXPECT_NEAR(found.channels.at("SAFETY_STATE").rate_Hz(), 5.0, 1e-6);
  ASSERT_TRUE(found.metadata);
  EXPECT_EQ(found.metadata->command_line, "sprung up no_such_robot");
  ASSERT_TRUE(found.end);
  EXPECT_EQ(found.end->events, found.events - 1);
}

TEST_F(LogInfoTest, MissingCyclesRepeatsAndPausesAreFound) {
  std::vector<Kept> events;
  for (int k : {0, 1, 2, 2, 3, 8, 9, 11}) events.push_back(joint_event(k));
  const LogInfo found = info(events);
  const ChannelReport& joints = found.channels.at("JOINT_STATE");
  EXPECT_EQ(joints.cycles.missing, 4 + 1);
  EXPECT_EQ(joints.cycles.gaps, 2);
  EXPECT_EQ(joints.cycles.repeats, 1);
  EXPECT_NEAR(joints.longest_pause_s, 5 * 0.002, 1e-9);
  EXPECT_NEAR(joints.longest_pause_at_s, 3 * 0.002, 1e-9);
  EXPECT_EQ(found.missing(), 5);
}

TEST_F(LogInfoTest, SaysWhatHappenedOnceEach) {
  std::vector<Kept> events = robot_events(200);
  events.push_back(safety_event(200, "damping", "drive silent", "node 3 is silent"));
  events.push_back(safety_event(201, "damping", "drive silent", "node 3 is silent"));
  const LogInfo found = info(events);
  std::vector<std::string> texts;
  for (const Incident& incident : found.incidents) texts.push_back(incident.text);
  EXPECT_THAT(texts, testing::ElementsAre("session 77", "motion standing", "safety operational",
                                          "motion walking: walk requested", "leg front stumble",
                                          "safety damping, drive silent: node 3 is silent"));
  EXPECT_EQ(found.incidents[3].seq, 100);
  EXPECT_NEAR(found.incidents[3].time_s, 0.2, 1e-9);
  EXPECT_EQ(found.leg_counts[5], 1);
}

TEST_F(LogInfoTest, LockStepCyclesMadeFromOlderMessagesAreNamed) {
  const std::vector<Kept> commands{command_event(0, -1), command_event(1, 0), command_event(2, 0),
                                   command_event(2, 0),  command_event(3, 1), command_event(4, 3),
                                   command_event(9, 7)};
  for (const char* clock : {"lockstep", "realtime"}) {
    std::vector<Kept> events{metadata_event(kSampleYaml, clock)};
    events.insert(events.end(), commands.begin(), commands.end());
    const LogInfo found = info(events);
    const bool lockstep = clock == std::string("lockstep");
    EXPECT_EQ(found.not_deterministic, lockstep ? 3 : 0) << clock;
    EXPECT_EQ(nlohmann::json::parse(info_json(found))["not_deterministic"], lockstep ? 3 : 0);
    if (!lockstep) continue;
    EXPECT_THAT(info_text(found), HasSubstr("lock-step  not deterministic: 3 cycles"));
    ASSERT_EQ(found.incidents.size(), 3u);  // the session is the first
    EXPECT_EQ(found.incidents[1].seq, 2);
    EXPECT_EQ(found.incidents[1].text, "not deterministic: made from older messages, up to cycle 3");
    EXPECT_EQ(found.incidents[2].seq, 9);
    EXPECT_EQ(found.incidents[2].text, "not deterministic: made from older messages");
  }
}

TEST_F(LogInfoTest, LockStepBridgeThatWentOnWithoutAnAnswerIsNamed) {
  for (const char* clock : {"lockstep", "realtime"}) {
    const LogInfo found = info(
        {metadata_event(kSampleYaml, clock), safety_event(5, "operational", "none", "", 2),
         safety_event(6, "operational", "none", "", 2), safety_event(7, "operational", "none", "", 5),
         safety_event(8, "disabled", "shutdown", "", 9)});
    const bool lockstep = clock == std::string("lockstep");
    EXPECT_EQ(found.without_answer, lockstep ? 3 : 0) << "neither what was before the log nor at its end";
    EXPECT_EQ(nlohmann::json::parse(info_json(found))["without_answer"], lockstep ? 3 : 0);
    if (!lockstep) continue;
    EXPECT_THAT(info_text(found),
                HasSubstr("not deterministic: the bridge went on without an answer 3 times"));
    EXPECT_EQ(found.incidents[2].seq, 7);
    EXPECT_EQ(found.incidents[2].text, "not deterministic: the bridge went on without an answer, times: 3");
  }
}

TEST_F(LogInfoTest, CyclesWithoutAnAnswerInARowAreOneIncident) {
  std::vector<Kept> events{metadata_event(kSampleYaml, "lockstep")};
  for (std::int64_t k = 5; k < 20; ++k)
    events.push_back(safety_event(k, "operational", "none", "", k < 10 ? 0 : k - 9));
  events.push_back(safety_event(30, "operational", "none", "", 13));
  const LogInfo found = info(events);
  EXPECT_EQ(found.without_answer, 13);
  ASSERT_EQ(found.incidents.size(), 4u);
  EXPECT_EQ(found.incidents[2].seq, 10);
  EXPECT_EQ(found.incidents[2].text,
            "not deterministic: the bridge went on without an answer, times: 10, up to cycle 19");
  EXPECT_EQ(found.incidents[3].text, "not deterministic: the bridge went on without an answer, times: 3");
}

TEST_F(LogInfoTest, LockStepProcessThatCallsItsRunNotDeterministicIsNamed) {
  const std::string says = "no SYNC: this run is not deterministic";
  const LogInfo found = info(
      {metadata_event(kSampleYaml, "lockstep"), status_event(4, "sprung-sim-drives", says), joint_event(4),
       safety_event(5, "operational", "none", ""), status_event(6, "sprung-sim-drives", says),
       status_event(7, "sprung-sim-drives", says)});
  EXPECT_THAT(info_text(found), HasSubstr("lock-step  not deterministic: sprung-sim-drives: no SYNC\n"));
  ASSERT_EQ(found.incidents.size(), 3u);
  EXPECT_EQ(found.incidents[2].kind, IncidentKind::kNotDeterministic);
  EXPECT_EQ(found.incidents[2].seq, 6);
  EXPECT_EQ(found.incidents[2].text, "not deterministic: sprung-sim-drives: no SYNC");
  EXPECT_EQ(nlohmann::json::parse(info_json(found))["said_not_deterministic"][0],
            "sprung-sim-drives: no SYNC");
}

TEST_F(LogInfoTest, WhatLegsMetBeforeTheLogIsNoNews) {
  const LogInfo found = info({motion_event(5, "walking", "", 40), motion_event(6, "walking", "", 42)});
  EXPECT_EQ(found.leg_counts[5], 2);
}

TEST_F(LogInfoTest, ForeignChannelsAndTypesAreShownAsSuch) {
  const LogInfo found = info(
      {{0, 1000, "CAMERA", "short"}, {1, 900, "CAMERA", std::string(100, 'x')}, joint_event(0)});
  EXPECT_EQ(found.channels.at("CAMERA").type, "");
  EXPECT_EQ(found.channels.at("CAMERA").messages, 2);
  EXPECT_EQ(found.went_back, 1);
  EXPECT_THAT(info_text(found), HasSubstr("unknown"));
}

TEST_F(LogInfoTest, DamageIsTold) {
  write_all(path_, robot_events(50));
  std::string bytes = bytes_of(path_);
  bytes.resize(bytes.size() - 10);
  put_bytes(path_, bytes);
  Reader reader(path_);
  const LogInfo found = collect_info(reader);
  EXPECT_EQ(found.damages, 1u);
  EXPECT_FALSE(found.end);
  const std::string text = info_text(found);
  EXPECT_THAT(text, HasSubstr("damaged    1 places"));
  EXPECT_THAT(text, HasSubstr("without LOG_END"));
}

TEST_F(LogInfoTest, TextShowsLegsOnlyWhenAskedAndAlwaysTheirCounts) {
  const LogInfo found = info(robot_events(200));
  EXPECT_THAT(info_text(found), Not(HasSubstr("leg front stumble")));
  EXPECT_THAT(info_text(found), HasSubstr("legs: stumble 1"));
  EXPECT_THAT(info_text(found, {true}), HasSubstr("leg front stumble"));
  EXPECT_THAT(info_text(found), HasSubstr("begins     2023-11-14 22:13:20.000 UTC"));
}

TEST_F(LogInfoTest, JsonHasTheSameForScripts) {
  const auto json = nlohmann::json::parse(info_json(info(robot_events(200))));
  EXPECT_EQ(json["channels"]["JOINT_STATE"]["messages"], 200);
  EXPECT_EQ(json["channels"]["JOINT_STATE"]["missing"], 0);
  EXPECT_TRUE(json["channels"]["SAFETY_STATE"]["missing"].is_null());
  EXPECT_EQ(json["metadata"]["robot_yaml"], "name: no_such_robot\n");
  EXPECT_EQ(json["incidents"][1]["text"], "motion standing");
  EXPECT_EQ(json["leg_events"]["stumble"], 1);
  EXPECT_EQ(json["end"]["reason"], "asked for");
}

TEST_F(LogInfoTest, StatesThatAlternateForHoursAreCountedNotKept) {
  std::vector<Kept> events;
  for (int k = 0; k < 3000; ++k) events.push_back(motion_event(k, k % 2 == 0 ? "standing" : "walking"));
  const LogInfo found = info(events);
  EXPECT_EQ(found.incidents.size(), 1u + 1000u);
  EXPECT_EQ(found.incidents_left_out, 2000);
  EXPECT_THAT(info_text(found), HasSubstr("and 2000 that are not listed"));
}

TEST_F(LogInfoTest, ANameOfAnyLengthAndBytesKeepsItsLine) {
  const LogInfo found = info({{0, 1, "\x1b[2J" + std::string(900, 'n'), "x"}, {1, 2, "SHORT", "y"}});
  const std::string text = info_text(found);
  EXPECT_THAT(text, Not(HasSubstr("\x1b")));
  EXPECT_THAT(text, HasSubstr(std::string(900, 'n') + " unknown "));
  EXPECT_THAT(text, HasSubstr("\nSHORT              unknown "));
}

TEST_F(LogInfoTest, AnEmptyLogIsNoMistake) {
  const LogInfo found = info({});
  EXPECT_EQ(found.events, 0);
  EXPECT_THAT(info_text(found), HasSubstr("0 events"));
  EXPECT_FALSE(nlohmann::json::parse(info_json(found)).is_null());
}

/// The recorder has the file open, and has handed over half an event.
TEST_F(LogInfoTest, ALogThatIsStillBeingWrittenIsNotDamagedAndItsRecorderWasNotKilled) {
  std::vector<Kept> events = robot_events(50);
  events.pop_back();
  std::optional<Writer> recorder(path_);
  for (const Kept& event : events)
    recorder->write(event.time_us, event.channel, event.data.data(), event.data.size());
  recorder->flush();
  const std::string bytes = bytes_of(path_);
  std::filesystem::resize_file(path_, bytes.size() - 10);
  {
    Reader reader(path_);
    const LogInfo found = collect_info(reader);
    EXPECT_EQ(found.damages, 0u);
    EXPECT_EQ(found.skipped_bytes, 0u);
    EXPECT_THAT(info_text(found), HasSubstr("still being written"));
    EXPECT_THAT(info_text(found), Not(HasSubstr("killed")));
    EXPECT_TRUE(nlohmann::json::parse(info_json(found)).at("being_written").get<bool>());
  }
  recorder.reset();  // as the kernel does for one that was killed
  Reader reader(path_);
  const LogInfo found = collect_info(reader);
  EXPECT_EQ(found.damages, 1u);
  EXPECT_THAT(info_text(found), HasSubstr("the recorder was killed"));
}

TEST_F(LogInfoTest, ExtentAndMetadataLeaveTheReaderAtItsBegin) {
  write_all(path_, robot_events(100));
  Reader reader(path_);
  EXPECT_NEAR(extent_of(reader).end_s, 0.2, 1e-9);
  EXPECT_EQ(find_metadata(reader)->preset, "best");
  EXPECT_EQ(read_all(reader), robot_events(100));
}

TEST(MadeBy, IsVersionAndCommit) {
  EXPECT_EQ(made_by(std::nullopt), "");
  sprung_msgs::log_metadata_t metadata{};
  EXPECT_EQ(made_by(metadata), "");
  metadata.version = "0.9";
  EXPECT_EQ(made_by(metadata), "0.9");
  metadata.git_hash = "abc";
  EXPECT_EQ(made_by(metadata), "0.9 (abc)");
}

}  // namespace
}  // namespace sprung::log
