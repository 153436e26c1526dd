#include "drivers/bridge/heartbeat_watch.h"

#include <algorithm>

#include "signals/stamp.h"

namespace sprung {
namespace {

using canopen::NmtState;

constexpr double kHeartbeatsOnTheirWay = 2.0;  // sent before NMT start, they lose arbitration to samples

}  // namespace

void HeartbeatWatch::begin_operation(std::int64_t time_us) noexcept {
  state_ = NmtState::kOperational;
  operational_us_ = heard_us_ = time_us;
}

bool HeartbeatWatch::receive(NmtState state, std::int64_t time_us, bool in_operation) noexcept {
  if (state == NmtState::kUnknown) return false;
  heard_us_ = std::max(heard_us_, time_us);
  const bool overtaken = in_operation && state == NmtState::kPreOperational &&
                         seconds(time_us - operational_us_) < kHeartbeatsOnTheirWay * period_s_;
  if (overtaken) return false;
  rebooted_ = rebooted_ || (in_operation && state == NmtState::kBootUp);
  state_ = state;
  return true;
}

void HeartbeatWatch::watch(std::int64_t time_us, bool in_operation) noexcept {
  const bool is_lost = in_operation && missing(time_us);
  if (is_lost && !lost_) ++losses_;
  lost_ = is_lost;
}

bool HeartbeatWatch::missing(std::int64_t time_us) const noexcept {
  return time_us - heard_us_ > longest_pause_us_;
}

void HeartbeatWatch::show(NodeHealth& out) const noexcept {
  out.heartbeat_losses = losses_;
  out.nmt_state = static_cast<std::int8_t>(state_);
}

}  // namespace sprung
