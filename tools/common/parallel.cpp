#include "tools/common/parallel.h"

#include <algorithm>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

namespace sprung {

namespace {

/// Hands out indices in order and remembers how it went. As cases begin in order and all that began are
/// finished, the first failure by index does not depend on the threads.
class CaseQueue {
 public:
  CaseQueue(std::size_t count, const std::function<void(std::size_t)>& run, const ParallelOptions& options)
      : count_(count), run_(run), options_(options) {}

  void work() {
    for (std::optional<std::size_t> index; (index = take());) {
      try {
        run_(*index);
        finished();
      } catch (const std::exception& error) {
        failed(*index, error.what());
      } catch (...) {
        failed(*index, "something that is no std::exception");
      }
    }
  }

  void throw_failure() const {
    if (failure_) throw *failure_;
  }

 private:
  std::optional<std::size_t> take() {
    const std::lock_guard lock(mutex_);
    if (failure_ || next_ == count_) return std::nullopt;
    return next_++;
  }

  void finished() {
    const std::lock_guard lock(mutex_);
    ++done_;
    if (options_.on_progress) options_.on_progress(done_, count_);
  }

  void failed(std::size_t index, const std::string& why) {
    const std::lock_guard lock(mutex_);
    if (!failure_ || index < failure_->index()) failure_.emplace(index, count_, why);
  }

  const std::size_t count_;
  const std::function<void(std::size_t)>& run_;
  const ParallelOptions& options_;
  std::mutex mutex_;
  std::size_t next_ = 0;
  std::size_t done_ = 0;
  std::optional<CaseError> failure_;
};

}  // namespace

CaseError::CaseError(std::size_t index, std::size_t count, const std::string& why)
    : std::runtime_error("case " + std::to_string(index + 1) + " of " + std::to_string(count) + ": " + why),
      index_(index) {}

int job_count(int asked) {
  if (asked < 0)
    throw std::invalid_argument("--jobs " + std::to_string(asked) + ": expected 0 (every core) or more");
  return asked > 0 ? asked : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

void run_parallel(std::size_t count, const std::function<void(std::size_t)>& run,
                  const ParallelOptions& options) {
  CaseQueue queue(count, run, options);
  const std::size_t threads = std::min(count, static_cast<std::size_t>(job_count(options.jobs)));
  std::vector<std::thread> others;
  for (std::size_t i = 1; i < threads; ++i) others.emplace_back([&queue] { queue.work(); });
  queue.work();
  for (std::thread& other : others) other.join();
  queue.throw_failure();
}

}  // namespace sprung
