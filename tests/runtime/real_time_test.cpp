#include "runtime/real_time.h"

#include <gtest/gtest.h>
#include <sched.h>
#include <sys/wait.h>
#include <unistd.h>

#include <functional>
#include <stdexcept>

namespace sprung {
namespace {

/// Runs in a child, since scheduling cannot be taken back without rights. @return its exit status.
int in_child(const std::function<bool()>& body) {
  const pid_t child = fork();
  if (child == 0) _exit(body() ? 0 : 1);
  int status = -1;
  waitpid(child, &status, 0);
  return status;
}

TEST(RealTime, OffAsksForNothing) {
  EXPECT_EQ(set_up_real_time({RealTimePolicy::kOff, 50, 0}), "off");
  EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
}

TEST(RealTime, PriorityZeroIsNormalScheduling) {
  EXPECT_EQ(set_up_real_time({RealTimePolicy::kEnforce, 0, -1}), "normal scheduling");
  EXPECT_EQ(sched_getscheduler(0), SCHED_OTHER);
}

TEST(RealTime, TextSaysWhatTheKernelReallyGranted) {
  EXPECT_EQ(in_child([] {
              const std::string text = set_up_real_time({RealTimePolicy::kWarn, 5, -1});
              const bool fifo = sched_getscheduler(0) == SCHED_FIFO;
              const bool said_refused = text.find("SCHED_FIFO 5 refused") != std::string::npos;
              return text.find("SCHED_FIFO 5") == 0 && fifo != said_refused;
            }),
            0);
}

TEST(RealTime, PinsToOneCpu) {
  EXPECT_EQ(in_child([] {
              cpu_set_t set;
              sched_getaffinity(0, sizeof set, &set);
              int cpu = 0;
              while (!CPU_ISSET(static_cast<std::size_t>(cpu), &set)) ++cpu;
              const std::string text = set_up_real_time({RealTimePolicy::kEnforce, 0, cpu});
              sched_getaffinity(0, sizeof set, &set);
              return CPU_COUNT(&set) == 1 && text == "normal scheduling, cpu " + std::to_string(cpu);
            }),
            0);
}

TEST(RealTime, CpuThatIsNotThereIsNamedOrThrownByPolicy) {
  for (const int cpu : {1000, 1'000'000}) {
    const std::string text = set_up_real_time({RealTimePolicy::kWarn, 0, cpu});
    EXPECT_TRUE(real_time_refused(text)) << text;
    EXPECT_THROW(set_up_real_time({RealTimePolicy::kEnforce, 0, cpu}), std::runtime_error);
  }
  EXPECT_FALSE(real_time_refused("SCHED_FIFO 5, memory locked"));
}

}  // namespace
}  // namespace sprung
