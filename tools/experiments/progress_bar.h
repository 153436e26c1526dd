#pragma once
/// A line on standard error that shows how far a long experiment is. Nothing is written where standard error is no terminal.
#include <chrono>
#include <cstddef>
#include <string>

namespace sprung {

/// "tune  [######..............]  12 of 40, 31 s left"; pure. @param elapsed_s since the beginning, wall time.
std::string progress_text(const std::string& label, std::size_t done, std::size_t count, double elapsed_s);

/// Give it to ParallelOptions::on_progress by reference: [&bar](auto done, auto count) { bar.show(done, count); }.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label);
  ProgressBar(std::string label, bool on_terminal);  ///< where that is known
  ~ProgressBar();                                    ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Wipes the line when all is done, so that results can be printed.
  void show(std::size_t done, std::size_t count);

 private:
  const std::string label_;
  const bool terminal_;
  const std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
};

}  // namespace sprung
