#pragma once
/// CANopen on the wire (CiA 301), whole: for the bridge, for the simulated drives and for tools alike. Pure
/// values; all multi-byte numbers are little-endian. Not here: TIME, which nothing of sprung needs.
#include "drivers/canopen/emergency.h"
#include "drivers/canopen/lss_frames.h"
#include "drivers/canopen/nmt.h"
#include "drivers/canopen/pdo_words.h"
#include "drivers/canopen/sdo_aborts.h"
#include "drivers/canopen/sdo_frames.h"
#include "drivers/canopen/wire.h"
