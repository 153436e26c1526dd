#include "tools/logs/log/verify.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <limits>
#include <optional>

#include "sprung_msgs/process_status_t.hpp"
#include "tests/support/enumerators.h"
#include "tests/tools/logs/log/robot_sample.h"
#include "tools/logs/log/big_endian.h"

namespace sprung::log {
namespace {

using testing::HasSubstr;
using Kind = Finding::Kind;

class LogVerify : public testing::Test {
 protected:
  VerifyResult check(const std::vector<Kept>& events) {
    write_all(path_, events);
    return check();
  }
  VerifyResult check() {
    Reader reader(path_);
    const VerifyResult result = verify(reader);
    text_ = verify_text("robot.lcm", result);
    return result;
  }
  LogFolder folder_;
  std::string path_ = folder_("robot.lcm");
  std::string text_;
};

TEST(Findings, EveryKindHasItsOwnName) { test::expect_own_names<Finding::Kind>(); }

TEST_F(LogVerify, AWholeLogIsGood) {
  const VerifyResult result = check(robot_events(100));
  EXPECT_TRUE(result.good());
  EXPECT_TRUE(result.findings.empty());
  EXPECT_EQ(result.bytes, bytes_of(path_).size());
  EXPECT_THAT(text_, HasSubstr("robot.lcm: good, 203 events"));
}

/// As its recorder wrote it: with these events not there, and said so at the end.
std::vector<Kept> without(std::vector<Kept> events, std::ptrdiff_t first, std::ptrdiff_t last,
                          std::int64_t missing) {
  events.erase(events.begin() + first, events.begin() + last);
  events.back() = end_event(100, static_cast<std::int64_t>(events.size()) - 1, missing);
  for (std::size_t i = 0; i < events.size(); ++i) events[i].number = static_cast<std::int64_t>(i);
  return events;
}

/// A process that is late leaves its cycle out, and a hop may be lost: what a busy machine does in every
/// minute.
TEST_F(LogVerify, ALogOfRealTimeWithLateOrLostHopsIsGoodAndTheyAreListed) {
  const VerifyResult result = check(without(robot_events(100), 20, 26, 6));
  EXPECT_TRUE(result.good()) << text_;
  EXPECT_EQ(result.counts.at(Kind::kLate), 2);
  EXPECT_EQ(result.late_cycles(), 6);
  EXPECT_THAT(text_, HasSubstr("note   JOINT_STATE misses 3 cycles before cycle 12, at 0.024 s"));
  EXPECT_THAT(text_, HasSubstr("robot.lcm: good, "));
  EXPECT_THAT(
      text_,
      HasSubstr("6 cycles came too late or were lost on the way (JOINT_STATE 3, MOTION_STATE 3): no damage"));
}

TEST_F(LogVerify, ACycleThatCameOutOfItsOrderIsNotMissing) {
  std::vector<Kept> events = robot_events(100);
  std::swap(events[20].data, events[22].data);
  std::swap(events[20].channel, events[22].channel);
  const VerifyResult result = check(events);
  EXPECT_TRUE(result.good()) << text_;
  EXPECT_EQ(result.late_cycles(), 0);
}

TEST_F(LogVerify, CyclesThatTheRecorderHadAndThatAreNotThereAreDamage) {
  const VerifyResult result = check(without(robot_events(100), 20, 26, 2));
  EXPECT_FALSE(result.good());
  EXPECT_THAT(text_, HasSubstr("6 cycles are not there, and LOG_END says that the recorder missed 2"));
  EXPECT_THAT(text_, HasSubstr("; 6 cycles are not there (JOINT_STATE 3, MOTION_STATE 3)"));
  EXPECT_THAT(text_, testing::Not(HasSubstr("no damage")));
}

TEST_F(LogVerify, InLockStepNothingIsLateSoAMissingCycleIsWrong) {
  std::vector<Kept> events = without(robot_events(100), 20, 26, 6);
  events[0].data = metadata_event(kSampleYaml, "lockstep").data;
  EXPECT_FALSE(check(events).good());
  EXPECT_THAT(text_, HasSubstr("WRONG  JOINT_STATE misses 3 cycles"));
}

/// With commands of which 3 and 4 were made from older messages than their own.
std::vector<Kept> with_older_inputs(const std::string& clock) {
  std::vector<Kept> events{metadata_event(kSampleYaml, clock)};
  for (std::int64_t k = 0; k < 8; ++k) events.push_back(command_event(k, k == 3 || k == 4 ? 1 : k - 1));
  events.push_back(end_event(8, static_cast<std::int64_t>(events.size())));
  for (std::size_t i = 0; i < events.size(); ++i) events[i].number = static_cast<std::int64_t>(i);
  return events;
}

TEST_F(LogVerify, LockStepRunThatWasNotDeterministicIsNamedAndItsLogIsWhole) {
  const VerifyResult result = check(with_older_inputs("lockstep"));
  EXPECT_TRUE(result.good()) << text_;
  EXPECT_EQ(result.counts.at(Kind::kOlder), 1);
  EXPECT_THAT(text_, HasSubstr("note   not deterministic: 2 cycles made from older messages than their own: "
                               "3 to 4"));
}

/// In which the bridge had no answer in cycles 3, 4, 6, and the simulated drives went on without it.
std::vector<Kept> with_silence(const std::string& clock) {
  std::vector<Kept> events{metadata_event(kSampleYaml, clock)};
  std::int64_t missed = 0;
  for (std::int64_t k = 0; k < 8; ++k) {
    events.push_back(command_event(k, k - 1));
    missed += k == 3 || k == 4 || k == 6 ? 2 : 0;
    events.push_back(safety_event(k, "operational", "none", "", missed));
  }
  events.push_back(status_event(7, "sprung-sim-drives", "no SYNC: this run is not deterministic"));
  events.push_back(end_event(8, static_cast<std::int64_t>(events.size())));
  for (std::size_t i = 0; i < events.size(); ++i) events[i].number = static_cast<std::int64_t>(i);
  return events;
}

TEST_F(LogVerify, LockStepRunWhoseProcessesWentOnWithoutAnAnswerIsNamed) {
  EXPECT_TRUE(check(with_silence("lockstep")).good()) << text_;
  EXPECT_THAT(text_, HasSubstr("note   not deterministic: the bridge went on without an answer in 3 cycles: "
                               "3 to 4, 6\n"));
  EXPECT_THAT(text_, HasSubstr("note   not deterministic: sprung-sim-drives: no SYNC\n"));
}

TEST_F(LogVerify, OlderMessagesAreNothingSpecialInRealTime) {
  EXPECT_EQ(check(with_older_inputs("realtime")).counts.count(Kind::kOlder), 0u) << text_;
}

TEST_F(LogVerify, LcmLoggersLogIsOfRealTimeWhereItsProcessesSaySo) {
  auto status = stamped<sprung_msgs::process_status_t>(0);
  status.clock = "realtime";
  std::vector<Kept> events{joint_event(0), joint_event(5),
                           kept(channels::kProcessStatus, 5, encoded(status))};
  EXPECT_TRUE(check(events).good()) << text_;
  events.pop_back();
  EXPECT_FALSE(check(events).good());
}

TEST_F(LogVerify, WhatIsStillBeingWrittenEndsInsideAnEventWithoutDamage) {
  std::vector<Kept> events = robot_events(50);
  events.pop_back();
  std::optional<Writer> recorder(path_);
  for (const Kept& event : events)
    recorder->write(event.time_us, event.channel, event.data.data(), event.data.size());
  recorder->flush();
  std::filesystem::resize_file(path_, bytes_of(path_).size() - 10);
  EXPECT_TRUE(check().good()) << text_;
  EXPECT_THAT(text_, HasSubstr("still being written"));
  recorder.reset();
  EXPECT_FALSE(check().good());
}

TEST_F(LogVerify, MissingCyclesAreNamedWithChannelAndTime) {
  std::vector<Kept> events = robot_events(100);
  events[0].data = metadata_event(kSampleYaml, "inprocess").data;
  events.erase(events.begin() + 20, events.begin() + 26);
  const VerifyResult result = check(events);
  EXPECT_FALSE(result.good());
  EXPECT_EQ(result.counts.at(Kind::kMissing), 2);  // joints and motion
  EXPECT_THAT(text_, HasSubstr("JOINT_STATE misses 3 cycles before cycle 12, at 0.024 s"));
}

TEST_F(LogVerify, EventsThatWereTakenOutShowInTheirNumbers) {
  write_all(path_, robot_events(100));
  const std::vector<std::size_t> offsets = offsets_of(robot_events(100));
  std::string bytes = bytes_of(path_);
  bytes.erase(offsets[10], offsets[12] - offsets[10]);
  put_bytes(path_, bytes);
  const VerifyResult result = check();
  EXPECT_EQ(result.counts.at(Kind::kNumbers), 1);
  EXPECT_THAT(text_, HasSubstr("event 12"));
  EXPECT_THAT(text_, HasSubstr("comes after event 9"));
  EXPECT_FALSE(result.good());
}

TEST_F(LogVerify, DamageIsNamedWithItsPlace) {
  write_all(path_, robot_events(100));
  const std::vector<std::size_t> offsets = offsets_of(robot_events(100));
  std::string bytes = bytes_of(path_);
  bytes[offsets[50] + 22] = '\x7F';  // length of a name
  bytes.resize(bytes.size() - 1);
  put_bytes(path_, bytes);
  const VerifyResult result = check();
  EXPECT_FALSE(result.good());
  EXPECT_THAT(text_, HasSubstr("no event: " + std::to_string(offsets[51] - offsets[50]) +
                               " bytes from byte " + std::to_string(offsets[50])));
  EXPECT_EQ(result.counts.at(Kind::kCutOff), 1);
  EXPECT_THAT(text_, HasSubstr("of them in no event"));
}

TEST_F(LogVerify, MessagesThatAreNoneAreNamed) {
  std::vector<Kept> events = robot_events(100);
  events[7].data += "?";
  const VerifyResult result = check(events);
  EXPECT_EQ(result.counts.at(Kind::kMessage), 1);
  EXPECT_THAT(text_, HasSubstr("event 7 (MOTION_STATE, byte "));
  EXPECT_THAT(text_, HasSubstr("trailing bytes"));
  EXPECT_FALSE(result.good());
}

TEST_F(LogVerify, OurChannelWithAnotherVersionsTypeIsWrongAForeignOneIsNot) {
  EXPECT_TRUE(check({{0, 1, "CAMERA", std::string(50, 'x')}, {1, 2, "CAMERA", "y"}}).good());
  EXPECT_THAT(text_, HasSubstr("note   event 0 (CAMERA"));
  EXPECT_FALSE(check({{0, 1, "JOINT_STATE", std::string(50, 'x')}}).good());
}

TEST_F(LogVerify, AWrongCountOfEventsIsFoundAMissingEndIsANote) {
  std::vector<Kept> events = robot_events(10);
  events.back() = end_event(10, 5);
  EXPECT_FALSE(check(events).good());
  EXPECT_THAT(text_, HasSubstr("says that 5 events come before it"));
  events.pop_back();
  EXPECT_TRUE(check(events).good());
  EXPECT_THAT(text_, HasSubstr("note   there is no LOG_END"));
}

TEST_F(LogVerify, TimesThatGoBackAreANote) {
  std::vector<Kept> events = robot_events(10);
  std::swap(events[3].time_us, events[5].time_us);
  EXPECT_TRUE(check(events).good());
  EXPECT_THAT(text_, HasSubstr("was received"));
}

TEST_F(LogVerify, LogsOfSeveralSessionsThatWereJoinedMissNothing) {
  std::vector<Kept> events;
  for (const int k : {0, 1, 2}) events.push_back(joint_event(k, 1));
  for (const int k : {5000, 5001}) events.push_back(joint_event(k, 2));
  EXPECT_TRUE(check(events).good()) << text_;
}

/// What a sanitizer would stop at.
TEST_F(LogVerify, AnyNumberAndAnyTimeMayStandInAnEvent) {
  constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
  constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
  write_all(path_, {{0, kMost, "A", "x"}, {0, kLeast, "A", "y"}, {0, 0, "A", "z"}});
  std::string bytes = bytes_of(path_);
  put_big_endian(static_cast<std::uint64_t>(kMost), reinterpret_cast<std::uint8_t*>(&bytes[4]));
  put_bytes(path_, bytes);
  EXPECT_EQ(check().counts.at(Kind::kOrder), 1);
  EXPECT_THAT(text_, HasSubstr("was received 18446744073709551615 us before"));
  EXPECT_EQ(check().counts.at(Kind::kNumbers), 2);
}

TEST_F(LogVerify, ManyOfAKindAreCounted) {
  std::vector<Kept> events;
  for (int k = 0; k < 200; k += 2) events.push_back(joint_event(k));
  const VerifyResult result = check(events);
  EXPECT_EQ(result.findings.size(), 20u);
  EXPECT_THAT(text_, HasSubstr("99 gaps in all"));
}

TEST_F(LogVerify, AFileThatIsNoLogIsNotGood) {
  put_bytes(path_, "time,torque\n1,2\n");
  EXPECT_FALSE(check().good());
}

}  // namespace
}  // namespace sprung::log
