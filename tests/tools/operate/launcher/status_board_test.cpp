#include "tools/operate/launcher/status_board.h"

#include <gtest/gtest.h>

#include <cmath>

namespace sprung {
namespace {

sprung_msgs::process_status_t estimator() {
  sprung_msgs::process_status_t status{};
  status.process = "sprung-torque-estimator";
  status.host = "trunk";
  status.pid = 42;
  status.state = static_cast<std::int8_t>(ProcessState::kRunning);
  status.cpu_share = 0.125;
  status.memory_kB = 2048;
  status.loop_period_us = 2000.0;
  status.overruns = 3;
  status.input_age_us = 250.0;
  return status;
}

const KnownProcess kEstimator{"sprung-torque-estimator", "", 42, std::nullopt, 1, true};

TEST(StatusBoard, RowSaysWhatTheProcessSaid) {
  StatusBoard board;
  board.hear(estimator(), 1'000);
  const ProcessRow row = board.row(kEstimator, 2'000);
  EXPECT_EQ(row.state, "running");
  EXPECT_EQ(row.host, "trunk");
  EXPECT_EQ(row.pid, 42);
  EXPECT_DOUBLE_EQ(row.cpu_percent, 12.5);
  EXPECT_DOUBLE_EQ(row.memory_MB, 2.0);
  EXPECT_DOUBLE_EQ(row.rate_Hz, 500.0);
  EXPECT_DOUBLE_EQ(row.overruns, 3.0);
  EXPECT_DOUBLE_EQ(row.input_age_ms, 0.25);
  EXPECT_EQ(row.restarts, 1);
  EXPECT_FALSE(row.bad);
}

TEST(StatusBoard, NothingHeardIsStartingHereAndWaitedForElsewhere) {
  const StatusBoard board;
  EXPECT_EQ(board.row(kEstimator, 0).state, "starting");
  EXPECT_TRUE(std::isnan(board.row(kEstimator, 0).rate_Hz));
  KnownProcess remote = kEstimator;
  remote.host = "trunk";
  EXPECT_EQ(board.row(remote, 0).state, "waited for");
  EXPECT_EQ(board.state_of("sprung-torque-estimator"), ProcessState::kStarting);
}

TEST(StatusBoard, WhatSaysNothingByNatureRuns) {
  EXPECT_EQ(StatusBoard().row({"lcm-logger", "", 7, std::nullopt, 0, false}, 0).state, "running");
}

TEST(StatusBoard, SilenceIsNoticed) {
  StatusBoard board;
  EXPECT_FALSE(board.silent(kEstimator.program, 1'000'000'000)) << "never heard is starting, not silent";
  board.hear(estimator(), 0);
  EXPECT_FALSE(board.silent(kEstimator.program, StatusBoard::kSilent_us));
  EXPECT_TRUE(board.silent(kEstimator.program, StatusBoard::kSilent_us + 1));
  EXPECT_EQ(board.row(kEstimator, StatusBoard::kSilent_us + 1).state, "silent");
  EXPECT_TRUE(board.row(kEstimator, StatusBoard::kSilent_us + 1).bad);
}

/// The launcher was stopped, or the machine stood still: it cannot say that the others were silent.
TEST(StatusBoard, WhatNobodyListenedToIsNotSilence) {
  StatusBoard board;
  board.hear(estimator(), 0);
  board.begin_to_listen(10'000'000);
  EXPECT_FALSE(board.silent(kEstimator.program, 10'000'001));
  EXPECT_TRUE(board.silent(kEstimator.program, 10'000'001 + StatusBoard::kSilent_us));
  board.hear(estimator(), 20'000'000);
  board.begin_to_listen(10'000'000);
  EXPECT_FALSE(board.silent(kEstimator.program, 20'000'001)) << "time does not go back";
}

TEST(StatusBoard, TwoThatSpeakInTurnAreTwoProcesses) {
  StatusBoard board;
  sprung_msgs::process_status_t other = estimator();
  other.host = "tail";
  EXPECT_FALSE(board.hear(estimator(), 0));
  EXPECT_FALSE(board.hear(estimator(), 1));
  EXPECT_FALSE(board.hear(other, 2)) << "it may have been started again there";
  EXPECT_FALSE(board.hear(other, 3));
  EXPECT_TRUE(board.hear(estimator(), 4));
}

TEST(StatusBoard, RestartedAgainAndAgainIsNotTwo) {
  StatusBoard board;
  for (int pid = 1; pid < 6; ++pid) {
    sprung_msgs::process_status_t next = estimator();
    next.pid = pid;
    EXPECT_FALSE(board.hear(next, pid));
  }
}

TEST(StatusBoard, EndIsShownWithItsStatus) {
  StatusBoard board;
  board.hear(estimator(), 0);
  KnownProcess ended = kEstimator;
  ended.exit_status = 1;
  EXPECT_EQ(board.row(ended, 1).state, "ended 1");
  ended.exit_status = 128 + 9;
  EXPECT_EQ(board.row(ended, 1).state, "killed 9");
  EXPECT_TRUE(board.row(ended, 1).bad);
}

TEST(StatusBoard, RestartedProcessIsNotTakenForItsForerunner) {
  StatusBoard board;
  board.hear(estimator(), 0);
  EXPECT_EQ(board.state_of(kEstimator.program), ProcessState::kRunning);
  board.forget(kEstimator.program);
  EXPECT_EQ(board.state_of(kEstimator.program), ProcessState::kStarting);
}

TEST(ExitText, NamesSignals) {
  EXPECT_EQ(exit_text(3), "exit status 3");
  EXPECT_EQ(exit_text(128 + 9), "Killed");
}

}  // namespace
}  // namespace sprung
