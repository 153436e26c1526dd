#include "drivers/bridge/foreign_master_watch.h"

#include "drivers/canopen/protocol.h"

namespace sprung {

const char* text(MasterFrame kind) noexcept {
  switch (kind) {
    case MasterFrame::kHeartbeat:
      return "heartbeat of node 127";
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

MasterFrame master_frame(const CanFrame& frame, bool ours) noexcept {
  if (frame.error || frame.remote) return MasterFrame::kNone;
  if (frame.id == canopen::kNmtId) return MasterFrame::kNmt;
  if (frame.id == canopen::kSyncId) return MasterFrame::kSync;
  if (frame.id == canopen::heartbeat_id(canopen::kBridgeNode)) return MasterFrame::kHeartbeat;
  // CiA 301's predefined identifiers: RPDO 1 to 4 are 0x200, 0x300, 0x400, 0x500 + node.
  const std::uint32_t function = frame.id & ~0x7FU;
  const bool set_point = ours && function >= 0x200 && function <= 0x500 && function % 0x100 == 0;
  return set_point ? MasterFrame::kSetPoint : MasterFrame::kNone;
}

void ForeignMasterWatch::receive(int bus, const CanFrame& frame, bool ours) noexcept {
  const MasterFrame kind = master_frame(frame, ours);
  if (kind == MasterFrame::kNone || kind == MasterFrame::kHeartbeat) return;
  ++commands_;
  const auto& config = robot_.buses[bus];
  fault_.cause = SafetyCause::kForeignMaster;
  print(fault_.detail, "another master commands on bus %s (%s): %s 0x%03X; stop it, then sprung clear",
        config.name.c_str(), config.can.c_str(), text(kind), frame.id);
}

}  // namespace sprung
