#include "tests/support/fake_drive.h"

#include "drivers/canopen/objects.h"
#include "drivers/cia402/words.h"

namespace sprung::test {

using namespace canopen;
namespace {

/// Firmware that the profiles know: a Gold's, an EPOS2's.
std::uint32_t known_revision(const IdentityConfig& identity) {
  return identity.vendor == 0xFB ? 0x21260000 : 0x000103F6;
}
constexpr std::uint32_t kCyclicModes = 0x280;  ///< 8 and 10

}  // namespace

FakeDrive::FakeDrive(int node, const IdentityConfig& identity) : node_(node) {
  objects[{kDeviceType, 0}] = 0x00020192;
  objects[{kIdentity, 1}] = identity.vendor;
  objects[{kIdentity, 2}] = identity.product;
  objects[{kIdentity, 3}] = identity.revision != 0 ? identity.revision : known_revision(identity);
  objects[{kSupportedModes, 0}] = kCyclicModes;
  objects[{kSupplyVoltage, 0}] = 48000;
  objects[{kModeDisplay, 0}] = 0;
  objects[{kControlWord, 0}] = 0;
  defaults_ = objects;
}

void FakeDrive::receive(const CanFrame& frame, std::vector<CanFrame>& out) {
  if (dead) return;
  if (is_guard_request(frame, node_)) {
    ++guard_requests;
    if (mute_guarding) return;
    out.push_back(guard_reply(node_, {nmt, toggle_}));
    toggle_ = toggle_ == stuck_toggle;
    return;
  }
  NmtCommand command{};
  if (decode_nmt(frame, node_, command)) {
    received.push_back(frame);
    receive_nmt(command, out);
  } else if (frame.id == sdo_client_id(node_)) {
    received.push_back(frame);
    receive_sdo(frame, out);
  } else if (nmt == NmtState::kOperational) {
    receive_pdo(frame, out);
  }
}

void FakeDrive::receive_nmt(NmtCommand command, std::vector<CanFrame>& out) {
  if (command == NmtCommand::kStart) nmt = NmtState::kOperational;
  if (command == NmtCommand::kEnterPreOperational) nmt = NmtState::kPreOperational;
  if (command == NmtCommand::kStop) nmt = NmtState::kStopped;
  if (command != NmtCommand::kResetCommunication && command != NmtCommand::kResetNode) return;
  ++resets;
  if (command == NmtCommand::kResetNode && !stuck_on) power = PowerState::kSwitchOnDisabled;
  if (reset_heals_stuck_fault) stuck_in_fault = false;
  if (loses_settings_on_reset) objects = defaults_;
  nmt = NmtState::kPreOperational;
  toggle_ = false;
  if (!boots_silently) out.push_back(heartbeat_frame(node_, NmtState::kBootUp));
}

void FakeDrive::receive_sdo(const CanFrame& frame, std::vector<CanFrame>& out) {
  const SdoMessage request = decode_sdo_request(frame);
  const Key key{request.object.index, request.object.sub};
  objects[{kStatusWord, 0}] = cia402::encode_status(power);
  if (aborts.count(key) != 0) {
    out.push_back(sdo_server_abort(node_, request.object, aborts[key]));
  } else if (request.kind == SdoKind::kDownload && write_aborts.count(key) != 0) {
    out.push_back(sdo_server_abort(node_, request.object, write_aborts[key]));
  } else if (request.kind == SdoKind::kDownload) {
    objects[key] = clamped.count(key) != 0 ? clamped[key] : request.value;
    if (request.object.index == kControlWord) apply_control_word(static_cast<std::uint16_t>(request.value));
    out.push_back(sdo_write_reply(node_, request.object));
  } else if (objects.count(key) == 0) {
    out.push_back(sdo_server_abort(node_, request.object, kAbortNoObject));
  } else {
    out.push_back(sdo_read_reply(node_, request.object, objects[key], 4));
  }
}

void FakeDrive::receive_pdo(const CanFrame& frame, std::vector<CanFrame>& out) {
  if (frame.id == kSyncId) {
    if (!mute_samples) send_sample(out);
  } else if (frame.id == rpdo_id(0, node_) && frame.length == 7) {
    target_torque_permille = static_cast<std::int16_t>(get_le(&frame.data[0], 2));
    target_position_counts = static_cast<std::int32_t>(get_le(&frame.data[2], 4));
    const auto asked = static_cast<std::int8_t>(frame.data[6]);
    if (asked == mode || keeps_mode) return;
    mode = asked;
    objects[{kModeDisplay, 0}] = frame.data[6];
    if (mute_mode_display) return;
    CanFrame display;
    display.id = tpdo_id(1, node_);
    display.length = 1;
    display.data[0] = frame.data[6];
    out.push_back(display);
  } else if (frame.id == rpdo_id(1, node_) && frame.length == 2) {
    apply_control_word(static_cast<std::uint16_t>(get_le(&frame.data[0], 2)));
  }
}

void FakeDrive::apply_control_word(std::uint16_t word) {
  const PowerState before = power;
  if (!stuck_on) power = cia402::apply_control(power, word, control_word);
  control_word = word;
  if (stuck_in_fault && before == PowerState::kFault) power = before;
  if (power == PowerState::kOperationEnabled && before != power) ++enabled_count;
}

void FakeDrive::send_sample(std::vector<CanFrame>& out) {
  CanFrame frame;
  frame.id = tpdo_id(0, node_);
  frame.length = 8;
  put_le(&frame.data[0], static_cast<std::uint32_t>(position_counts), 4);
  put_le(&frame.data[4], static_cast<std::uint16_t>(torque_permille), 2);
  put_le(&frame.data[6], cia402::encode_status(power), 2);
  out.push_back(frame);
}

void FakeDrive::tick(std::int64_t time_us, std::vector<CanFrame>& out) {
  if (dead) return;
  if (restart_now) {
    restart_now = false;
    objects = defaults_;
    power = PowerState::kSwitchOnDisabled;
    nmt = NmtState::kPreOperational;
    toggle_ = false;
    out.push_back(heartbeat_frame(node_, NmtState::kBootUp));
  }
  if (pending_emergency != 0) {
    out.push_back(emergency_frame(node_, {pending_emergency, 1}));
    pending_emergency = 0;
    power = PowerState::kFault;
  }
  if (passing_emergency != 0) {
    out.push_back(emergency_frame(node_, {passing_emergency, 1}));
    out.push_back(emergency_frame(node_, {0, 0}));
    passing_emergency = 0;
  }
  quick_stop_cycles_ = power == PowerState::kQuickStopActive ? quick_stop_cycles_ + 1 : 0;
  if (quick_stop_cycles_ > 100 && !stuck_in_quick_stop) power = PowerState::kSwitchOnDisabled;
  const auto period = objects.find({kHeartbeatProducer, 0});
  if (period == objects.end() || mute_heartbeat || time_us < next_heartbeat_us_) return;
  next_heartbeat_us_ = time_us + 1000LL * period->second;
  out.push_back(heartbeat_frame(node_, nmt));
}

}  // namespace sprung::test
