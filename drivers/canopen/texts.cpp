// Texts of abort and emergency codes: CiA 301 table 22 and table 21, CiA 402; facts canopen 1.4 and 2.5.
#include "drivers/canopen/protocol.h"

namespace sprung::canopen {
namespace {

struct CodeText {
  std::uint32_t code;
  const char* text;
};

constexpr CodeText kAborts[] = {
    {kAbortToggle, "toggle bit wrong"},
    {kAbortTimeout, "time-out"},
    {kAbortCommand, "bad command specifier"},
    {kAbortAccess, "access not supported"},
    {kAbortWriteOnly, "read of a write-only object"},
    {kAbortReadOnly, "write of a read-only object"},
    {kAbortNoObject, "no such object"},
    {kAbortNotMappable, "object cannot be mapped"},
    {kAbortMapTooLong, "mapping exceeds the PDO's length"},
    {kAbortParameter, "parameter incompatible"},
    {kAbortHardware, "hardware error"},
    {kAbortLength, "length or type mismatch"},
    {kAbortTooLong, "value too long"},
    {kAbortTooShort, "value too short"},
    {kAbortNoSub, "no such sub-index"},
    {kAbortRange, "value out of range"},
    {kAbortTooHigh, "value too high"},
    {kAbortTooLow, "value too low"},
    {kAbortResource, "resource not available"},
    {kAbortGeneral, "general error"},
    {kAbortStore, "cannot store"},
    {kAbortDeviceState, "not in this device state"},
};

constexpr CodeText kEmergencies[] = {
    {0x0000, "no error"},
    {0x2310, "over-current"},
    {0x3210, "supply over-voltage"},
    {0x3220, "supply under-voltage"},
    {0x4210, "over-temperature"},
    {0x5113, "logic supply low"},
    {0x6320, "parameter error"},
    {0x7320, "position sensor"},
    {0x8110, "CAN frames lost"},
    {0x8120, "CAN error passive"},
    {0x8130, "heartbeat lost"},
    {0x8140, "recovered from bus off"},
    {0x8210, "PDO too short"},
    {0x8611, "following error"},
    {0x81FD, "bus off"},
};

/// Name of the class, by the high byte's upper digit (CiA 301 table 21).
constexpr const char* kClasses[16] = {
    "no error",        "generic error", "current",       "voltage",        "temperature", "device hardware",
    "device software", "extra modules", "communication", "external",       "reserved",    "reserved",
    "reserved",        "reserved",      "reserved",      "device specific"};

}  // namespace

const char* abort_text(std::uint32_t abort_code) noexcept {
  for (const CodeText& entry : kAborts) {
    if (entry.code == abort_code) return entry.text;
  }
  return "unknown abort code";
}

const char* emergency_text(std::uint16_t code) noexcept {
  for (const CodeText& entry : kEmergencies) {
    if (entry.code == code) return entry.text;
  }
  return kClasses[code >> 12];
}

}  // namespace sprung::canopen
