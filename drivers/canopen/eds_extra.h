#pragma once
/// What a text beside an EDS adds to its objects. For eds.cpp.
#include "drivers/canopen/eds.h"

namespace sprung::canopen {

/// Sets unit and PDO directions of the objects whose sections `extra` has.
/// @throws EdsError on sections that are no object of the EDS, on other keys, on directions that contradict
/// it.
void apply_extra(const IniText& extra, Eds& eds);

}  // namespace sprung::canopen
