#include "tools/logs/replay/cycle_feed.h"

#include <utility>

namespace sprung {

namespace {

constexpr std::int64_t kProgressEvents = 20'000;
/// Some 0.3 ms of work: longer than waking a thread takes.
constexpr std::size_t kCyclesOfBatch = 32;
/// Enough for one thread to go on while the other is held up a little; more would only leave the processor's
/// caches.
constexpr std::size_t kBatches = 8;

CycleBatch empty_batch(const RobotConfig& robot) {
  CycleBatch batch;
  batch.cycles.assign(kCyclesOfBatch, ReplayCycle{{}, EstimatedCycle(robot)});
  return batch;
}

}  // namespace

CycleFeed::CycleFeed(const std::string& log, double to_s, const RobotConfig& robot,
                     EstimatorReplay& estimator)
    : reader_(log),
      cycles_([this](LoggedCycle& cycle) { take(cycle); }),
      to_s_(to_s),
      estimator_(estimator),
      ring_(kBatches, empty_batch(robot)),
      thread_([this] { run(); }) {}

CycleFeed::~CycleFeed() {
  ring_.stop();
  thread_.join();
}

CycleBatch* CycleFeed::next() {
  if (std::exchange(given_, false)) ring_.give_back();
  CycleBatch* const batch = ring_.front();
  given_ = batch != nullptr;
  return batch;
}

void CycleFeed::run() noexcept {
  std::exception_ptr error;
  filling_ = ring_.place();
  try {
    read_all();
  } catch (...) {
    error = std::current_exception();
  }
  // What came before an error goes to the caller before it.
  if (filling_ != nullptr) ring_.hand_over();
  ring_.close(error);
}

void CycleFeed::read_all() {
  std::int64_t events = 0;
  for (log::Event event; filling_ != nullptr && reader_.next(event);) {
    if (++events % kProgressEvents == 0) hand_over(reader_.position());
    const bool first = timeline_.begin_us() == 0;
    if (!first && !LogCycles::uses(event.channel)) continue;
    cycles_.add(event, timeline_.next(event).time_s);
  }
  cycles_.finish();
}

/// The estimator comes first: a cycle that it throws at is not the caller's.
void CycleFeed::take(LoggedCycle& cycle) {
  if (filling_ == nullptr || cycle.time_s > to_s_) return;
  ReplayCycle& place = filling_->cycles[filling_->count];
  estimator_.step(cycle, place.estimated);
  std::swap(place.logged, cycle);
  if (++filling_->count == filling_->cycles.size()) hand_over(std::nullopt);
}

void CycleFeed::hand_over(std::optional<std::uint64_t> position) {
  if (filling_ == nullptr) return;
  filling_->position = position;
  ring_.hand_over();
  filling_ = ring_.place();
  if (filling_ == nullptr) return;
  filling_->count = 0;
  filling_->position.reset();
}

}  // namespace sprung
