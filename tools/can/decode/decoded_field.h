#pragma once
/// One object's value in a PDO or an SDO, for people. Pure; allocates.
#include <string>
#include <vector>

#include "drivers/canopen/pdo_words.h"
#include "tools/can/decode/bus_description.h"
#include "tools/can/decode/joint_units.h"
#include "tools/can/decode/object_value.h"

namespace sprung::cantools {

struct DecodedField {
  canopen::ObjectId object;
  std::string name;
  ObjectValue value;
  std::vector<JointValue> joint;  ///< PDOs of robot.yaml's drives and cards only
};

/// "position actual 123 counts = 0.01 rad, status word ...".
std::string fields_text(const std::vector<DecodedField>& fields);

/// An encoder card's sample as what it measures: one field a channel, and the counter.
/// Channels that robot.yaml gives to an actuator also have the position (rad, at the gear's output, within
/// half a turn of 0), as the bridge takes it. @param object that the card sends.
/// @return empty where `node` is no card, or the frame not its sample.
std::vector<DecodedField> card_fields(const NodeDescription& node, canopen::ObjectId object,
                                      const CanFrame& frame);

}  // namespace sprung::cantools
