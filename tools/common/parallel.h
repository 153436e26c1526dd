#pragma once
/// Independent cases on all cores: each a function of its index alone, as in-process simulations are. Results
/// stand in the order of the indices and are the same bits whatever the number of threads.
#include <cstddef>
#include <functional>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

namespace sprung {

struct ParallelOptions {
  int jobs = 0;  ///< threads; 0: one for each core. The option `--jobs` of experiments.
  /// Called after each case, never by two threads at once, with `done` counting up. Does not throw.
  std::function<void(std::size_t done, std::size_t count)> on_progress = {};
};

/// A case failed: the first by index. what() reads "case 7 of 50: <what it threw>".
class CaseError : public std::runtime_error {
 public:
  CaseError(std::size_t index, std::size_t count, const std::string& why);
  std::size_t index() const { return index_; }

 private:
  std::size_t index_;
};

/// How many threads `--jobs` means, at least one. @throws std::invalid_argument when negative.
int job_count(int asked);

/// Calls run(0) ... run(count - 1), in this order but several at a time, and waits for all. After a failure
/// no further case begins.
/// @param run must not touch what another case writes. @throws CaseError, std::invalid_argument for the
/// options.
void run_parallel(std::size_t count, const std::function<void(std::size_t index)>& run,
                  const ParallelOptions& options = {});

/// The same with results: run(i) at place i.
template <typename Run>
auto parallel_map(std::size_t count, Run&& run, const ParallelOptions& options = {}) {
  using Result = std::decay_t<decltype(run(std::size_t{}))>;
  static_assert(!std::is_same_v<Result, bool>, "threads cannot write bits of one std::vector<bool>");
  std::vector<Result> results(count);
  run_parallel(
      count, [&](std::size_t i) { results[i] = run(i); }, options);
  return results;
}

}  // namespace sprung
