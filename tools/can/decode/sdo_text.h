#pragma once
/// One SDO frame as a line of text. Pure.
#include <string>

#include "tools/can/decode/sdo_follower.h"

namespace sprung::cantools {

/// @param object "0x6064:00 position actual", "" where it is not known. @param value with its unit, "" where
/// there is none.
std::string sdo_text(const SdoEvent& event, bool reply, const std::string& object, const std::string& value);

}  // namespace sprung::cantools
