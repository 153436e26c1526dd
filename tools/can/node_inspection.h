#pragma once
/// Looks at nodes over SDO without changing anything: who is there, and what one says of itself. Shell.
#include <string>
#include <vector>

#include "tools/can/decode/bus_description.h"
#include "tools/can/sdo_session.h"

namespace sprung {

/// Whether a master is at work: SYNC or the bridge's heartbeat within 200 ms.
bool bridge_drives(CanBus& bus);
/// @throws std::runtime_error where one is, unless it is forced.
void refuse_while_driven(CanBus& bus, bool force);

/// Whoever answers a read of its device type (0x1000), and how many answers came: two of one id are two
/// devices.
struct FoundNode {
  int node = 0;
  int answers = 0;
  std::uint32_t device_type = 0;
};
/// Asks all 127 ids, some at a time so that no queue is filled; half a second.
std::vector<FoundNode> scan_nodes(CanBus& bus);

struct ReportLine {
  std::string name;
  std::string text;
};
/// Name, identity, NMT state, state word, mode, supply, error register and history: what the node has of it.
/// @param node its description; eds and actuator may be missing. @throws SdoFailed when it does not answer at
/// all.
std::vector<ReportLine> inspect_node(SdoSession& session, const cantools::NodeDescription& node,
                                     const DriveTiming& timing);
/// Name (0x1008), vendor and so on, short: what is there of it.
std::vector<ReportLine> identify_node(SdoSession& session, const canopen::Eds* eds);

}  // namespace sprung
