#include "runtime/stop_request.h"

#include <gtest/gtest.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace sprung {
namespace {

bool readable(int fd, int timeout_ms = 0) {
  pollfd wait{fd, POLLIN, 0};
  return poll(&wait, 1, timeout_ms) == 1;
}

class StopRequestTest : public ::testing::Test {
 protected:
  void SetUp() override {
    std::signal(SIGHUP, SIG_DFL);  // the tests may run under nohup
    install_stop_signals();
    clear_stop_request();
    EXPECT_FALSE(stop_requested());  // and so it is looked at
  }
  void TearDown() override { clear_stop_request(); }
};

TEST_F(StopRequestTest, NothingIsRequestedAtFirst) {
  EXPECT_FALSE(stop_requested());
  EXPECT_FALSE(readable(stop_fd()));
}

TEST_F(StopRequestTest, SignalsAskAndWakeAndASecondOneDoesNotKill) {
  for (const int number : {SIGTERM, SIGINT, SIGTERM, SIGPIPE}) raise(number);
  EXPECT_TRUE(stop_requested());
  EXPECT_TRUE(readable(stop_fd()));
}

/// A terminal that is closed, an ssh connection that ends.
TEST_F(StopRequestTest, HangUpAsksToo) {
  raise(SIGHUP);
  EXPECT_TRUE(stop_requested());
}

TEST_F(StopRequestTest, UnderNohupAHangUpAsksNothing) {
  std::signal(SIGHUP, SIG_IGN);
  install_stop_signals();
  raise(SIGHUP);
  EXPECT_FALSE(stop_requested());
}

TEST_F(StopRequestTest, WhatNeverLooksForItEndsAtOnce) {
  const pid_t child = fork();
  if (child == 0) {
    clear_stop_request();
    raise(SIGTERM);
    _exit(0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFSIGNALED(status));
  EXPECT_EQ(WTERMSIG(status), SIGTERM);
}

TEST_F(StopRequestTest, WhoWaitsForItHasLooked) {
  const pid_t child = fork();
  if (child == 0) {
    clear_stop_request();
    [[maybe_unused]] const int looked = stop_fd();
    raise(SIGTERM);
    _exit(stop_requested() ? 7 : 0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 7);
}

TEST_F(StopRequestTest, HangUpThatNohupIgnoresStaysIgnored) {
  const pid_t child = fork();
  if (child == 0) {
    signal(SIGHUP, SIG_IGN);
    install_stop_signals();
    raise(SIGHUP);
    _exit(stop_requested() ? 1 : 0);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

TEST_F(StopRequestTest, BrokenPipeIsNoStop) {
  raise(SIGPIPE);
  EXPECT_FALSE(stop_requested());
}

TEST_F(StopRequestTest, ChildStopsWhenItsParentIsKilled) {
  int report[2];
  ASSERT_EQ(pipe(report), 0);
  const pid_t launcher = fork();
  if (launcher == 0) {  // a launcher with one process, which reports 's' when it was asked to stop
    if (fork() == 0) {
      close(report[0]);
      stop_with_parent();
      [[maybe_unused]] auto sent = write(report[1], "r", 1);
      readable(stop_fd(), 10'000);  // or interrupted by the signal itself
      if (stop_requested()) sent = write(report[1], "s", 1);
      _exit(0);
    }
    pause();
  }
  close(report[1]);
  char answer = 0;
  ASSERT_EQ(read(report[0], &answer, 1), 1);
  EXPECT_EQ(answer, 'r');
  kill(launcher, SIGKILL);
  ASSERT_EQ(read(report[0], &answer, 1), 1);
  EXPECT_EQ(answer, 's');
  waitpid(launcher, nullptr, 0);
  close(report[0]);
}

TEST_F(StopRequestTest, ParentThatEndedBeforeAsksAtOnce) {
  const pid_t child = fork();
  if (child == 0) {
    stop_with_parent(getppid() + 1);  // not the parent any more
    _exit(stop_requested() ? 0 : 1);
  }
  int status = -1;
  waitpid(child, &status, 0);
  EXPECT_EQ(status, 0);
}

}  // namespace
}  // namespace sprung
