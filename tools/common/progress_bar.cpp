#include "tools/common/progress_bar.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <utility>

namespace sprung {

namespace {

constexpr std::size_t kWidth = 24;
constexpr const char* kWipeLine = "\r\x1b[K";
constexpr std::chrono::milliseconds kOnTerminal{1'000};

std::string seconds_text(const char* pattern, double seconds) {
  char text[64];
  std::snprintf(text, sizeof text, pattern, seconds);
  return text;
}

std::string left_text(std::size_t done, std::size_t count, double elapsed_s) {
  if (done == 0 || done >= count) return "";
  const double left_s = elapsed_s * static_cast<double>(count - done) / static_cast<double>(done);
  return seconds_text(", %.0f s left", left_s);
}

/// A signal that asks the program to end is for its other threads: they wait for it.
template <class Run>
std::thread without_signals(Run&& run) {
  sigset_t all, before;
  sigfillset(&all);
  pthread_sigmask(SIG_SETMASK, &all, &before);
  std::thread thread(std::forward<Run>(run));
  pthread_sigmask(SIG_SETMASK, &before, nullptr);
  return thread;
}

}  // namespace

std::string progress_text(const std::string& label, std::size_t done, std::size_t count, double elapsed_s) {
  const std::size_t full = count == 0 ? kWidth : kWidth * done / count;
  return label + "  [" + std::string(full, '#') + std::string(kWidth - full, '.') + "]  " +
         std::to_string(done) + " of " + std::to_string(count) + left_text(done, count, elapsed_s);
}

std::string plain_progress_text(const std::string& label, std::size_t done, std::size_t count,
                                double elapsed_s) {
  if (count == 0) return label + ": at work for " + seconds_text("%.0f s", elapsed_s);
  return label + ": " + std::to_string(done) + " of " + std::to_string(count) +
         seconds_text(" done after %.0f s", elapsed_s) + left_text(done, count, elapsed_s);
}

ProgressLook standard_error_look() {
  ProgressLook look;
  look.terminal = isatty(STDERR_FILENO) != 0;
  if (look.terminal) look.every = kOnTerminal;
  look.write = [](const std::string& text) { std::fputs(text.c_str(), stderr); };
  return look;
}

ProgressBar::ProgressBar(std::string label, ProgressLook look)
    : label_(std::move(label)), look_(std::move(look)), ticker_(without_signals([this] { tick(); })) {}

ProgressBar::~ProgressBar() {
  {
    const std::lock_guard lock(mutex_);
    end_ = true;
  }
  ended_.notify_one();
  ticker_.join();
  if (drawn_) look_.write(kWipeLine);
}

void ProgressBar::show(std::size_t done, std::size_t count) {
  const std::lock_guard lock(mutex_);
  done_ = done;
  count_ = count;
  silent_ = done >= count;
  if (look_.terminal) draw();
}

void ProgressBar::tick() {
  std::unique_lock lock(mutex_);
  while (!ended_.wait_for(lock, look_.every, [this] { return end_; })) {
    if (!silent_) draw();
  }
}

/// Under the mutex.
void ProgressBar::draw() {
  if (!look_.terminal) return look_.write(plain_progress_text(label_, done_, count_, elapsed_s()) + "\n");
  const std::string line = count_ == 0 ? plain_progress_text(label_, 0, 0, elapsed_s())
                                       : progress_text(label_, done_, count_, elapsed_s());
  look_.write(kWipeLine + (silent_ ? "" : line));
  drawn_ = !silent_;
}

double ProgressBar::elapsed_s() const {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
}

}  // namespace sprung
