#pragma once
/// How long this machine kept a thread that was due from running. Real time cannot be judged on a machine
/// that stalls for longer than the watchdogs of the robot bear: a test that trips there says so, and is
/// skipped aloud or tried again (.ci/second-try). Where it may, the thread has a higher priority than any
/// program of the robot: what it sees is the machine's doing and not theirs.
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <thread>

namespace sprung {

class StallWatch {
 public:
  StallWatch() : thread_([this] { watch(); }) {}
  ~StallWatch() {
    ended_ = true;
    thread_.join();
  }
  StallWatch(const StallWatch&) = delete;
  StallWatch& operator=(const StallWatch&) = delete;

  /// Longest time by which the watch itself woke up too late, so far.
  double longest_ms() const { return longest_ms_; }

 private:
  void watch() {
    constexpr std::chrono::milliseconds kNap{1};
    sched_param highest{};
    highest.sched_priority = sched_get_priority_max(SCHED_FIFO);
    pthread_setschedparam(pthread_self(), SCHED_FIFO, &highest);
    while (!ended_) {
      const auto due = std::chrono::steady_clock::now() + kNap;
      std::this_thread::sleep_until(due);
      const std::chrono::duration<double, std::milli> late = std::chrono::steady_clock::now() - due;
      longest_ms_ = std::max(longest_ms_.load(), late.count());
    }
  }

  std::atomic<double> longest_ms_{0.0};
  std::atomic<bool> ended_{false};
  std::thread thread_;
};

}  // namespace sprung
