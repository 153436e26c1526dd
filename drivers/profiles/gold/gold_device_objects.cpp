#include "drivers/profiles/gold/gold_device_objects.h"

#include "drivers/canopen/eds.h"
#include "drivers/canopen/objects.h"
#include "sprung_embedded/gold_eds_text.h"

namespace sprung::sim {

ObjectDictionary gold_dictionary(const GoldCommissioning& commissioning) {
  const std::vector<ObjectValue> values = {
      {{canopen::kIdentity, 3}, commissioning.revision},
      {{canopen::kIdentity, 4}, commissioning.serial},
      {{canopen::kRatedCurrent, 0}, commissioning.rated_current_mA},
      {{canopen::kRatedTorque, 0}, commissioning.rated_torque_mNm},
      {{canopen::kMaxMotorSpeed, 0}, commissioning.max_motor_speed_rpm},
      {{canopen::kSupplyVoltage, 0}, commissioning.supply_mV},
  };
  return ObjectDictionary(canopen::parse_eds(gold_eds_text(), "gold.eds", commissioning.node), values);
}

}  // namespace sprung::sim
