#pragma once
/// What the bridge does to a node before it may run, as a list of SDO transfers: verify identity and
/// firmware, power off, verify modes, write every setting and read it back, remap every PDO (procedure of
/// facts canopen 1.5) and read that back too. Start-up only.
#include <cstdint>
#include <vector>

#include "drivers/profiles/drive_profile.h"
#include "robots/robot_config.h"

namespace sprung {

struct BootStep {
  enum class Kind : std::int8_t {
    kVerify,          ///< read; must equal value
    kFirmware,        ///< read; must be one that `device` knows, or one that does with the standard alone
    kRequireBits,     ///< read; must have every bit of value
    kWrite,           ///< write only
    kAdopt,           ///< read what there was, write, read back; must equal value
    kAdoptInstead,    ///< the same, only where the heartbeat consumer before it was refused
    kWriteAndVerify,  ///< write, read back; must equal value
    kShowMode,        ///< read the mode display: its PDO comes on change only
    kWatched,         ///< read; must be there: robot.yaml stops the robot by it
  };
  Kind kind = Kind::kVerify;
  DriveSetting setting;
  KnownDevice device{};  ///< kFirmware
};

/// @param has_power a drive: its power is taken away first, and its mode display is read at the end.
/// @param watched an object that a limit of robot.yaml is about; index 0: there is none.
std::vector<BootStep> make_boot_script(const IdentityConfig& identity, const NodeProfile& profile, int node,
                                       bool has_power, const ReadingConfig& watched = {});

}  // namespace sprung
