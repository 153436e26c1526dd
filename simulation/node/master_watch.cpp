#include "simulation/node/master_watch.h"

#include <algorithm>

#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

/// 0x1016: node in bits 16-22, time in ms below.
int guarded_node(std::int64_t consumer) noexcept { return static_cast<int>((consumer >> 16) & 0x7F); }
std::int64_t guard_time_us(std::int64_t consumer) noexcept { return 1000 * (consumer & 0xFFFF); }

}  // namespace

MasterWatch::MasterWatch(const ObjectDictionary& dictionary) noexcept
    : dictionary_(dictionary),
      producer_(dictionary.find({canopen::kHeartbeatProducer, 0})),
      guard_time_(dictionary.find({canopen::kGuardTime, 0})),
      life_factor_(dictionary.find({canopen::kLifeTimeFactor, 0})) {
  for (std::size_t i = 0; i < kConsumers; ++i)
    consumers_[i] = dictionary.find({canopen::kHeartbeatConsumer, static_cast<std::uint8_t>(i + 1)});
}

void MasterWatch::restart() noexcept {
  guards_ = {};
  life_ = {};
  toggle_ = false;
}

void MasterWatch::rearm(int sub) noexcept {
  if (sub >= 1 && sub <= static_cast<int>(kConsumers)) guards_[static_cast<std::size_t>(sub) - 1] = {};
}

bool MasterWatch::lost() const noexcept {
  return life_.lost ||
         std::any_of(guards_.begin(), guards_.end(), [](const Guard& guard) { return guard.lost; });
}

MasterWatch::Change MasterWatch::refresh(Guard& guard, std::int64_t time_us) noexcept {
  const bool was_lost = guard.lost;
  guard = {time_us, true, false};
  return was_lost && !lost() ? Change::kBack : Change::kNone;
}

MasterWatch::Change MasterWatch::hear(const CanFrame& frame, std::int64_t time_us) noexcept {
  const int sender = static_cast<int>(frame.id & 0x7F);
  Change change = Change::kNone;
  for (std::size_t i = 0; i < kConsumers; ++i) {
    const std::int64_t consumer = number(consumers_[i]);
    if (guard_time_us(consumer) == 0 || guarded_node(consumer) != sender) continue;
    if (refresh(guards_[i], time_us) == Change::kBack) change = Change::kBack;
  }
  return change;
}

MasterWatch::Change MasterWatch::guard(int node, canopen::NmtState state, std::int64_t time_us,
                                       CanFrame& reply, bool& answers) noexcept {
  answers = heartbeat_us() == 0;
  if (!answers) return Change::kNone;
  reply = canopen::guard_reply(node, {state, toggle_});
  toggle_ = !toggle_;
  return refresh(life_, time_us);
}

std::int64_t MasterWatch::life_time_us() const noexcept {
  return heartbeat_us() != 0 ? 0 : 1000 * number(guard_time_) * number(life_factor_);
}

/// @param limit_us 0 = not supervised.
bool MasterWatch::overdue(Guard& guard, std::int64_t limit_us, std::int64_t time_us) noexcept {
  if (limit_us == 0 || !guard.heard || guard.lost || time_us - guard.last_us < limit_us) return false;
  guard.lost = true;
  return true;
}

MasterWatch::Change MasterWatch::check(std::int64_t time_us) noexcept {
  bool any = overdue(life_, life_time_us(), time_us);
  for (std::size_t i = 0; i < kConsumers; ++i) {
    if (consumers_[i] < 0) break;
    any |= overdue(guards_[i], guard_time_us(number(consumers_[i])), time_us);
  }
  return any ? Change::kLost : Change::kNone;
}

}  // namespace sprung::sim
