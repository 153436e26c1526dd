#pragma once
/// What the bridge does to a drive before it may run, as a list of SDO transfers: verify identity, power off,
/// write every setting and read it back, remap every PDO (procedure of facts canopen 1.5) and read that back
/// too. Start-up only.
#include <cstdint>
#include <vector>

#include "drivers/profiles/drive_profile.h"
#include "robots/robot_config.h"

namespace sprung {

struct BootStep {
  enum class Kind : std::int8_t {
    kVerify,          ///< read; must equal value
    kWrite,           ///< write only
    kWriteAndVerify,  ///< write, read back; must equal value
    kShowMode,        ///< read the mode display: its PDO comes on change only
  };
  Kind kind = Kind::kVerify;
  DriveSetting setting;
};

std::vector<BootStep> make_boot_script(const IdentityConfig& identity, const DriveProfile& profile, int node);

}  // namespace sprung
