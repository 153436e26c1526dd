#pragma once
/// An encoder card's sample as what it measures: one field a channel, and the counter. Pure; allocates.
#include <vector>

#include "drivers/canopen/pdo_words.h"
#include "tools/can/decode/bus_description.h"
#include "tools/can/decode/decoded_field.h"

namespace sprung::cantools {

/// Channels that robot.yaml gives to an actuator also have the position (rad, at the gear's output, within
/// half a turn of 0), as the bridge takes it. @param object that the card sends.
/// @return empty where `node` is no card, or the frame not its sample.
std::vector<DecodedField> card_fields(const NodeDescription& node, canopen::ObjectId object,
                                      const CanFrame& frame);

}  // namespace sprung::cantools
