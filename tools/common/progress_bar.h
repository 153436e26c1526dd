#pragma once
/// A line on standard error that shows how far something long is, and that it is still at work: on a terminal
/// one line that changes every second, elsewhere (a log, a script) a plain line every ten seconds. What is
/// done sooner than that says nothing.
#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <functional>
#include <mutex>
#include <string>
#include <thread>

namespace sprung {

/// "tune  [######..............]  12 of 40, 31 s left"; pure. @param elapsed_s since the beginning, wall
/// time.
std::string progress_text(const std::string& label, std::size_t done, std::size_t count, double elapsed_s);

/// "tune: 12 of 40 done after 20 s, 31 s left"; "jump: at work for 20 s" where nobody counts (count 0). Pure.
std::string plain_progress_text(const std::string& label, std::size_t done, std::size_t count,
                                double elapsed_s);

struct ProgressLook {
  bool terminal = false;
  std::chrono::milliseconds every{10'000};        ///< between two lines that nobody asked for
  std::function<void(const std::string&)> write;  ///< takes bytes; called by one thread at a time
};
/// Of this process's standard error.
ProgressLook standard_error_look();

/// Give it to ParallelOptions::on_progress by reference:
///   [&bar](auto done, auto count) { bar.show(done, count); }
/// Nothing else may be written on the terminal while something is being counted.
class ProgressBar {
 public:
  explicit ProgressBar(std::string label) : ProgressBar(std::move(label), standard_error_look()) {}
  ProgressBar(std::string label, ProgressLook look);
  ~ProgressBar();  ///< wipes the line
  ProgressBar(const ProgressBar&) = delete;
  ProgressBar& operator=(const ProgressBar&) = delete;

  /// Of any thread. Wipes the line when all is done, and is silent until more is shown, so that results can
  /// be printed.
  void show(std::size_t done, std::size_t count);

 private:
  void tick();
  void draw();
  double elapsed_s() const;

  const std::string label_;
  const ProgressLook look_;
  const std::chrono::steady_clock::time_point started_ = std::chrono::steady_clock::now();
  std::mutex mutex_;
  std::condition_variable ended_;
  bool end_ = false;
  bool silent_ = false;  ///< all is done
  bool drawn_ = false;   ///< there is a line to wipe
  std::size_t done_ = 0, count_ = 0;
  std::thread ticker_;  ///< last: uses all the others
};

/// What `work` returns, with a line for as long as it takes.
template <class Work>
auto with_progress(const std::string& label, Work&& work) {
  ProgressBar bar(label);
  return work(bar);
}

}  // namespace sprung
