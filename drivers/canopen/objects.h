#pragma once
/// Object dictionary indexes that sprung uses, each with the name it has in messages to people (CiA 301, CiA
/// 402).
#include <cstdint>

namespace sprung::canopen {

inline constexpr std::uint16_t kDeviceType = 0x1000;
inline constexpr std::uint16_t kErrorRegister = 0x1001;
inline constexpr std::uint16_t kErrorHistory = 0x1003;
inline constexpr std::uint16_t kSyncCobId = 0x1005;
inline constexpr std::uint16_t kSyncPeriod = 0x1006;       ///< us
inline constexpr std::uint16_t kGuardTime = 0x100C;        ///< ms
inline constexpr std::uint16_t kLifeTimeFactor = 0x100D;   ///< guard times until the master counts as gone
inline constexpr std::uint16_t kStoreParameters = 0x1010;  ///< :01 all; write "save"
inline constexpr std::uint16_t kRestoreDefaults = 0x1011;  ///< :01 all; write "load"
inline constexpr std::uint16_t kEmergencyCobId = 0x1014;
inline constexpr std::uint16_t kHeartbeatConsumer = 0x1016;  ///< node << 16 | ms
inline constexpr std::uint16_t kHeartbeatProducer = 0x1017;  ///< ms
inline constexpr std::uint16_t kIdentity = 0x1018;  ///< :01 vendor, :02 product, :03 revision, :04 serial
inline constexpr std::uint16_t kErrorBehaviour = 0x1029;
inline constexpr std::uint16_t kSdoServer = 0x1200;          ///< :01, :02 its identifiers
inline constexpr std::uint16_t kRpdoCommunication = 0x1400;  ///< + n, n from 0
inline constexpr std::uint16_t kRpdoMapping = 0x1600;
inline constexpr std::uint16_t kTpdoCommunication = 0x1800;
inline constexpr std::uint16_t kTpdoMapping = 0x1A00;

inline constexpr std::uint16_t kAbortConnectionOption = 0x6007;
inline constexpr std::uint16_t kErrorCode = 0x603F;
inline constexpr std::uint16_t kControlWord = 0x6040;
inline constexpr std::uint16_t kStatusWord = 0x6041;
inline constexpr std::uint16_t kQuickStopOption = 0x605A;
inline constexpr std::uint16_t kShutdownOption = 0x605B;
inline constexpr std::uint16_t kDisableOption = 0x605C;
inline constexpr std::uint16_t kHaltOption = 0x605D;
inline constexpr std::uint16_t kFaultReactionOption = 0x605E;
inline constexpr std::uint16_t kMode = 0x6060;
inline constexpr std::uint16_t kModeDisplay = 0x6061;
inline constexpr std::uint16_t kPositionActual = 0x6064;       ///< counts
inline constexpr std::uint16_t kTargetTorque = 0x6071;         ///< per mille of rated torque
inline constexpr std::uint16_t kMaxTorque = 0x6072;            ///< per mille of rated torque
inline constexpr std::uint16_t kMaxCurrent = 0x6073;           ///< per mille of rated current
inline constexpr std::uint16_t kRatedCurrent = 0x6075;         ///< mA
inline constexpr std::uint16_t kRatedTorque = 0x6076;          ///< mNm, motor side
inline constexpr std::uint16_t kTorqueActual = 0x6077;         ///< per mille of rated torque
inline constexpr std::uint16_t kCurrentActual = 0x6078;        ///< per mille of rated current (Gold)
inline constexpr std::uint16_t kSupplyVoltage = 0x6079;        ///< mV
inline constexpr std::uint16_t kTargetPosition = 0x607A;       ///< counts
inline constexpr std::uint16_t kDigitalInputs = 0x60FD;        ///< u32, a bit for each
inline constexpr std::uint16_t kMaxMotorSpeed = 0x6080;        ///< rpm
inline constexpr std::uint16_t kTorqueOffset = 0x60B2;         ///< per mille of rated torque
inline constexpr std::uint16_t kInterpolationPeriod = 0x60C2;  ///< :01 value, :02 exponent of ten, seconds
inline constexpr std::uint16_t kSupportedModes = 0x6502;

/// Name for people, e.g. "max torque"; "object" where there is none. Static text.
const char* object_name(std::uint16_t index) noexcept;

}  // namespace sprung::canopen
