#pragma once
/// Condition and counters of every bus, from the frames that pass, the controller's error frames and what the
/// shell could not send. Pure; stepped by time.
#include <cstdint>
#include <vector>

#include "drivers/bridge/safety_machine.h"
#include "drivers/can/can_frame.h"
#include "robots/robot_config.h"
#include "signals/bus_state.h"

namespace sprung {

/// Why a shell could not send.
enum class SendFailure : std::int8_t { kNoBuffers, kLinkDown, kOther };

/// What only the CAN back end can count; see BusHealth.
struct BusTraffic {
  std::int64_t send_failed = 0;
  std::int64_t no_buffers = 0;
  std::int64_t dropped = 0;
  std::int64_t malformed = 0;
};

class BusMonitor {
 public:
  BusMonitor(const RobotConfig& robot, const WatchdogConfig& watchdogs);

  /// Once a cycle, before its frames: how sending went in the last one, and the load of the last second.
  void begin_cycle(std::int64_t time_us) noexcept;
  void sent(int bus, const CanFrame& frame) noexcept;
  /// A data frame. @param expected it is one that a node of this robot may send.
  void received(int bus, const CanFrame& frame, bool expected) noexcept;
  void error_frame(int bus, const CanFrame& frame) noexcept;
  /// Frames of this cycle were dropped: newer ones follow, so it is trouble only when it lasts.
  void send_failed(int bus, SendFailure failure) noexcept;
  void set_traffic(int bus, const BusTraffic& traffic) noexcept;

  /// In the last cycle: what changed in it may not have gone out.
  bool sending_failed(int bus) const noexcept { return watches_[bus].failed_cycles > 0; }
  bool lost(int bus) const noexcept { return watches_[bus].lost; }
  bool any_lost() const noexcept;
  /// Why nothing can be mended by us, for people; nullptr when every bus works. Static text.
  const char* what_to_mend() const noexcept;
  const BusHealth& health(std::size_t bus) const noexcept { return watches_[bus].health; }

  /// That the bus was lost since the last forget_losses(), whether or not it is back, e.g. "bus was off";
  /// nullptr = it was not. Its nodes have missed the bridge, and may have restarted unheard (facts canopen
  /// 5). Static text.
  const char* loss(int bus) const noexcept;
  void forget_losses() noexcept;
  /// A bus was lost since the last forget_trouble(), whether or not it is back; nullptr = none.
  const Fault* fault() const noexcept { return fault_new_ ? &fault_ : nullptr; }
  void forget_trouble() noexcept { fault_new_ = false; }

 private:
  struct Watch {
    BusHealth health;
    bool lost = false;
    BusCondition loss = BusCondition::kActive;        ///< worst one since the last forget_losses()
    bool failed_now = false;                          ///< in this cycle
    int failed_cycles = 0;                            ///< in a row, before this one
    BusCondition controller = BusCondition::kActive;  ///< active, warning, passive or off: until the
                                                      ///< controller says so
    BusCondition sending = BusCondition::kActive;     ///< active, no buffers or link down: of the last cycle
    std::int64_t overflows = 0;  ///< of the controller's receive queue; those of the back end's come on top
    std::int64_t traffic_dropped = 0;
    std::int64_t worst_bits = 0;
  };
  void enter(int bus, BusCondition condition, bool lost, const char* what) noexcept;
  void set_controller(int bus, BusCondition controller) noexcept;
  static void show(Watch& watch) noexcept;
  void controller_error(int bus, std::uint8_t detail) noexcept;

  const RobotConfig& robot_;
  int silent_cycles_;
  std::vector<Watch> watches_;
  std::int64_t window_begin_us_ = -1;
  Fault fault_;
  bool fault_new_ = false;
};

}  // namespace sprung
