#include "tools/operate/launcher/child_process.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <thread>

namespace sprung {
namespace {

int wait_for(ChildProcess& child) {
  while (!child.ended()) {
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  return *child.ended();
}

TEST(ChildProcess, ExitStatusIsReported) {
  ChildProcess child("/bin/sh", {"-c", "exit 7"});
  EXPECT_EQ(wait_for(child), 7);
}

TEST(ChildProcess, DeathBySignalIsReported) {
  ChildProcess child("/bin/sleep", {"1000"});
  child.signal(SIGKILL);
  EXPECT_EQ(wait_for(child), 128 + SIGKILL);
}

TEST(ChildProcess, MissingProgramIsNamed) {
  EXPECT_THAT(
      [] { ChildProcess("/nowhere/sprung-x", {}); },
      testing::ThrowsMessage<std::runtime_error>(testing::HasSubstr("cannot start /nowhere/sprung-x")));
}

TEST(SystemProgram, IsFoundInThePathOrThePackageIsNamed) {
  EXPECT_THAT(system_program("sh", "dash"), testing::EndsWith("/sh"));
  EXPECT_THAT([] { system_program("no-such-program", "its-package"); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::HasSubstr("run ./setup, or apt-get install its-package")));
  EXPECT_THAT([] { system_program("no-such-program", "its-package", OfSetup::kNo); },
              testing::ThrowsMessage<std::runtime_error>(
                  testing::EndsWith("is not installed: apt-get install its-package")));
}

TEST(ChildProcess, WaitEndsWithItOrWithThePatience) {
  ChildProcess short_one("/bin/true", {});
  EXPECT_TRUE(short_one.wait(10.0));
  ChildProcess long_one("/bin/sleep", {"1000"});
  EXPECT_FALSE(long_one.wait(0.02));
  long_one.stop(1.0);
}

TEST(ChildProcess, StopIsPolite) {
  ChildProcess child("/bin/sleep", {"1000"});
  EXPECT_EQ(child.stop(5.0), 128 + SIGTERM);
}

TEST(ChildProcess, StopEndsWhatWillNotListen) {
  ChildProcess child("/bin/sh", {"-c", "trap '' TERM; echo deaf; while :; do sleep 0.01; done"},
                     Output::kCaptured);
  while (child.output().empty() && !child.ended()) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(child.stop(0.05), 128 + SIGKILL);
}

TEST(ChildProcess, HasItsOwnProcessGroup) {
  ChildProcess child("/bin/sleep", {"1000"});
  EXPECT_NE(getpgid(child.pid()), getpgid(0));
  child.stop(1.0);
}

TEST(ChildProcess, CapturedOutputComesInOrderAndIsThereAfterTheEnd) {
  ChildProcess child("/bin/sh", {"-c", "echo one; echo two >&2; printf three"}, Output::kCaptured);
  EXPECT_EQ(wait_for(child), 0);
  EXPECT_EQ(child.output(), "one\ntwo\nthree");
  EXPECT_EQ(child.output(), "");
}

TEST(ChildProcess, ChildNeverWaitsForALauncherThatDoesNotRead) {
  ChildProcess child("/bin/sh", {"-c", "head -c 8000000 /dev/zero 2>/dev/null; exit 5"}, Output::kCaptured);
  EXPECT_EQ(wait_for(child), 5);
  const std::size_t kept = child.output().size();
  EXPECT_GT(kept, 1000u);
  EXPECT_LT(kept, 8'000'000u);
}

TEST(ChildProcess, WithoutCaptureThereIsNoOutput) {
  ChildProcess child("/bin/true", {});
  wait_for(child);
  EXPECT_EQ(child.output(), "");
}

}  // namespace
}  // namespace sprung
