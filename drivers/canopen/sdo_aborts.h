#pragma once
/// Why an SDO transfer was ended: abort codes (CiA 301 table 22, facts canopen 1.4) and their texts. Pure.
#include <cstdint>

namespace sprung::canopen {

inline constexpr std::uint32_t kAbortToggle = 0x05030000;
inline constexpr std::uint32_t kAbortTimeout = 0x05040000;
inline constexpr std::uint32_t kAbortCommand = 0x05040001;
inline constexpr std::uint32_t kAbortBlockSize = 0x05040002;
inline constexpr std::uint32_t kAbortBlockSequence = 0x05040003;
inline constexpr std::uint32_t kAbortBlockCrc = 0x05040004;
inline constexpr std::uint32_t kAbortMemory = 0x05040005;
inline constexpr std::uint32_t kAbortAccess = 0x06010000;
inline constexpr std::uint32_t kAbortWriteOnly = 0x06010001;
inline constexpr std::uint32_t kAbortReadOnly = 0x06010002;
inline constexpr std::uint32_t kAbortNoObject = 0x06020000;
inline constexpr std::uint32_t kAbortNotMappable = 0x06040041;
inline constexpr std::uint32_t kAbortMapTooLong = 0x06040042;
inline constexpr std::uint32_t kAbortParameter = 0x06040043;
inline constexpr std::uint32_t kAbortInternal = 0x06040047;
inline constexpr std::uint32_t kAbortHardware = 0x06060000;
inline constexpr std::uint32_t kAbortLength = 0x06070010;
inline constexpr std::uint32_t kAbortTooLong = 0x06070012;
inline constexpr std::uint32_t kAbortTooShort = 0x06070013;
inline constexpr std::uint32_t kAbortNoSub = 0x06090011;
inline constexpr std::uint32_t kAbortRange = 0x06090030;
inline constexpr std::uint32_t kAbortTooHigh = 0x06090031;
inline constexpr std::uint32_t kAbortTooLow = 0x06090032;
inline constexpr std::uint32_t kAbortMaxBelowMin = 0x06090036;
inline constexpr std::uint32_t kAbortResource = 0x060A0023;
inline constexpr std::uint32_t kAbortGeneral = 0x08000000;
inline constexpr std::uint32_t kAbortStore = 0x08000020;
inline constexpr std::uint32_t kAbortLocalControl = 0x08000021;
inline constexpr std::uint32_t kAbortDeviceState = 0x08000022;
inline constexpr std::uint32_t kAbortNoDictionary = 0x08000023;
inline constexpr std::uint32_t kAbortNoData = 0x08000024;

// maxon's own (EPOS family).
inline constexpr std::uint32_t kAbortMaxonNmtState = 0x0F00FFC0;
inline constexpr std::uint32_t kAbortMaxonCommand = 0x0F00FFBF;
inline constexpr std::uint32_t kAbortMaxonPassword = 0x0F00FFBE;
inline constexpr std::uint32_t kAbortMaxonServiceMode = 0x0F00FFBC;
inline constexpr std::uint32_t kAbortMaxonNodeId = 0x0F00FFB9;

/// What an abort code means, e.g. "no such object"; "unknown abort code" for others. Static text.
const char* abort_text(std::uint32_t abort_code) noexcept;

}  // namespace sprung::canopen
