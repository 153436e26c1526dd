#include "tools/lab/study/worker_pool_shell.h"

#include <poll.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <deque>
#include <memory>
#include <stdexcept>

#include "tools/lab/study/piped_child_shell.h"
#include "tools/lab/study/study_json.h"
#include "tools/lab/study/study_worker.h"

namespace sprung {
namespace {

using Clock = std::chrono::steady_clock;

constexpr int kTries = 10;       // a run that ends its worker so often would end every worker
constexpr int kLookAt_ms = 200;  // for Ctrl-C

struct WorkerSlot {
  std::unique_ptr<PipedChild> worker;
  std::size_t run = 0;
  bool is_busy = false;
  Clock::time_point until{};
};

class Pool {
 public:
  Pool(const std::vector<StudyRun>& missing, const StudyFolder& folder, const PoolOptions& options)
      : missing_(missing), folder_(folder), options_(options), tries_(missing.size(), 0) {
    for (std::size_t i = 0; i < missing.size(); ++i) waiting_.push_back(i);
    slots_.resize(
        std::min<std::size_t>(std::max(1, options.workers), std::max<std::size_t>(1, missing.size())));
  }

  PoolResult run() {
    while (!options_.stops()) {
      for (WorkerSlot& slot : slots_) hand_out(slot);
      if (std::none_of(slots_.begin(), slots_.end(), [](const WorkerSlot& slot) { return slot.is_busy; }))
        return result_;
      wait();
      for (WorkerSlot& slot : slots_) end_if_late(slot);
    }
    result_.stopped = true;
    return result_;
  }

 private:
  void hand_out(WorkerSlot& slot) {
    if (slot.is_busy || waiting_.empty()) return;
    if (!slot.worker) slot.worker = std::make_unique<PipedChild>(options_.worker);
    slot.run = waiting_.front();
    waiting_.pop_front();
    slot.is_busy = true;
    ++tries_[slot.run];
    slot.until = Clock::now() + std::chrono::milliseconds(std::llround(options_.timeout_s * 1e3));
    slot.worker->say(run_json(missing_[slot.run]));  // one that has ended is noticed when it is read
  }

  void wait() {
    std::vector<pollfd> files;
    std::vector<WorkerSlot*> of;
    for (WorkerSlot& slot : slots_) {
      if (!slot.is_busy) continue;
      files.push_back({slot.worker->output(), POLLIN, 0});
      of.push_back(&slot);
    }
    if (poll(files.data(), files.size(), patience_ms()) <= 0) return;
    for (std::size_t i = 0; i < files.size(); ++i) {
      if (files[i].revents != 0) take(*of[i]);
    }
  }

  /// Until the first run is late, but not too long to hear Ctrl-C.
  int patience_ms() const {
    auto until = Clock::now() + std::chrono::milliseconds(kLookAt_ms);
    for (const WorkerSlot& slot : slots_) {
      if (slot.is_busy) until = std::min(until, slot.until);
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(until - Clock::now()).count();
    return std::max(0, static_cast<int>(left) + 1);
  }

  void take(WorkerSlot& slot) {
    const bool lives = slot.worker->read_more();
    if (const std::optional<std::string> line = slot.worker->line()) return take_answer(slot, *line);
    if (!lives) lose(slot);
  }

  void take_answer(WorkerSlot& slot, const std::string& line) {
    const std::int64_t number = missing_[slot.run].number;
    WorkerAnswer answer;
    try {
      answer = answer_of(line);
    } catch (const std::invalid_argument&) {
      return lose(slot);  // a worker that says anything else is no worker
    }
    slot.is_busy = false;
    if (answer.row.empty()) return fail(number, answer.error);
    folder_.keep(answer.row);
    folder_.note_time(number, answer.wall_s);
    ++result_.kept;
    tell();
  }

  void lose(WorkerSlot& slot) {
    const std::string how = slot.worker->end();
    slot.worker.reset();
    slot.is_busy = false;
    ++result_.workers_lost;
    if (tries_[slot.run] < kTries) return waiting_.push_front(slot.run);
    fail(missing_[slot.run].number,
         "its worker ended " + std::to_string(kTries) + " times, the last one: " + how);
  }

  void end_if_late(WorkerSlot& slot) {
    if (!slot.is_busy || Clock::now() < slot.until) return;
    slot.worker.reset();
    slot.is_busy = false;
    char why[96];
    std::snprintf(why, sizeof why, "took longer than %g s and was stopped (timeout of the study)",
                  options_.timeout_s);
    fail(missing_[slot.run].number, why);
  }

  void fail(std::int64_t number, const std::string& why) {
    folder_.note_failure(number, why);
    ++result_.failed;
    tell();
  }

  void tell() {
    if (options_.on_progress)
      options_.on_progress(static_cast<std::size_t>(result_.kept + result_.failed), missing_.size());
  }

  const std::vector<StudyRun>& missing_;
  const StudyFolder& folder_;
  const PoolOptions& options_;
  std::vector<int> tries_;
  std::deque<std::size_t> waiting_;
  std::vector<WorkerSlot> slots_;
  PoolResult result_;
};

}  // namespace

PoolResult run_pool(const std::vector<StudyRun>& missing, const StudyFolder& folder,
                    const PoolOptions& options) {
  return Pool(missing, folder, options).run();
}

}  // namespace sprung
