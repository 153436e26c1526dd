#include "drivers/profiles/drive_profile.h"

#include <stdexcept>

#include "drivers/profiles/profile_registry.h"

namespace sprung {
namespace {

[[noreturn]] void refuse(const std::string& what, const std::string& profile, bool drives) {
  std::string known;
  for (const ProfileKind* kind : profile_kinds()) {
    const bool fits = drives ? kind->make_drive != nullptr : kind->make_card != nullptr;
    if (fits) known += (known.empty() ? "" : ", ") + std::string(kind->name);
  }
  throw std::invalid_argument(what + ": no " + (drives ? "drive" : "encoder card") + " profile '" + profile +
                              "'; there are: " + known);
}

}  // namespace

const ProfileKind* find_profile_kind(const std::string& name) {
  for (const ProfileKind* kind : profile_kinds()) {
    if (kind->name == name) return kind;
  }
  return nullptr;
}

std::unique_ptr<DriveProfile> make_profile(const ActuatorConfig& actuator, const DriveTiming& timing) {
  const ProfileKind* kind = find_profile_kind(actuator.profile);
  if (kind == nullptr || kind->make_drive == nullptr)
    refuse("actuator '" + actuator.name + "'", actuator.profile, true);
  return kind->make_drive(actuator, timing);
}

std::unique_ptr<CardProfile> make_card_profile(const EncoderCardConfig& card, const DriveTiming& timing) {
  const ProfileKind* kind = find_profile_kind(card.profile);
  if (kind == nullptr || kind->make_card == nullptr)
    refuse("encoder card '" + card.name + "'", card.profile, false);
  return kind->make_card(card, timing);
}

}  // namespace sprung
