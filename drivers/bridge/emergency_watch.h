#pragma once
/// The emergency of one node that stands, and what it has said so far. Pure.
#include "drivers/canopen/emergency.h"
#include "signals/bus_state.h"

namespace sprung {

class EmergencyWatch {
 public:
  void receive(const canopen::Emergency& emergency) noexcept;
  /// Once a cycle: one that the node has withdrawn is forgotten, if it was judged since it came.
  void begin_cycle() noexcept;
  /// Faults have been judged, this one among them.
  void judged() noexcept { judged_ = true; }
  void forget() noexcept;

  bool stands() const noexcept { return emergency_.code != 0; }
  /// That stands, or that a node in fault last sent; code 0 = none.
  const canopen::Emergency& emergency() const noexcept { return emergency_; }
  /// Told since there was no fault, whatever emergency came after: only a reset of the communication heals
  /// it (facts canopen 2.5).
  bool communication_fault() const noexcept { return communication_fault_; }
  /// Number, last code and error register.
  void show(NodeHealth& out) const noexcept;

 private:
  canopen::Emergency emergency_;
  bool communication_fault_ = false;
  bool judged_ = false;
  bool withdrawn_ = false;
  std::int64_t received_ = 0;
  std::uint16_t last_code_ = 0;
  std::uint8_t error_register_ = 0;
};

}  // namespace sprung
