#include "drivers/bridge/bus_monitor.h"

#include <algorithm>

#include "drivers/can/can_errors.h"
#include "drivers/canopen/bus_load.h"

namespace sprung {
namespace {

constexpr std::int64_t kLoadWindow_us = 1'000'000;

// Details of a controller error, data[1] (linux/can/error.h, facts canopen 5).
constexpr std::uint8_t kReceiveOverflow = 0x01;
constexpr std::uint8_t kTransmitOverflow = 0x02;
constexpr std::uint8_t kWarning = 0x0C;
constexpr std::uint8_t kActiveAgain = 0x40;

}  // namespace

BusMonitor::BusMonitor(const RobotConfig& robot, const WatchdogConfig& watchdogs)
    : robot_(robot), silent_cycles_(watchdogs.silent_cycles), watches_(robot.buses.size()) {}

void BusMonitor::begin_cycle(std::int64_t time_us) noexcept {
  if (window_begin_us_ < 0) window_begin_us_ = time_us;
  const std::int64_t window_us = time_us - window_begin_us_;
  const bool window_over = window_us >= kLoadWindow_us;
  for (std::size_t i = 0; i < watches_.size(); ++i) {
    Watch& watch = watches_[i];
    watch.failed_cycles = watch.failed_now ? watch.failed_cycles + 1 : 0;
    if (!watch.failed_now) {
      // An interface that was set down and up begins with a controller that is active.
      if (watch.sending == BusCondition::kLinkDown) watch.controller = BusCondition::kActive;
      watch.sending = BusCondition::kActive;
      show(watch);
    }
    watch.failed_now = false;
    if (!window_over) continue;
    const double bits_s = 1e6 * static_cast<double>(watch.worst_bits) / static_cast<double>(window_us);
    watch.health.load_share = canopen::load(bits_s, robot_.bit_rate_bit_s);
    watch.worst_bits = 0;
  }
  if (window_over) window_begin_us_ = time_us;
}

void BusMonitor::sent(int bus, const CanFrame& frame) noexcept {
  Watch& watch = watches_[bus];
  ++watch.health.sent;
  watch.worst_bits += canopen::worst_frame_bits(frame.remote ? 0 : frame.length);
}

void BusMonitor::received(int bus, const CanFrame& frame, bool expected) noexcept {
  Watch& watch = watches_[bus];
  ++watch.health.received;
  watch.worst_bits += canopen::worst_frame_bits(frame.remote ? 0 : frame.length);
  if (!expected) ++watch.health.unexpected;
  if (watch.controller == BusCondition::kOff)
    set_controller(bus, BusCondition::kActive);  // what arrives shows that the bus works
}

void BusMonitor::error_frame(int bus, const CanFrame& frame) noexcept {
  Watch& watch = watches_[bus];
  ++watch.health.error_frames;
  if (tells_bus_restarted(frame)) {
    ++watch.health.restarts;
    set_controller(bus, BusCondition::kActive);
  }
  if ((frame.id & kCanErrorController) != 0) controller_error(bus, frame.data[1]);
  if (tells_link_down(frame)) {
    send_failed(bus, SendFailure::kLinkDown);
  } else if ((frame.id & kCanErrorTxTimeout) != 0) {
    watch.failed_now = true;
    enter(bus, BusCondition::kNoBuffers, true, "does not send: transmit time-out");
  }
  const bool queue_full = (frame.id & kCanErrorController) != 0 && (frame.data[1] & kTransmitOverflow) != 0;
  if ((frame.id & kCanErrorBusOff) != 0 && !queue_full) {
    if (watch.controller != BusCondition::kOff) ++watch.health.bus_offs;
    enter(bus, BusCondition::kOff, true, "is off (bus off)");
  }
}

/// Kernels tell a change, not the state: what was told stays until they tell another.
void BusMonitor::controller_error(int bus, std::uint8_t detail) noexcept {
  Watch& watch = watches_[bus];
  if ((detail & kReceiveOverflow) != 0) {
    ++watch.overflows;
    watch.health.dropped = watch.overflows + watch.traffic_dropped;
  }
  if ((detail & kTransmitOverflow) != 0) send_failed(bus, SendFailure::kNoBuffers);
  if (watch.controller == BusCondition::kOff) return;
  if ((detail & kControllerPassive) != 0) {
    enter(bus, BusCondition::kPassive, true, "is error passive");
  } else if ((detail & kWarning) != 0) {
    set_controller(bus, BusCondition::kWarning);
  } else if ((detail & kActiveAgain) != 0) {
    set_controller(bus, BusCondition::kActive);
  }
}

void BusMonitor::send_failed(int bus, SendFailure failure) noexcept {
  Watch& watch = watches_[bus];
  watch.failed_now = true;
  if (failure == SendFailure::kLinkDown) {
    enter(bus, BusCondition::kLinkDown, true, "has no link (link down)");
  } else {
    const bool lasts = watch.failed_cycles >= silent_cycles_;
    enter(bus, BusCondition::kNoBuffers, lasts, "takes no frames: send queue full");
  }
}

void BusMonitor::set_traffic(int bus, const BusTraffic& traffic) noexcept {
  BusHealth& health = watches_[bus].health;
  health.send_failed = traffic.send_failed;
  health.no_buffers = traffic.no_buffers;
  Watch& watch = watches_[bus];
  watch.traffic_dropped = traffic.dropped;
  health.dropped = watch.overflows + watch.traffic_dropped;
  health.malformed = traffic.malformed;
}

/// A worse condition stays until it is over.
void BusMonitor::enter(int bus, BusCondition condition, bool lost, const char* what) noexcept {
  const auto at = static_cast<std::size_t>(bus);
  Watch& watch = watches_[at];
  const bool of_sending = condition == BusCondition::kNoBuffers || condition == BusCondition::kLinkDown;
  BusCondition& kind = of_sending ? watch.sending : watch.controller;
  kind = std::max(kind, condition);
  show(watch);
  if (lost) watch.loss = std::max(watch.loss, condition);
  if (!lost || watch.lost) return;
  watch.lost = true;
  fault_new_ = true;
  fault_.cause = SafetyCause::kBusLost;
  print(fault_.detail, "bus %s (%s) is lost: it %s", robot_.buses[at].name.c_str(),
        robot_.buses[at].can.c_str(), what);
}

void BusMonitor::set_controller(int bus, BusCondition controller) noexcept {
  Watch& watch = watches_[bus];
  watch.controller = controller;
  show(watch);
}

/// The worse of the two; a bus is lost no more when neither says so.
void BusMonitor::show(Watch& watch) noexcept {
  watch.health.condition = std::max(watch.controller, watch.sending);
  if (watch.health.condition < BusCondition::kPassive) watch.lost = false;
}

bool BusMonitor::any_lost() const noexcept {
  return std::any_of(watches_.begin(), watches_.end(), [](const Watch& watch) { return watch.lost; });
}

const char* BusMonitor::loss(int bus) const noexcept {
  switch (watches_[bus].loss) {
    case BusCondition::kOff:
      return "bus was off";
    case BusCondition::kLinkDown:
      return "bus had no link";
    case BusCondition::kNoBuffers:
      return "bus was full";
    case BusCondition::kPassive:
      return "bus was passive";
    default:
      return nullptr;
  }
}

void BusMonitor::forget_losses() noexcept {
  for (Watch& watch : watches_) watch.loss = BusCondition::kActive;
}

const char* BusMonitor::what_to_mend() const noexcept {
  for (const Watch& watch : watches_) {
    if (!watch.lost) continue;
    switch (watch.health.condition) {
      case BusCondition::kOff:
        return "a bus is off: ip link set INTERFACE type can restart, or give it restart-ms";
      case BusCondition::kLinkDown:
        return "a bus has no link: ip link set INTERFACE up";
      case BusCondition::kPassive:
        return "a bus is error passive: cable, terminators, bit rate? else set the interface down and up";
      default:
        return "a bus takes no frames: nobody acknowledges, or its queue is too short";
    }
  }
  return nullptr;
}

}  // namespace sprung
