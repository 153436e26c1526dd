#include "drivers/sim/canopen_device.h"

#include "drivers/canopen/objects.h"

namespace sprung::sim {
namespace {

using canopen::NmtCommand;
using canopen::NmtState;

constexpr std::uint16_t kHeartbeatLost = 0x8130;
constexpr std::uint16_t kPdoTooShort = 0x8210;

/// Bit of 0x1001 for an error code's class, with the generic bit (facts canopen 1.3, 2.5).
std::int64_t register_bits(std::uint16_t code) noexcept {
  switch (code >> 12) {
    case 0x2:
      return 0x03;
    case 0x3:
      return 0x05;
    case 0x4:
      return 0x09;
    case 0x8:
      return 0x11;
    case 0x6:
    case 0x7:
      return 0x21;
    case 0xF:
      return 0x81;
    default:
      return 0x01;
  }
}

/// 0x1016: node in bits 16-22, time in ms below.
int guarded_node(std::int64_t consumer) noexcept { return static_cast<int>((consumer >> 16) & 0x7F); }
std::int64_t guard_time_us(std::int64_t consumer) noexcept { return 1000 * (consumer & 0xFFFF); }

canopen::ObjectId consumer_id(std::size_t i) noexcept {
  return {canopen::kHeartbeatConsumer, static_cast<std::uint8_t>(i + 1)};
}

}  // namespace

CanopenDevice::CanopenDevice(int node, ObjectDictionary& dictionary, DeviceApplication& application,
                             Outbox& outbox) noexcept
    : node_(node),
      dictionary_(dictionary),
      application_(application),
      outbox_(outbox),
      pdos_(dictionary, application, outbox) {}

void CanopenDevice::boot_up() noexcept {
  guards_ = {};
  next_heartbeat_us_ = 0;
  pdos_.configure();
  outbox_.send(canopen::heartbeat_frame(node_, NmtState::kBootUp));
  state_ = NmtState::kPreOperational;
}

void CanopenDevice::receive(const CanFrame& frame, std::int64_t time_us) noexcept {
  if (outbox_.cut() || frame.error || state_ == NmtState::kBootUp) return;
  NmtCommand command{};
  if (canopen::decode_nmt(frame, node_, command)) {
    nmt(command);
  } else if ((frame.id & ~0x7FU) == canopen::kHeartbeatBase) {
    hear(frame, time_us);
  } else if (frame.id == canopen::sdo_client_id(node_)) {
    if (state_ != NmtState::kStopped) serve(frame);
  } else if (!operational()) {
    return;
  } else if (frame.id == canopen::kSyncId) {
    pdos_.sync();
  } else if (!pdos_.receive(frame)) {
    raise(kPdoTooShort);
  }
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
      dictionary_.restore(0x0000, 0xFFFF);
      application_.reset();
      break;
    case NmtCommand::kResetCommunication:
      enter(NmtState::kPreOperational);
      dictionary_.restore(0x1000, 0x1FFF);
      break;
  }
  boot_up();
}

void CanopenDevice::enter(NmtState state) noexcept {
  const bool was_operational = operational();
  state_ = state;
  if (operational() && !was_operational) pdos_.configure();
  if (!operational() && was_operational) application_.connection_lost();
}

void CanopenDevice::serve(const CanFrame& frame) noexcept {
  const canopen::SdoMessage request = canopen::decode_sdo_request(frame);
  std::uint32_t error = canopen::kAbortCommand;
  if (request.kind == canopen::SdoKind::kAbort) return;  // the client gave up; there is nothing to undo
  if (request.kind == canopen::SdoKind::kUpload) {
    std::uint32_t value = 0;
    int size = 0;
    error = dictionary_.read(request.object, value, size);
    if (error == 0) return outbox_.send(canopen::sdo_read_reply(node_, request.object, value, size));
  } else if (request.kind == canopen::SdoKind::kDownload) {
    error = write(request);
    if (error == 0) return outbox_.send(canopen::sdo_write_reply(node_, request.object));
  }
  outbox_.send(canopen::sdo_server_abort(node_, request.object, error));
}

