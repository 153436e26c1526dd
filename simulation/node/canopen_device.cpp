#include "simulation/node/canopen_device.h"

#include "drivers/canopen/objects.h"
#include "simulation/node/communication_rules.h"

namespace sprung::sim {
namespace {

using canopen::NmtCommand;
using canopen::NmtState;

constexpr std::uint16_t kErrorPassive = 0x8120;
constexpr std::uint16_t kMasterLost = 0x8130;
constexpr std::uint16_t kBusOff = 0x81FD;
constexpr std::uint16_t kPdoTooShort = 0x8210;

/// A SYNC may carry a counter; no device here has 0x1019, so it is not looked at.
bool is_sync(const CanFrame& frame) noexcept { return frame.id == canopen::kSyncId && frame.length <= 1; }

/// What a CAN controller reports under these faults; 0 = it is well.
std::uint16_t bus_error(const Outbox& outbox) noexcept {
  if (outbox.active(FaultKind::kBusOff)) return kBusOff;
  return outbox.active(FaultKind::kErrorPassive) ? kErrorPassive : std::uint16_t{0};
}

}  // namespace

CanopenDevice::CanopenDevice(int node, ObjectDictionary& dictionary, DeviceApplication& application,
                             Outbox& outbox, const DevicePolicy& policy) noexcept
    : node_(node),
      dictionary_(dictionary),
      application_(application),
      outbox_(outbox),
      policy_(policy),
      lss_(dictionary, policy.lss, policy.factory_node != 0 ? policy.factory_node : node),
      pdos_(dictionary, application, outbox, policy.events_on_change),
      sdo_(node, *this),
      errors_(dictionary),
      watch_(dictionary) {}

/// The node id that counts from here on, and every identifier that hangs on it.
void CanopenDevice::take_node() noexcept {
  if (!lss_.has_node() || lss_.node() == node_) return;
  renumber(dictionary_, node_, lss_.node());
  node_ = lss_.node();
  sdo_.set_node(node_);
}

/// Without a node id it says nothing, and hears layer setting services alone.
void CanopenDevice::boot_up() noexcept {
  state_ = NmtState::kBootUp;
  if (!lss_.has_node()) return;
  take_node();
  watch_.restart();
  sdo_.reset();
  next_heartbeat_us_ = 0;
  pdos_.configure();
  outbox_.send(canopen::heartbeat_frame(node_, NmtState::kBootUp));
  state_ = NmtState::kPreOperational;
}

void CanopenDevice::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  outbox_.release(time_us);
  const bool lss = frame.id == canopen::kLssMasterId;
  if (frame.error || (state_ == NmtState::kBootUp && !lss) || !outbox_.hears()) return;
  if (lss) return receive_lss(frame);
  NmtCommand command{};
  if (frame.remote) {
    if (canopen::is_guard_request(frame, node_)) return answer_guard(time_us);
    if (operational()) pdos_.answer_remote(frame);
  } else if (canopen::decode_nmt(frame, node_, command)) {
    nmt(command);
  } else if ((frame.id & ~0x7FU) == canopen::kHeartbeatBase) {
    follow(watch_.hear(frame, time_us));
  } else if (frame.id == canopen::sdo_client_id(node_)) {
    if (state_ != NmtState::kStopped) serve(frame, time_us);
  } else if (operational()) {
    is_sync(frame) ? sync() : receive_pdo(frame);
  }
}

void CanopenDevice::receive_lss(const CanFrame& frame) noexcept {
  const LssSlave::Answer answer = lss_.receive(frame);
  if (answer.replies) outbox_.send(answer.reply);
  if (answer.wakes) boot_up();
}

void CanopenDevice::nmt(NmtCommand command) noexcept {
  switch (command) {
    case NmtCommand::kStart:
      return enter(NmtState::kOperational);
    case NmtCommand::kStop:
      return enter(NmtState::kStopped);
    case NmtCommand::kEnterPreOperational:
      return enter(NmtState::kPreOperational);
    case NmtCommand::kResetNode:
      restart();
      return boot_up();
    case NmtCommand::kResetCommunication:
      break;
  }
  const bool was_lost = watch_.lost();
  enter(NmtState::kPreOperational);
  application_.connection_lost();
  dictionary_.recall(0x1000, 0x1FFF);
  lss_.reset_communication();
  boot_up();
  if (was_lost) application_.connection_back();
}

/// Of the NMT states CiA 402 counts stopped alone as a lost connection: a drive that is made pre-operational
/// keeps its power and its last set-point.
void CanopenDevice::enter(NmtState state) noexcept {
  const bool was_operational = operational();
  state_ = state;
  if (operational() && !was_operational) pdos_.configure();
  if (state != NmtState::kStopped) return;
  sdo_.reset();
  application_.connection_lost();
}

/// As after power-on, but for the boot-up frame.
void CanopenDevice::restart() noexcept {
  dictionary_.restart();
  lss_.restart();
  errors_.restart();
  application_.reset();
}

void CanopenDevice::power_cycle() noexcept {
  restart();
  state_ = NmtState::kBootUp;
}

void CanopenDevice::serve(const CanFrame& frame, std::int64_t time_us) noexcept {
  CanFrame reply;
  if (sdo_.receive(frame, time_us, reply)) outbox_.send(reply, FrameKind::kSdo);
}

std::uint32_t CanopenDevice::read(canopen::ObjectId id, std::uint8_t* bytes, std::size_t capacity,
                                  std::size_t& size) noexcept {
  if (const std::uint32_t error = dictionary_.read(id, bytes, capacity, size)) return error;
  return application_.check_read(id);
}

