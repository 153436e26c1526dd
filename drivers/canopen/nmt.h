#pragma once
/// Network management: NMT commands, boot-up, heartbeat and node guarding (CiA 301, facts canopen 1.2). Pure.
#include <cstdint>

#include "drivers/canopen/wire.h"

namespace sprung::canopen {

enum class NmtCommand : std::uint8_t {
  kStart = 0x01,
  kStop = 0x02,
  kEnterPreOperational = 0x80,
  kResetNode = 0x81,
  kResetCommunication = 0x82,
};

/// State byte of the heartbeat; kBootUp is sent once, when the node comes up.
enum class NmtState : std::uint8_t {
  kBootUp = 0x00,
  kStopped = 0x04,
  kOperational = 0x05,
  kPreOperational = 0x7F,
  kUnknown = 0xFF,  ///< none of the above, or nothing heard yet
};

/// For people, e.g. "reset communication", "pre-operational". Static text.
const char* nmt_text(NmtCommand command) noexcept;
const char* nmt_text(NmtState state) noexcept;

/// @param node 1..127, 0 = all nodes.
CanFrame nmt_frame(NmtCommand command, int node) noexcept;
/// @return false when it is no NMT frame, its command is unknown, or it is for another node.
bool decode_nmt(const CanFrame& frame, int node, NmtCommand& command) noexcept;

CanFrame heartbeat_frame(int node, NmtState state) noexcept;
/// @return kUnknown for a frame of wrong length or value; bit 7 (node guarding) is ignored.
NmtState heartbeat_state(const CanFrame& frame) noexcept;

/// What a node answers when it is guarded.
struct GuardReply {
  NmtState state = NmtState::kUnknown;
  bool toggle = false;  ///< false in the first answer after boot-up, then alternating
};

/// The master's question: a remote frame of one byte.
CanFrame guard_request(int node) noexcept;
bool is_guard_request(const CanFrame& frame, int node) noexcept;
CanFrame guard_reply(int node, const GuardReply& reply) noexcept;
/// @return state kUnknown when `frame` is none (wrong length or value).
GuardReply decode_guard_reply(const CanFrame& frame) noexcept;

}  // namespace sprung::canopen
