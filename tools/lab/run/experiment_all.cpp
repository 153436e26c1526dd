#include "tools/lab/run/experiment_all.h"

#include <chrono>
#include <exception>

#include "tools/common/parallel.h"

namespace sprung {

namespace {

FinishedExperiment run_one(const ExperimentEntry& entry, const ExperimentInput& input) {
  FinishedExperiment finished{entry, {}, ""};
  const auto started = std::chrono::steady_clock::now();
  try {
    finished.output = entry.run(input);
  } catch (const std::exception& error) {
    finished.failure = error.what();
  }
  finished.output.rows.wall_s =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - started).count();
  return finished;
}

}  // namespace

std::vector<FinishedExperiment> run_experiments(
    const std::vector<ExperimentEntry>& entries, const ExperimentInput& input,
    const std::function<void(std::size_t, std::size_t)>& on_progress) {
  std::vector<FinishedExperiment> finished(entries.size());
  std::vector<std::size_t> small;
  std::size_t done = 0;
  const auto tell = [&] {
    if (on_progress) on_progress(done, entries.size());
  };
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (!entries[i].many_cases) {
      small.push_back(i);
      continue;
    }
    finished[i] = run_one(entries[i], input);
    ++done;
    tell();
  }
  ExperimentInput alone = input;
  alone.jobs = 1;
  ParallelOptions options;
  options.jobs = input.jobs;
  options.on_progress = [&](std::size_t, std::size_t) {
    ++done;
    tell();
  };
  run_parallel(
      small.size(), [&](std::size_t i) { finished[small[i]] = run_one(entries[small[i]], alone); }, options);
  return finished;
}

}  // namespace sprung
