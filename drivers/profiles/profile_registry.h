#pragma once
/// Every device profile that was built in: one for each folder of drivers/profiles
/// (cmake/SprungProfiles.cmake finds them).
#include <memory>
#include <string>
#include <vector>

#include "drivers/profiles/drive_profile.h"

namespace sprung {

/// What a profile's folder offers to the bridge and to tools. A folder is either a drive's or an encoder
/// card's: the other maker is nullptr.
struct ProfileKind {
  const char* name;  ///< of the folder, as robot.yaml's `profile`
  std::unique_ptr<DriveProfile> (*make_drive)(const ActuatorConfig& actuator, const DriveTiming& timing);
  std::unique_ptr<CardProfile> (*make_card)(const EncoderCardConfig& card, const DriveTiming& timing);
  const char* (*eds_text)() noexcept;  ///< text of the folder's EDS; nullptr where it has none
  /// Units and PDO directions beside it (drivers/canopen/eds.h); nullptr where there are none.
  const char* (*eds_extra_text)() noexcept = nullptr;
};

/// In the order of the folders' names.
const std::vector<const ProfileKind*>& profile_kinds();

/// @return nullptr where there is none.
const ProfileKind* find_profile_kind(const std::string& name);

}  // namespace sprung
