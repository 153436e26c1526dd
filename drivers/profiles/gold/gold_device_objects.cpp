#include "drivers/profiles/gold/gold_device_objects.h"

#include "drivers/canopen/objects.h"
#include "drivers/canopen/protocol.h"
#include "drivers/profiles/gold/gold_units.h"

namespace sprung::sim {
namespace {

using Table = std::vector<ObjectEntry>;
constexpr auto kRo = Access::kReadOnly;
constexpr auto kRw = Access::kReadWrite;
constexpr auto kNo = Mappable::kNo;
constexpr auto kR = Mappable::kReceive;
constexpr auto kT = Mappable::kTransmit;
constexpr auto kU8 = ObjectType::kU8;
constexpr auto kU16 = ObjectType::kU16;
constexpr auto kU32 = ObjectType::kU32;
constexpr auto kI8 = ObjectType::kI8;
constexpr auto kI16 = ObjectType::kI16;
constexpr auto kI32 = ObjectType::kI32;
/// Bits 7 and 9 of 0x6502: cyclic synchronous position and torque.
constexpr std::int64_t kModes = (1 << 7) | (1 << 9);

void add(Table& table, int index, int sub, ObjectType type, Access access, Mappable mappable,
         std::int64_t initial, std::int64_t low = kNoLow, std::int64_t high = kNoHigh) {
  const canopen::ObjectId id{static_cast<std::uint16_t>(index), static_cast<std::uint8_t>(sub)};
  table.push_back({id, type, access, mappable, initial, low, high});
}

void add_communication(Table& table, const GoldCommissioning& gold) {
  add(table, canopen::kDeviceType, 0, kU32, kRo, kNo, 0x00020192);
  add(table, canopen::kErrorRegister, 0, kU8, kRo, kT, 0);
  add(table, canopen::kErrorHistory, 0, kU8, kRw, kNo, 0, 0, 0);  // only 0 may be written: it clears
  for (int sub = 1; sub <= kErrorHistoryLength; ++sub)
    add(table, canopen::kErrorHistory, sub, kU32, kRo, kNo, 0);
  add(table, canopen::kSyncCobId, 0, kU32, kRw, kNo, canopen::kSyncId, 0x80, 0x80);
  add(table, canopen::kSyncPeriod, 0, kU32, kRw, kNo, 0);
  add(table, canopen::kEmergencyCobId, 0, kU32, kRo, kNo, canopen::emcy_id(gold.node));
  add(table, canopen::kHeartbeatConsumer, 0, kU8, kRo, kNo, 2);
  add(table, canopen::kHeartbeatConsumer, 1, kU32, kRw, kNo, 0, 0, 0x007FFFFF);
  add(table, canopen::kHeartbeatConsumer, 2, kU32, kRw, kNo, 0, 0, 0x007FFFFF);
  add(table, canopen::kHeartbeatProducer, 0, kU16, kRw, kNo, 0);
  add(table, canopen::kIdentity, 0, kU8, kRo, kNo, 4);
  add(table, canopen::kIdentity, 1, kU32, kRo, kNo, gold.vendor);
  add(table, canopen::kIdentity, 2, kU32, kRo, kNo, gold.product);
  add(table, canopen::kIdentity, 3, kU32, kRo, kNo, gold.revision);
  add(table, canopen::kIdentity, 4, kU32, kRo, kNo, gold.serial);
  add(table, canopen::kErrorBehaviour, 0, kU8, kRo, kNo, 1);
  add(table, canopen::kErrorBehaviour, 1, kU8, kRw, kNo, 1, 1,
      2);  // 1 = the NMT state stays; 0 is not simulated
}

/// All valid at default, event driven; RPDO1 6040, TPDO1 6041, and the binary interpreter in the second of
/// each.
void add_pdos(Table& table, int node) {
  for (int n = 0; n < canopen::kPdoCount; ++n) {
    const std::int64_t first_receive = n == 0 ? 0x60400010 : (n == 1 ? 0x20120040 : 0);
    const std::int64_t first_transmit = n == 0 ? 0x60410010 : (n == 1 ? 0x20130040 : 0);
    add(table, canopen::kRpdoCommunication + n, 0, kU8, kRo, kNo, 2);
    add(table, canopen::kRpdoCommunication + n, 1, kU32, kRw, kNo, canopen::rpdo_id(n, node));
    add(table, canopen::kRpdoCommunication + n, 2, kU8, kRw, kNo, canopen::kTypeEvent);
    add(table, canopen::kTpdoCommunication + n, 0, kU8, kRo, kNo, 5);
    add(table, canopen::kTpdoCommunication + n, 1, kU32, kRw, kNo, canopen::tpdo_id(n, node));
    add(table, canopen::kTpdoCommunication + n, 2, kU8, kRw, kNo, canopen::kTypeEvent);
    add(table, canopen::kTpdoCommunication + n, 3, kU16, kRw, kNo, 0);
    add(table, canopen::kTpdoCommunication + n, 5, kU16, kRw, kNo, 0);
    add(table, canopen::kRpdoMapping + n, 0, kU8, kRw, kNo, first_receive == 0 ? 0 : 1);
    add(table, canopen::kTpdoMapping + n, 0, kU8, kRw, kNo, first_transmit == 0 ? 0 : 1);
    for (int sub = 1; sub <= 8; ++sub) {
      add(table, canopen::kRpdoMapping + n, sub, kU32, kRw, kNo, sub == 1 ? first_receive : 0);
      add(table, canopen::kTpdoMapping + n, sub, kU32, kRw, kNo, sub == 1 ? first_transmit : 0);
    }
  }
  add(table, 0x2012, 0, ObjectType::kU64, Access::kWriteOnly, kR,
      0);  // binary interpreter: accepted, not interpreted
  add(table, 0x2013, 0, ObjectType::kU64, kRo, kT, 0);
}

void add_power(Table& table) {
  add(table, canopen::kAbortConnectionOption, 0, kI16, kRw, kNo, 1, 0, 3);
  add(table, canopen::kErrorCode, 0, kU16, kRo, kNo, 0);
  add(table, canopen::kControlWord, 0, kU16, kRw, kR, 0);
  add(table, canopen::kStatusWord, 0, kU16, kRo, kT, 0);
  add(table, canopen::kQuickStopOption, 0, kI16, kRw, kNo, 2, 0, 2);
  add(table, canopen::kShutdownOption, 0, kI16, kRw, kNo, 0, 0, 1);
  add(table, canopen::kDisableOption, 0, kI16, kRw, kNo, 0, 0, 1);
  add(table, canopen::kHaltOption, 0, kI16, kRw, kNo, 2, 1, 2);
  add(table, canopen::kFaultReactionOption, 0, kI16, kRw, kNo, 2, 0, 2);
  add(table, canopen::kMode, 0, kI8, kRw, kR, 0, -128, 10);
  add(table, canopen::kModeDisplay, 0, kI8, kRo, kT, 0);
  add(table, canopen::kSupportedModes, 0, kU32, kRo, kNo, kModes);
}

void add_motion(Table& table, const GoldCommissioning& gold) {
  add(table, canopen::kPositionActual, 0, kI32, kRo, kT, 0);
  add(table, kVelocityActual, 0, kI32, kRo, kT, 0);
  add(table, canopen::kTargetTorque, 0, kI16, kRw, kR, 0);
  add(table, canopen::kMaxTorque, 0, kU16, kRw, kNo, 50000);
  add(table, canopen::kMaxCurrent, 0, kU16, kRw, kNo, 50000);
  add(table, kTorqueDemand, 0, kI16, kRo, kT, 0);
  add(table, canopen::kRatedCurrent, 0, kU32, kRw, kNo, gold.rated_current_mA);
  add(table, canopen::kRatedTorque, 0, kU32, kRw, kNo, gold.rated_torque_mNm);
  add(table, canopen::kTorqueActual, 0, kI16, kRo, kT, 0);
  add(table, canopen::kCurrentActual, 0, kI16, kRo, kT, 0);
  add(table, canopen::kSupplyVoltage, 0, kU32, kRo, kT, gold.supply_mV);
  add(table, canopen::kTargetPosition, 0, kI32, kRw, kR, 0);
  add(table, canopen::kMaxMotorSpeed, 0, kU32, kRw, kNo, gold.max_motor_speed_rpm);
  add(table, canopen::kTorqueOffset, 0, kI16, kRw, kR, 0);
  add(table, canopen::kInterpolationPeriod, 0, kU8, kRo, kNo, 2);
  add(table, canopen::kInterpolationPeriod, 1, kU8, kRw, kNo, 1, 1, 255);
  add(table, canopen::kInterpolationPeriod, 2, kI8, kRw, kNo, -3, -6, -2);
  add(table, kFollowingError, 0, kI32, kRo, kT, 0);
  add(table, canopen::kPositionGains, 0, kU8, kRo, kNo, 2);
  add(table, canopen::kPositionGains, gold::kStiffnessSub, kU32, kRw, kNo, 0);
  add(table, canopen::kPositionGains, gold::kDampingSub, kU32, kRw, kNo, 0);
}

}  // namespace

ObjectDictionary gold_dictionary(const GoldCommissioning& commissioning) {
  Table table;
  add_communication(table, commissioning);
  add_pdos(table, commissioning.node);
  add_power(table);
  add_motion(table, commissioning);
  return ObjectDictionary(std::move(table), {0x0005});  // its one dummy: 8 bits
}

}  // namespace sprung::sim