std::uint32_t CanopenDevice::write(const canopen::SdoMessage& request) noexcept {
  if (const std::uint32_t error = check_pdo_write(dictionary_, request.object, request.value)) return error;
  const std::uint32_t error = dictionary_.write(request.object, request.value, request.size);
  if (error == 0) after_write(request.object);
  return error;
}

void CanopenDevice::after_write(canopen::ObjectId id) noexcept {
  if (configures_pdo(id)) pdos_.configure();
  if (id.index == canopen::kHeartbeatConsumer) guards_[id.sub - 1U] = {};
  if (id.index == canopen::kHeartbeatProducer) next_heartbeat_us_ = 0;
  application_.written(id);
}

void CanopenDevice::hear(const CanFrame& frame, std::int64_t time_us) noexcept {
  const int sender = static_cast<int>(frame.id & 0x7F);
  for (std::size_t i = 0; i < guards_.size(); ++i) {
    const std::int64_t consumer = dictionary_.get(consumer_id(i));
    if (guard_time_us(consumer) == 0 || guarded_node(consumer) != sender) continue;
    const bool was_lost = guards_[i].lost;
    guards_[i] = {time_us, true, false};
    if (was_lost) application_.connection_back();
  }
}

void CanopenDevice::tick(std::int64_t time_us) noexcept {
  if (state_ == NmtState::kBootUp) boot_up();
  produce_heartbeat(time_us);
  supervise(time_us);
  if (operational()) pdos_.send_events(time_us);
}

void CanopenDevice::produce_heartbeat(std::int64_t time_us) noexcept {
  const std::int64_t period_us = 1000 * dictionary_.get({canopen::kHeartbeatProducer, 0});
  if (period_us == 0 || time_us < next_heartbeat_us_) return;
  outbox_.send(canopen::heartbeat_frame(node_, state_));
  next_heartbeat_us_ = time_us + period_us;
}

/// A guard starts with the first heartbeat it hears.
void CanopenDevice::supervise(std::int64_t time_us) noexcept {
  for (std::size_t i = 0; i < guards_.size(); ++i) {
    Guard& guard = guards_[i];
    const std::int64_t limit_us = guard_time_us(dictionary_.get(consumer_id(i)));
    if (limit_us == 0 || !guard.heard || guard.lost || time_us - guard.last_us < limit_us) continue;
    guard.lost = true;
    raise(kHeartbeatLost);
    application_.connection_lost();
  }
}

void CanopenDevice::raise(std::uint16_t code) noexcept {
  const canopen::ObjectId error_register{canopen::kErrorRegister, 0};
  dictionary_.set(error_register, dictionary_.get(error_register) | register_bits(code));
  push_history(code);
  send_emergency(code);
}

void CanopenDevice::clear_errors() noexcept {
  const canopen::ObjectId error_register{canopen::kErrorRegister, 0};
  if (dictionary_.get(error_register) == 0) return;
  dictionary_.set(error_register, 0);
  send_emergency(0);
}

void CanopenDevice::send_emergency(std::uint16_t code) noexcept {
  if (state_ == NmtState::kStopped) return;
  const auto bits = static_cast<std::uint8_t>(dictionary_.get({canopen::kErrorRegister, 0}));
  outbox_.send(canopen::emergency_frame(node_, {code, bits}));
}

/// Newest first; as many as the dictionary has room for.
void CanopenDevice::push_history(std::uint16_t code) noexcept {
  const auto entry = [](std::int64_t sub) {
    return canopen::ObjectId{canopen::kErrorHistory, static_cast<std::uint8_t>(sub)};
  };
  std::int64_t count = dictionary_.get(entry(0));
  if (dictionary_.find(entry(count + 1)) >= 0) ++count;
  for (std::int64_t sub = count; sub > 1; --sub) dictionary_.set(entry(sub), dictionary_.get(entry(sub - 1)));
  dictionary_.set(entry(1), code);
  dictionary_.set(entry(0), count);
}

}  // namespace sprung::sim
