#include "tools/operate/launcher/launch_screen.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace sprung {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

ScreenContent sample() {
  ScreenContent content;
  content.robot = "pegasus";
  content.phase = "up";
  content.facts = "clock realtime";
  content.safety = "operational";
  content.up_s = 3723.0;
  content.hint = "Ctrl-C ends it";
  ProcessRow row;
  row.program = "sprung-can-bridge";
  row.host = "spine";
  row.state = "running";
  row.pid = 4711;
  row.cpu_percent = 12.34;
  row.memory_MB = 45.6;
  row.rate_Hz = 500.0;
  row.overruns = 2.0;
  row.input_age_ms = 0.25;
  content.rows = {row};
  return content;
}

std::deque<LogLine> log_of(std::size_t count) {
  std::deque<LogLine> log;
  for (std::size_t i = 0; i < count; ++i) log.push_back({0, "x", "line " + std::to_string(i)});
  return log;
}

TEST(LaunchScreen, ShowsEveryNumberOfAProcess) {
  const auto lines = launch_screen(sample(), {}, 120, 24);
  EXPECT_THAT(lines[0].text, AllOf(HasSubstr("pegasus is up"), HasSubstr("1:02:03")));
  EXPECT_THAT(lines[5].text,
              AllOf(HasSubstr("sprung-can-bridge"), HasSubstr("running"), HasSubstr("4711"),
                    HasSubstr("12.3"), HasSubstr("45.6"), HasSubstr("500"), HasSubstr("0.25")));
}

TEST(LaunchScreen, TitlesStandOverTheirNumbers) {
  const auto lines = launch_screen(sample(), {}, 120, 24);
  const std::string& titles = lines[4].text;
  const std::string& row = lines[5].text;
  const auto end = [](const std::string& text, const char* part) {
    return text.find(part) + std::string(part).size();
  };
  EXPECT_EQ(end(titles, "pid"), end(row, "4711"));
  EXPECT_EQ(end(titles, "cpu %"), end(row, "12.3"));
  EXPECT_EQ(end(titles, "Hz"), end(row, "500"));
  EXPECT_EQ(end(titles, "age ms"), end(row, "0.25"));
}

TEST(LaunchScreen, WhatWasNotToldIsADash) {
  ScreenContent content = sample();
  content.rows[0].input_age_ms = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(launch_screen(content, {}, 120, 24)[5].text, AllOf(Not(HasSubstr("nan")), HasSubstr(" - ")));
}

TEST(LaunchScreen, FillsTheTerminalExactlyAndNoMore) {
  for (const std::size_t height : {1u, 5u, 8u, 24u, 60u}) {
    const auto lines = launch_screen(sample(), log_of(100), 40, height);
    EXPECT_EQ(lines.size(), height);
    for (const ScreenLine& line : lines) EXPECT_LE(line.text.size(), 40u);
    EXPECT_EQ(lines.back().text, "Ctrl-C ends it");
  }
}

TEST(LaunchScreen, NewestLogLinesStandLast) {
  const auto lines = launch_screen(sample(), log_of(100), 120, 24);
  EXPECT_THAT(lines[lines.size() - 2].text, HasSubstr("line 99"));
}

TEST(LaunchScreen, TheTableFitsIntoEightyColumns) {
  ScreenContent content = sample();
  content.rows[0].program = "sprung-torque-estimator";
  content.rows[0].pid = 4194304;  // the highest that Linux gives
  content.rows[0].rate_Hz = 1000.0;
  content.rows[0].overruns = 12345.0;
  content.rows[0].restarts = 3;
  const auto lines = launch_screen(content, {}, 80, 24);
  EXPECT_EQ(lines[4].text.substr(lines[4].text.size() - 5), "again");
  EXPECT_EQ(lines[5].text.size(), lines[4].text.size());
  EXPECT_EQ(lines[5].text.back(), '3');
}

std::string joined(const std::vector<ScreenLine>& lines) {
  std::string all;
  for (const ScreenLine& line : lines) all += line.text + "\n";
  return all;
}

TEST(LaunchScreen, LongLinesGoOnInTheNext) {
  ScreenContent content = sample();
  content.hint = "In a second terminal: sprung stand, sprung jump, sprung status, sprung down";
  content.rows[0].detail = "commanded; limits acted: torque 12, rate 3";
  const std::deque<LogLine> log{
      {0, "p", "2026-11-21T20:01:25.123456 warning p: one two three four five six seven"}};
  const std::string all = joined(launch_screen(content, log, 40, 24));
  EXPECT_THAT(all, HasSubstr("20:01:25.123 warning p: one two three\n  four five six seven\n"));
  EXPECT_THAT(
      all, HasSubstr("In a second terminal: sprung stand,\n  sprung jump, sprung status, sprung\n  down\n"));
  EXPECT_THAT(all, HasSubstr("\n  commanded; limits acted: torque 12,\n  rate 3\n"));
}

TEST(LaunchScreen, NewestPieceOfALongLineIsSeenWhereRoomIsShort) {
  const std::deque<LogLine> log{
      {0, "p", "2026-11-21T20:01:25.123456 info p: one two three four five six seven"}};
  const auto lines = launch_screen(sample(), log, 40, 9);  // room for one
  EXPECT_EQ(lines[7].text, "  five six seven");
}

TEST(LaunchScreen, TheLogHasALineOfItsOwn) {
  ScreenContent content = sample();
  content.log = "logs/x.lcm";
  EXPECT_EQ(launch_screen(content, {}, 80, 24)[2].text, "log     logs/x.lcm");
}

TEST(LaunchScreen, HostsAreShownWhereThereAreSeveral) {
  ScreenContent content = sample();
  EXPECT_THAT(launch_screen(content, {}, 200, 24)[4].text, Not(HasSubstr("host")));
  content.rows.push_back(content.rows[0]);
  content.rows[1].host = "trunk";
  EXPECT_THAT(launch_screen(content, {}, 200, 24)[4].text, HasSubstr("host"));
  EXPECT_THAT(launch_screen(content, {}, 200, 24)[6].text, HasSubstr("trunk"));
}

TEST(LaunchScreen, TroubleIsMarked) {
  ScreenContent content = sample();
  content.rows[0].bad = true;
  content.safety_bad = true;
  const std::deque<LogLine> log{{0, "p", "2026-11-21T20:00:00.000000 error p: gone"}};
  const auto lines = launch_screen(content, log, 120, 9);
  EXPECT_EQ(lines[2].style, LineStyle::kBad);
  EXPECT_EQ(lines[5].style, LineStyle::kBad);
  EXPECT_EQ(lines[7].style, LineStyle::kBad);
}

TEST(LaunchScreen, ControlCharactersDoNotReachTheTerminal) {
  const std::deque<LogLine> log{{0, "p", "\x1b[2Jgone\tx"}};
  for (const ScreenLine& line : launch_screen(sample(), log, 120, 24)) {
    for (const char byte : line.text) EXPECT_GE(static_cast<unsigned char>(byte), 0x20);
  }
}

}  // namespace
}  // namespace sprung
