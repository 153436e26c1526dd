#include "drivers/canopen/sdo_aborts.h"

namespace sprung::canopen {
namespace {

struct AbortText {
  std::uint32_t code;
  const char* text;
};

constexpr AbortText kTexts[] = {
    {kAbortToggle, "toggle bit wrong"},
    {kAbortTimeout, "time-out"},
    {kAbortCommand, "bad command specifier"},
    {kAbortBlockSize, "bad block size"},
    {kAbortBlockSequence, "bad block sequence number"},
    {kAbortBlockCrc, "bad block checksum"},
    {kAbortMemory, "out of memory"},
    {kAbortAccess, "access not supported"},
    {kAbortWriteOnly, "read of a write-only object"},
    {kAbortReadOnly, "write of a read-only object"},
    {kAbortNoObject, "no such object"},
    {kAbortNotMappable, "object cannot be mapped"},
    {kAbortMapTooLong, "mapping exceeds the PDO's length"},
    {kAbortParameter, "parameter incompatible"},
    {kAbortInternal, "internally incompatible"},
    {kAbortHardware, "hardware error"},
    {kAbortLength, "length or type mismatch"},
    {kAbortTooLong, "value too long"},
    {kAbortTooShort, "value too short"},
    {kAbortNoSub, "no such sub-index"},
    {kAbortRange, "value out of range"},
    {kAbortTooHigh, "value too high"},
    {kAbortTooLow, "value too low"},
    {kAbortMaxBelowMin, "maximum below minimum"},
    {kAbortResource, "resource not available"},
    {kAbortGeneral, "general error"},
    {kAbortStore, "cannot store"},
    {kAbortLocalControl, "cannot store: local control"},
    {kAbortDeviceState, "not in this device state"},
    {kAbortNoDictionary, "no object dictionary"},
    {kAbortNoData, "no data"},
    {kAbortMaxonNmtState, "wrong NMT state (maxon)"},
    {kAbortMaxonCommand, "bad command (maxon)"},
    {kAbortMaxonPassword, "wrong password (maxon)"},
    {kAbortMaxonServiceMode, "not in service mode (maxon)"},
    {kAbortMaxonNodeId, "wrong node id (maxon)"},
};

}  // namespace

const char* abort_text(std::uint32_t abort_code) noexcept {
  for (const AbortText& entry : kTexts) {
    if (entry.code == abort_code) return entry.text;
  }
  return "unknown abort code";
}

}  // namespace sprung::canopen
