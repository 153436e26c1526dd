#include "runtime/process_status.h"

#include <gtest/gtest.h>

#include "tests/signals/message_bytes.h"

namespace sprung {
namespace {

TEST(ProcessStatus, SurvivesBitForBit) {
  sprung_msgs::process_status_t message{};
  message.pid = 10;
  message.utime = 11;
  message.seq = 12;
  message.utc_offset_us = 13;
  message.configuration_hash = -14;
  message.state = 2;
  message.cycles = 15;
  message.overruns = 16;
  message.refused_messages = 17;
  message.sequence_gaps = 18;
  message.loop_period_us = 19.5;
  message.loop_period_max_us = 20.5;
  message.compute_us = 21.5;
  message.compute_max_us = 22.5;
  message.input_age_us = kNaN;
  message.types_hash = -23;
  message.cpu_share = 0.25;
  message.memory_kB = 26;
  message.process = "a";
  message.host = "h";
  message.version = "b";
  message.git_hash = "c";
  message.robot = "d";
  message.clock = "e";
  message.real_time = "f";
  message.detail = "g";
  ProcessStatus status;
  ASSERT_TRUE(from_message(message, status));
  sprung_msgs::process_status_t back{};
  to_message(status, 0, back);
  EXPECT_EQ(test::encoded(back), test::encoded(message));
}

TEST(ProcessStatus, UnknownStateIsRefused) {
  sprung_msgs::process_status_t message{};
  message.state = 4;
  ProcessStatus status;
  EXPECT_FALSE(from_message(message, status));
}

TEST(StandingNote, IsSaidOnceWithEveryDetail) {
  EXPECT_EQ(with_note("refused: wrong hash", "not deterministic"), "refused: wrong hash; not deterministic");
  EXPECT_EQ(with_note("refused: wrong hash; not deterministic", "not deterministic"),
            "refused: wrong hash; not deterministic");
  EXPECT_EQ(with_note("", "not deterministic"), "not deterministic");
  EXPECT_EQ(with_note("refused: wrong hash", ""), "refused: wrong hash");
}

TEST(StatusSchedule, IsDueAtFirstOnChangeAndTwiceASecond) {
  StatusSchedule schedule;
  EXPECT_TRUE(schedule.due(ProcessState::kStarting, 1'000));
  EXPECT_FALSE(schedule.due(ProcessState::kStarting, 2'000));
  EXPECT_TRUE(schedule.due(ProcessState::kReady, 3'000));
  EXPECT_FALSE(schedule.due(ProcessState::kReady, 3'000 + StatusSchedule::kInterval_us - 1));
  EXPECT_TRUE(schedule.due(ProcessState::kReady, 3'000 + StatusSchedule::kInterval_us));
}

}  // namespace
}  // namespace sprung
