#include "drivers/canopen/sdo_aborts.h"

#include <gtest/gtest.h>

#include <set>
#include <string>

namespace sprung::canopen {
namespace {

struct SdoAbortsRow {
  std::uint32_t named;
  std::uint32_t code;
  const char* text;
};

// Codes typed by hand from facts canopen 1.4.
const SdoAbortsRow kSdoAbortsRows[] = {
    {kAbortToggle, 0x05030000, "toggle bit wrong"},
    {kAbortTimeout, 0x05040000, "time-out"},
    {kAbortCommand, 0x05040001, "bad command specifier"},
    {kAbortBlockSize, 0x05040002, "bad block size"},
    {kAbortBlockSequence, 0x05040003, "bad block sequence number"},
    {kAbortBlockCrc, 0x05040004, "bad block checksum"},
    {kAbortMemory, 0x05040005, "out of memory"},
    {kAbortAccess, 0x06010000, "access not supported"},
    {kAbortWriteOnly, 0x06010001, "read of a write-only object"},
    {kAbortReadOnly, 0x06010002, "write of a read-only object"},
    {kAbortNoObject, 0x06020000, "no such object"},
    {kAbortNotMappable, 0x06040041, "object cannot be mapped"},
    {kAbortMapTooLong, 0x06040042, "mapping exceeds the PDO's length"},
    {kAbortParameter, 0x06040043, "parameter incompatible"},
    {kAbortInternal, 0x06040047, "internally incompatible"},
    {kAbortHardware, 0x06060000, "hardware error"},
    {kAbortLength, 0x06070010, "length or type mismatch"},
    {kAbortTooLong, 0x06070012, "value too long"},
    {kAbortTooShort, 0x06070013, "value too short"},
    {kAbortNoSub, 0x06090011, "no such sub-index"},
    {kAbortRange, 0x06090030, "value out of range"},
    {kAbortTooHigh, 0x06090031, "value too high"},
    {kAbortTooLow, 0x06090032, "value too low"},
    {kAbortMaxBelowMin, 0x06090036, "maximum below minimum"},
    {kAbortResource, 0x060A0023, "resource not available"},
    {kAbortGeneral, 0x08000000, "general error"},
    {kAbortStore, 0x08000020, "cannot store"},
    {kAbortLocalControl, 0x08000021, "cannot store: local control"},
    {kAbortDeviceState, 0x08000022, "not in this device state"},
    {kAbortNoDictionary, 0x08000023, "no object dictionary"},
    {kAbortNoData, 0x08000024, "no data"},
    {kAbortMaxonNmtState, 0x0F00FFC0, "wrong NMT state (maxon)"},
    {kAbortMaxonCommand, 0x0F00FFBF, "bad command (maxon)"},
    {kAbortMaxonPassword, 0x0F00FFBE, "wrong password (maxon)"},
    {kAbortMaxonServiceMode, 0x0F00FFBC, "not in service mode (maxon)"},
    {kAbortMaxonNodeId, 0x0F00FFB9, "wrong node id (maxon)"},
};

TEST(AbortText, EveryCodeOfTheFactsHasItsNameAndItsOwnText) {
  std::set<std::string> texts;
  for (const SdoAbortsRow& row : kSdoAbortsRows) {
    EXPECT_EQ(row.named, row.code) << row.text;
    EXPECT_STREQ(abort_text(row.code), row.text);
    EXPECT_TRUE(texts.insert(abort_text(row.code)).second) << row.text;
  }
}

TEST(AbortText, OthersAreUnknown) {
  for (const std::uint32_t code : {0U, 0x12345678U, 0x05040006U, 0xFFFFFFFFU})
    EXPECT_STREQ(abort_text(code), "unknown abort code");
}

}  // namespace
}  // namespace sprung::canopen
