#pragma once
/// Objects as people type them: "0x6064", "6410:01", "position actual". Pure.
#include <string>

#include "drivers/canopen/eds.h"

namespace sprung::cantools {

/// @param eds nullptr: numbers only. Numbers are hexadecimal, with or without 0x. A name may be shortened to
/// a part that only one object has; case does not matter.
/// @throws std::invalid_argument naming the candidates, or how to write an object.
canopen::ObjectId find_object(const std::string& text, const canopen::Eds* eds);

}  // namespace sprung::cantools
