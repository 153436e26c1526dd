#include "drivers/canopen/objects.h"

namespace sprung::canopen {
namespace {

struct NamedObject {
  std::uint16_t index;
  const char* name;
};

constexpr NamedObject kNames[] = {
    {kDeviceType, "device type"},
    {kErrorRegister, "error register"},
    {kErrorHistory, "error history"},
    {kSyncCobId, "SYNC identifier"},
    {kSyncPeriod, "SYNC period"},
    {kGuardTime, "guard time"},
    {kLifeTimeFactor, "life time factor"},
    {kStoreParameters, "store parameters"},
    {kRestoreDefaults, "restore default parameters"},
    {kEmergencyCobId, "emergency identifier"},
    {kHeartbeatConsumer, "heartbeat consumer"},
    {kHeartbeatProducer, "heartbeat producer"},
    {kIdentity, "identity"},
    {kErrorBehaviour, "error behaviour"},
    {kAbortConnectionOption, "abort connection option"},
    {kErrorCode, "error code"},
    {kControlWord, "control word"},
    {kStatusWord, "status word"},
    {kQuickStopOption, "quick stop option"},
    {kShutdownOption, "shutdown option"},
    {kDisableOption, "disable operation option"},
    {kHaltOption, "halt option"},
    {kFaultReactionOption, "fault reaction option"},
    {kMode, "mode"},
    {kModeDisplay, "mode display"},
    {kPositionActual, "position"},
    {kTargetTorque, "target torque"},
    {kMaxTorque, "max torque"},
    {kMaxCurrent, "max current"},
    {kRatedCurrent, "rated current"},
    {kRatedTorque, "rated torque"},
    {kTorqueActual, "torque"},
    {kCurrentActual, "current"},
    {kSupplyVoltage, "supply voltage"},
    {kTargetPosition, "target position"},
    {kMaxMotorSpeed, "max motor speed"},
    {kTorqueOffset, "torque offset"},
    {kInterpolationPeriod, "interpolation period"},
    {kSupportedModes, "supported modes"},
};

bool is_pdo(std::uint16_t index, std::uint16_t base) noexcept {
  return index >= base && index < base + 0x200;
}

}  // namespace

const char* object_name(std::uint16_t index) noexcept {
  for (const NamedObject& object : kNames) {
    if (object.index == index) return object.name;
  }
  if (is_pdo(index, kRpdoCommunication)) return "receive PDO settings";
  if (is_pdo(index, kRpdoMapping)) return "receive PDO map";
  if (is_pdo(index, kTpdoCommunication)) return "transmit PDO settings";
  if (is_pdo(index, kTpdoMapping)) return "transmit PDO map";
  return "object";
}

}  // namespace sprung::canopen
