#include "drivers/canopen/nmt.h"

namespace sprung::canopen {
namespace {

constexpr std::uint8_t kHeartbeatToggle = 0x80;

}  // namespace

const char* nmt_text(NmtCommand command) noexcept {
  switch (command) {
    case NmtCommand::kStart:
      return "start";
    case NmtCommand::kStop:
      return "stop";
    case NmtCommand::kEnterPreOperational:
      return "enter pre-operational";
    case NmtCommand::kResetNode:
      return "reset node";
    case NmtCommand::kResetCommunication:
      return "reset communication";
  }
  return "unknown command";
}

const char* nmt_text(NmtState state) noexcept {
  switch (state) {
    case NmtState::kBootUp:
      return "boot-up";
    case NmtState::kStopped:
      return "stopped";
    case NmtState::kOperational:
      return "operational";
    case NmtState::kPreOperational:
      return "pre-operational";
    case NmtState::kUnknown:
      break;
  }
  return "unknown";
}

CanFrame nmt_frame(NmtCommand command, int node) noexcept {
  CanFrame frame;
  frame.id = kNmtId;
  frame.length = 2;
  frame.data[0] = static_cast<std::uint8_t>(command);
  frame.data[1] = static_cast<std::uint8_t>(node);
  return frame;
}

bool decode_nmt(const CanFrame& frame, int node, NmtCommand& command) noexcept {
  if (frame.error || frame.remote || frame.id != kNmtId || frame.length != 2) return false;
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

CanFrame heartbeat_frame(int node, NmtState state) noexcept { return guard_reply(node, {state, false}); }

NmtState heartbeat_state(const CanFrame& frame) noexcept { return decode_guard_reply(frame).state; }

CanFrame guard_request(int node) noexcept {
  CanFrame frame;
  frame.id = heartbeat_id(node);
  frame.length = 1;
  frame.remote = true;
  return frame;
}

bool is_guard_request(const CanFrame& frame, int node) noexcept {
  return frame.remote && !frame.error && frame.id == heartbeat_id(node);
}

CanFrame guard_reply(int node, const GuardReply& reply) noexcept {
  CanFrame frame;
  frame.id = heartbeat_id(node);
  frame.length = 1;
  frame.data[0] = static_cast<std::uint8_t>(reply.state);
  if (reply.toggle) frame.data[0] |= kHeartbeatToggle;
  return frame;
}

GuardReply decode_guard_reply(const CanFrame& frame) noexcept {
  if (frame.length != 1 || frame.remote || frame.error) return {};
  const auto state = static_cast<NmtState>(frame.data[0] & ~kHeartbeatToggle);
  switch (state) {
    case NmtState::kBootUp:
    case NmtState::kStopped:
    case NmtState::kOperational:
    case NmtState::kPreOperational:
      return {state, (frame.data[0] & kHeartbeatToggle) != 0};
    case NmtState::kUnknown:
      break;
  }
  return {};
}

}  // namespace sprung::canopen
