#include "drivers/profiles/drive_profile.h"

#include <stdexcept>

#include "drivers/canopen/objects.h"
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

DriveTiming guarded(DriveTiming timing, NodeWatch watch) noexcept {
  timing.guarded = watch == NodeWatch::kGuarding;
  return timing;
}

}  // namespace

DriveTiming timing_of(double cycle_s, const WatchdogConfig& watchdogs) noexcept {
  /// [design choice] than samples after which the bridge stops the robot by itself: 5 with the shipped
  /// watchdogs, as others have it (2 to 6).
  constexpr int kMoreLostSetpoints = 3;
  return {cycle_s, watchdogs.heartbeat_s, watchdogs.heartbeat_consumer_s,
          watchdogs.silent_cycles + kMoreLostSetpoints, false};
}

std::vector<canopen::MapEntry> DriveProfile::display_entries() const {
  std::vector<canopen::MapEntry> entries = {{{canopen::kModeDisplay, 0}, 8}};
  if (carries_inputs_) entries.push_back(inputs());
  return entries;
}

bool DriveProfile::is_display(const CanFrame& frame) const noexcept {
  const int length = carries_inputs_ ? 1 + inputs().bits / 8 : 1;
  return frame.id == canopen::tpdo_id(kDisplayPdo, node_) && frame.length == length;
}

bool DriveProfile::decode_mode_display(const CanFrame& frame, std::int8_t& code) const noexcept {
  if (!is_display(frame)) return false;
  code = static_cast<std::int8_t>(frame.data[0]);
  return true;
}

bool DriveProfile::decode_inputs(const CanFrame& frame, std::uint32_t& levels) const noexcept {
  if (!carries_inputs_ || !is_display(frame)) return false;
  levels = static_cast<std::uint32_t>(canopen::get_le(&frame.data[1], inputs().bits / 8));
  return true;
}

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
  return kind->make_drive(actuator, guarded(timing, actuator.watch));
}

std::unique_ptr<CardProfile> make_card_profile(const EncoderCardConfig& card, const DriveTiming& timing) {
  const ProfileKind* kind = find_profile_kind(card.profile);
  if (kind == nullptr || kind->make_card == nullptr)
    refuse("encoder card '" + card.name + "'", card.profile, false);
  return kind->make_card(card, guarded(timing, card.watch));
}

}  // namespace sprung