std::uint32_t CanopenDevice::write(canopen::ObjectId id, const std::uint8_t* bytes, std::size_t size,
                                   bool size_told) noexcept {
  std::int64_t value = 0;
  const std::uint32_t refused = dictionary_.check(id, bytes, size, size_told, value);
  // CiA 301 wants this code for the history, whatever limits an EDS gives.
  if (refused == canopen::kAbortTooHigh && id.index == canopen::kErrorHistory) return canopen::kAbortRange;
  if (refused != 0) return refused;
  if (const std::uint32_t error = check_write(id, value)) return error;
  if (is_store_order(id)) {
    obey_store_order(dictionary_, id);
    return 0;
  }
  dictionary_.accept(id, bytes, size, value);
  after_write(id);
  return 0;
}

std::uint32_t CanopenDevice::check_write(canopen::ObjectId id, std::int64_t value) noexcept {
  const bool of_pdo = pdo_object(id.index).n >= 0;
  if (of_pdo && operational() && policy_.remap_in_operational != 0) return policy_.remap_in_operational;
  if (of_pdo) {
    const std::uint32_t error = check_pdo_write(dictionary_, id, static_cast<std::uint32_t>(value));
    if (error != 0) return error;
  }
  if (const std::uint32_t error = check_communication_write(dictionary_, id, value)) return error;
  return application_.check_write(id, value);
}

void CanopenDevice::after_write(canopen::ObjectId id) noexcept {
  const PdoObject pdo = pdo_object(id.index);
  if (pdo.n >= 0) pdos_.configure(pdo);
  if (id.index == canopen::kErrorHistory) errors_.clear_history();
  if (id.index == canopen::kHeartbeatConsumer) watch_.rearm(id.sub);
  if (id.index == canopen::kHeartbeatProducer) next_heartbeat_us_ = 0;
  application_.written(id);
}

void CanopenDevice::answer_guard(std::int64_t time_us) noexcept {
  CanFrame reply;
  bool answers = false;
  const MasterWatch::Change change = watch_.guard(node_, state_, time_us, reply, answers);
  if (answers) outbox_.send(reply, FrameKind::kHeartbeat);
  follow(change);
}

void CanopenDevice::sync() noexcept {
  application_.synced();
  pdos_.sync();
}

void CanopenDevice::receive_pdo(const CanFrame& frame) noexcept {
  switch (pdos_.receive(frame)) {
    case PdoReception::kForeign:
      return;
    case PdoReception::kTaken:
      if (!policy_.short_pdo_loses_connection) clear(kPdoTooShort);
      return;
    case PdoReception::kTooShort:
      return policy_.short_pdo_loses_connection ? communication_error(kPdoTooShort) : raise(kPdoTooShort);
  }
}

void CanopenDevice::follow(MasterWatch::Change change) noexcept {
  if (change == MasterWatch::Change::kLost) communication_error(kMasterLost);
  if (change == MasterWatch::Change::kBack) application_.connection_back();
}

/// 0x1029:01 says what becomes of the NMT state, and only of operational (CiA 301).
void CanopenDevice::communication_error(std::uint16_t code) noexcept {
  raise(code);
  application_.connection_lost();
  if (!operational()) return;
  const std::int64_t behaviour = dictionary_.get_or({canopen::kErrorBehaviour, 1},
                                                    policy_.after_communication_error);
  if (behaviour == 0) state_ = NmtState::kPreOperational;
  if (behaviour == 2) state_ = NmtState::kStopped;
}

void CanopenDevice::watch_bus() noexcept {
  const std::uint16_t now = bus_error(outbox_);
  if (now == bus_error_) return;
  bus_error_ = now;
  now != 0 ? communication_error(now) : application_.connection_back();
}

void CanopenDevice::tick(std::int64_t time_us) noexcept {
  outbox_.release(time_us);
  if (state_ == NmtState::kBootUp) boot_up();
  if (!lss_.has_node()) return;
  watch_bus();
  produce_heartbeat(time_us);
  follow(watch_.check(time_us));
  CanFrame unasked;  // a segment of a block each tick: a drive has other things to do
  if (sdo_.step(time_us, unasked)) outbox_.send(unasked, FrameKind::kSdo);
  if (operational()) pdos_.send_events(time_us);
}

void CanopenDevice::produce_heartbeat(std::int64_t time_us) noexcept {
  const std::int64_t period_us = watch_.heartbeat_us();
  if (period_us == 0 || time_us < next_heartbeat_us_) return;
  outbox_.send(canopen::heartbeat_frame(node_, state_), FrameKind::kHeartbeat);
  next_heartbeat_us_ = time_us + period_us;
}

void CanopenDevice::raise(std::uint16_t code) noexcept {
  if (errors_.raise(code)) send_emergency(code);
}

void CanopenDevice::clear(std::uint16_t code) noexcept {
  if (errors_.clear(code)) send_emergency(0);
}

void CanopenDevice::clear_errors() noexcept {
  if (errors_.clear_all()) send_emergency(0);
}

/// Neither in stopped, nor while 0x1014 says that there is no emergency object.
void CanopenDevice::send_emergency(std::uint16_t code) noexcept {
  const auto cob_id = static_cast<std::uint32_t>(
      dictionary_.get_or({canopen::kEmergencyCobId, 0}, canopen::emcy_id(node_)));
  if (state_ == NmtState::kStopped || state_ == NmtState::kBootUp || !canopen::pdo_valid(cob_id)) return;
  CanFrame frame = canopen::emergency_frame(node_, {code, errors_.error_register()});
  frame.id = cob_id & canopen::kPdoIdMask;
  outbox_.send(frame);
}

}  // namespace sprung::sim
