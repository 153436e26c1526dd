#include "drivers/bridge/second_device_watch.h"

#include "signals/stamp.h"

namespace sprung {
namespace {

constexpr int kConflictsOfTwo = 3;            // [design choice] of ten cycles
constexpr int kContradictionsOfTwo = 2;       // [design choice] one may have been on its way
constexpr double kContradictionsFade = 20.0;  // [design choice] heartbeats

}  // namespace

void SecondDeviceWatch::begin_cycle() noexcept {
  conflicts_ <<= 1;
  conflicts_[0] = conflict_;
  if (conflicts_.count() >= kConflictsOfTwo) found_ = true;
  conflict_ = false;
}

/// "Stopped" is one flipped bit away from "operational", the others are two and more: it needs a second
/// witness. Another device that is stopped and answers nothing disturbs nobody.
void SecondDeviceWatch::said(canopen::NmtState state, int owed) noexcept {
  const bool doubtful = state == canopen::NmtState::kStopped && !conflict_ && conflicts_.none();
  if (state == canopen::NmtState::kOperational || left_ || doubtful) return;
  left_ = true;
  answers_since_left_ = -1 - owed;
}

/// A node that has booted or left operation answers no SYNC: one that does is two.
void SecondDeviceWatch::judge(bool answered, std::int64_t sync_us, bool rebooted) noexcept {
  if (!left_ || !answered || ++answers_since_left_ < 1) return;
  left_ = false;
  const double since_last_s = seconds(sync_us - contradiction_us_);
  if (since_last_s > kContradictionsFade * heartbeat_s_) contradictions_ = 0;
  contradiction_us_ = sync_us;
  contradictions_ += rebooted ? kContradictionsOfTwo : 1;
  if (contradictions_ >= kContradictionsOfTwo) found_ = true;
}

void SecondDeviceWatch::restart() noexcept {
  conflicts_.reset();
  conflict_ = left_ = found_ = false;
  contradictions_ = 0;
}

}  // namespace sprung
