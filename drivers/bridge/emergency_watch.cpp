#include "drivers/bridge/emergency_watch.h"

namespace sprung {
namespace {

bool is_communication_fault(int code) noexcept { return (code & 0xFF00) == 0x8100 || code == 0x8210; }

}  // namespace

void EmergencyWatch::receive(const canopen::Emergency& emergency) noexcept {
  error_register_ = emergency.error_register;
  // "No error" beside a register that is not 0: one of several is gone (facts canopen 1.5).
  withdrawn_ = emergency.code == 0 && emergency.error_register == 0;
  if (emergency.code == 0) return;
  emergency_ = emergency;
  communication_fault_ = communication_fault_ || is_communication_fault(emergency.code);
  judged_ = false;
  ++received_;
  last_code_ = emergency.code;
}

void EmergencyWatch::begin_cycle() noexcept {
  if (withdrawn_ && judged_) forget();
}

void EmergencyWatch::forget() noexcept {
  emergency_ = {};
  communication_fault_ = false;
}

void EmergencyWatch::show(NodeHealth& out) const noexcept {
  out.emergencies = received_;
  out.last_emergency_code = last_code_;
  out.error_register = error_register_;
}

}  // namespace sprung
