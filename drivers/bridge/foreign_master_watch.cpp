#include "drivers/bridge/foreign_master_watch.h"

#include "drivers/canopen/protocol.h"

namespace sprung {

const char* text(MasterFrame kind) noexcept {
  switch (kind) {
    case MasterFrame::kHeartbeat:
      return "heartbeat of node 127";
    case MasterFrame::kAnswer:
      return "answer of node 127";
    case MasterFrame::kSync:
      return "SYNC";
    case MasterFrame::kNmt:
      return "NMT command";
    case MasterFrame::kSetPoint:
      return "set-point (RPDO)";
    case MasterFrame::kNone:
      break;
  }
  return "";
}

const char* remedy(MasterFrame kind) noexcept {
  if (kind != MasterFrame::kHeartbeat && kind != MasterFrame::kAnswer)
    return "Stop it first: another sprung up, another tool?";
  return "127 is the bridge's own id. Another sprung up or tool: stop it. A drive as it was delivered: give "
         "it "
         "an id of its own (Gold: its maker's tool; EPOS2: 0x2000 or sprung can lss), store, switch off and "
         "on";
}

MasterFrame master_frame(const CanFrame& frame, bool ours) noexcept {
  if (frame.error || frame.remote) return MasterFrame::kNone;
  if (frame.id == canopen::kNmtId) return MasterFrame::kNmt;
  if (frame.id == canopen::kSyncId) return MasterFrame::kSync;
  if (frame.id == canopen::heartbeat_id(canopen::kBridgeNode)) return MasterFrame::kHeartbeat;
  if (frame.id == canopen::sdo_server_id(canopen::kBridgeNode)) return MasterFrame::kAnswer;
  // CiA 301's predefined identifiers: RPDO 1 to 4 are 0x200, 0x300, 0x400, 0x500 + node.
  const std::uint32_t function = frame.id & ~0x7FU;
  const bool set_point = ours && function >= 0x200 && function <= 0x500 && function % 0x100 == 0;
  return set_point ? MasterFrame::kSetPoint : MasterFrame::kNone;
}

void ForeignMasterWatch::receive(int bus, const CanFrame& frame, bool ours) noexcept {
  const MasterFrame kind = master_frame(frame, ours);
  const bool commands = kind == MasterFrame::kSync || kind == MasterFrame::kNmt ||
                        kind == MasterFrame::kSetPoint;
  if (!commands) return;
  ++commands_;
  const auto& config = robot_.buses[bus];
  fault_.cause = SafetyCause::kForeignMaster;
  print(fault_.detail, "another master commands on bus %s (%s): %s 0x%03X; stop it, then sprung clear",
        config.name.c_str(), config.can.c_str(), text(kind), frame.id);
}

}  // namespace sprung
