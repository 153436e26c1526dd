#pragma once
/// What a bad bus does to the master's side: frames that do not arrive at the nodes, and the error frames
/// that SocketCAN would give the bridge (drivers/can/can_errors.h). What it does to the nodes is in their
/// outboxes.
#include <array>
#include <cstddef>
#include <vector>

#include "drivers/can/can_frame.h"
#include "signals/modes.h"

namespace sprung::sim {

class BusFaults {
 public:
  explicit BusFaults(std::size_t buses) : full_(buses), down_(buses) {}

  /// kBusOff: error frame bus off, at its end restarted. kErrorPassive: controller passive, at its end active
  /// again. kQueueFull, kLinkDown: the master's frames are lost, which a kernel tells by ENOBUFS and ENETDOWN
  /// and the bridge's shell by frames of its own: these, at each SYNC. Others change nothing here.
  void set(int bus, FaultKind kind, bool on) noexcept;
  /// The master sends SYNC.
  void sync(int bus) noexcept;
  /// Whether the master's frames get to the nodes' cables.
  bool delivers(int bus) const noexcept { return !full_[index(bus)] && !down_[index(bus)]; }
  /// Error frames since the last call, in order.
  void report(FrameBatch& out) noexcept;

 private:
  /// Error frames between two reports; more are lost, as in a kernel.
  static constexpr std::size_t kCapacity = 64;
  static constexpr std::size_t index(int bus) noexcept { return static_cast<std::size_t>(bus); }
  void tell(int bus, const CanFrame& error) noexcept;

  std::vector<bool> full_, down_;
  std::array<BusFrame, kCapacity> waiting_{};
  std::size_t count_ = 0;
};

}  // namespace sprung::sim
