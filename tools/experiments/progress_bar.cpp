#include "tools/experiments/progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace sprung {

namespace {

constexpr std::size_t kWidth = 24;
constexpr const char* kWipeLine = "\r\x1b[K";

}  // namespace

std::string progress_text(const std::string& label, std::size_t done, std::size_t count, double elapsed_s) {
  const std::size_t full = count == 0 ? kWidth : kWidth * done / count;
  std::string text = label + "  [" + std::string(full, '#') + std::string(kWidth - full, '.') + "]  " +
                     std::to_string(done) + " of " + std::to_string(count);
  if (done == 0 || done >= count) return text;
  const double left_s = elapsed_s * static_cast<double>(count - done) / static_cast<double>(done);
  char left[32];
  std::snprintf(left, sizeof left, ", %.0f s left", left_s);
  return text + left;
}

ProgressBar::ProgressBar(std::string label) : ProgressBar(std::move(label), isatty(STDERR_FILENO) != 0) {}

ProgressBar::ProgressBar(std::string label, bool on_terminal)
    : label_(std::move(label)), terminal_(on_terminal) {}

ProgressBar::~ProgressBar() {
  if (terminal_) std::fputs(kWipeLine, stderr);
}

void ProgressBar::show(std::size_t done, std::size_t count) {
  if (!terminal_) return;
  if (done >= count) {
    std::fputs(kWipeLine, stderr);  // what is printed next begins the line
    return;
  }
  const double elapsed_s = std::chrono::duration<double>(std::chrono::steady_clock::now() - started_).count();
  std::fprintf(stderr, "%s%s", kWipeLine, progress_text(label_, done, count, elapsed_s).c_str());
}

}  // namespace sprung
