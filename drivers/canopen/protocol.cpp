#include "drivers/canopen/protocol.h"

namespace sprung::canopen {
namespace {

// SDO command specifiers with the expedited and size-told bits set; n unused bytes go to bits 2-3 (CiA
// 301 7.2.4.3).
constexpr std::uint8_t kWriteExpedited = 0x23;
constexpr std::uint8_t kWriteNoSize = 0x22;
constexpr std::uint8_t kReadReplyExpedited = 0x43;
constexpr std::uint8_t kReadReplyNoSize = 0x42;
constexpr std::uint8_t kReadRequest = 0x40;
constexpr std::uint8_t kWriteReply = 0x60;
constexpr std::uint8_t kAbort = 0x80;
constexpr std::uint8_t kUnusedMask = 0x0C;

std::uint8_t with_size(std::uint8_t command, int size) noexcept {
  return static_cast<std::uint8_t>(command | ((4 - size) << 2));
}

CanFrame sdo_frame(std::uint32_t id, std::uint8_t command, ObjectId object, std::uint32_t value) noexcept {
  CanFrame frame;
  frame.id = id;
  frame.length = 8;
  frame.data[0] = command;
  put_le(&frame.data[1], object.index, 2);
  frame.data[3] = object.sub;
  put_le(&frame.data[4], value, 4);
  return frame;
}

SdoMessage message(SdoKind kind, const CanFrame& frame, int size) noexcept {
  SdoMessage result;
  result.kind = kind;
  result.object = {static_cast<std::uint16_t>(get_le(&frame.data[1], 2)), frame.data[3]};
  result.size = size;
  result.value = get_le(&frame.data[4], size == 0 ? 4 : size);
  return result;
}

/// The two services that carry a value: expedited with and without its size.
SdoMessage decode_value(SdoKind kind, const CanFrame& frame, std::uint8_t sized,
                        std::uint8_t unsized) noexcept {
  const std::uint8_t command = frame.data[0];
  if ((command & ~kUnusedMask) == sized) return message(kind, frame, 4 - ((command & kUnusedMask) >> 2));
  if (command == unsized) return message(kind, frame, 0);
  return {};
}

}  // namespace

void put_le(std::uint8_t* bytes, std::uint32_t value, int count) noexcept {
  for (int i = 0; i < count; ++i) bytes[i] = static_cast<std::uint8_t>((value >> (8 * i)) & 0xFF);
}

std::uint32_t get_le(const std::uint8_t* bytes, int count) noexcept {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i) value |= static_cast<std::uint32_t>(bytes[i]) << (8 * i);
  return value;
}

CanFrame nmt_frame(NmtCommand command, int node) noexcept {
  CanFrame frame;
  frame.id = kNmtId;
  frame.length = 2;
  frame.data[0] = static_cast<std::uint8_t>(command);
  frame.data[1] = static_cast<std::uint8_t>(node);
  return frame;
}

CanFrame sync_frame() noexcept {
  CanFrame frame;
  frame.id = kSyncId;
  return frame;
}

CanFrame heartbeat_frame(int node, NmtState state) noexcept {
  CanFrame frame;
  frame.id = heartbeat_id(node);
  frame.length = 1;
  frame.data[0] = static_cast<std::uint8_t>(state);
  return frame;
}

NmtState heartbeat_state(const CanFrame& frame) noexcept {
  if (frame.length != 1) return NmtState::kUnknown;
  const auto state = static_cast<NmtState>(frame.data[0] & 0x7F);
  switch (state) {
    case NmtState::kBootUp:
    case NmtState::kStopped:
    case NmtState::kOperational:
    case NmtState::kPreOperational:
      return state;
    case NmtState::kUnknown:
      break;
  }
  return NmtState::kUnknown;
}

bool decode_nmt(const CanFrame& frame, int node, NmtCommand& command) noexcept {
  if (frame.error || frame.id != kNmtId || frame.length != 2) return false;
  if (frame.data[1] != 0 && frame.data[1] != node) return false;
  const auto requested = static_cast<NmtCommand>(frame.data[0]);
  switch (requested) {
    case NmtCommand::kStart:
    case NmtCommand::kStop:
    case NmtCommand::kEnterPreOperational:
    case NmtCommand::kResetNode:
    case NmtCommand::kResetCommunication:
      command = requested;
      return true;
  }
  return false;
}

CanFrame sdo_read_request(int node, ObjectId object) noexcept {
  return sdo_frame(sdo_client_id(node), kReadRequest, object, 0);
}

CanFrame sdo_write_request(int node, ObjectId object, std::uint32_t value, int size) noexcept {
  return sdo_frame(sdo_client_id(node), with_size(kWriteExpedited, size), object, value);
}

CanFrame sdo_client_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept {
  return sdo_frame(sdo_client_id(node), kAbort, object, abort_code);
}

SdoMessage decode_sdo_reply(const CanFrame& frame) noexcept {
  if (frame.length != 8) return {};
  if (frame.data[0] == kAbort) return message(SdoKind::kAbort, frame, 4);
  if (frame.data[0] == kWriteReply) return message(SdoKind::kDownload, frame, 0);
  return decode_value(SdoKind::kUpload, frame, kReadReplyExpedited, kReadReplyNoSize);
}

SdoMessage decode_sdo_request(const CanFrame& frame) noexcept {
  if (frame.length != 8) return {};
  if (frame.data[0] == kAbort) return message(SdoKind::kAbort, frame, 4);
  if (frame.data[0] == kReadRequest) return message(SdoKind::kUpload, frame, 0);
  return decode_value(SdoKind::kDownload, frame, kWriteExpedited, kWriteNoSize);
}

CanFrame sdo_read_reply(int node, ObjectId object, std::uint32_t value, int size) noexcept {
  return sdo_frame(sdo_server_id(node), with_size(kReadReplyExpedited, size), object, value);
}

CanFrame sdo_write_reply(int node, ObjectId object) noexcept {
  return sdo_frame(sdo_server_id(node), kWriteReply, object, 0);
}

CanFrame sdo_server_abort(int node, ObjectId object, std::uint32_t abort_code) noexcept {
  return sdo_frame(sdo_server_id(node), kAbort, object, abort_code);
}

CanFrame emergency_frame(int node, const Emergency& emergency) noexcept {
  CanFrame frame;
  frame.id = emcy_id(node);
  frame.length = 8;
  put_le(&frame.data[0], emergency.code, 2);
  frame.data[2] = emergency.error_register;
  return frame;
}

bool decode_emergency(const CanFrame& frame, Emergency& emergency) noexcept {
  if (frame.length != 8) return false;
  emergency.code = static_cast<std::uint16_t>(get_le(&frame.data[0], 2));
  emergency.error_register = frame.data[2];
  return true;
}

}  // namespace sprung::canopen
