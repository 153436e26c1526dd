#include "drivers/bridge/homing.h"

#include <algorithm>
#include <cmath>

#include "signals/angles.h"

namespace sprung {
namespace {

constexpr double kStill_rad_s = 0.05;  // [design choice] moves 0.05 mrad in a millisecond
/// Index counters of all drives are read within tenths of a second.
constexpr std::int64_t kHomingTimeout_us = 1'000'000;
constexpr const char* kNoAnswer = "a drive does not answer";

ReferenceSource source_of(ReferenceMethod method) noexcept {
  switch (method) {
    case ReferenceMethod::kLink:
      return ReferenceSource::kLink;
    case ReferenceMethod::kIndex:
      return ReferenceSource::kIndex;
    case ReferenceMethod::kJig:
      return ReferenceSource::kJig;
    case ReferenceMethod::kNone:
      break;
  }
  return ReferenceSource::kConfigured;
}

/// @return nullptr when the drive can be homed now.
const char* why_not(const DriveNode& drive, ReferenceSource source) noexcept {
  const ReferenceMethod method = drive.actuator().reference.method;
  if (source == ReferenceSource::kLink && drive.actuator().link_encoder.card < 0)
    return "an actuator has no link encoder in robot.yaml";
  if (source == ReferenceSource::kIndex && (!drive.has_index() || method != ReferenceMethod::kIndex))
    return "an actuator has no index in robot.yaml, or its drive does not keep the count at the index";
  if (source == ReferenceSource::kJig && method != ReferenceMethod::kJig && method != ReferenceMethod::kIndex)
    return "an actuator has no jig position in robot.yaml";
  if (!drive.link().boot().operational() || drive.link().silent()) return kNoAnswer;
  if (drive.powered()) return "a drive has power: sprung sit or estop first";
  if (std::abs(drive.filtered_velocity_rad_s()) > kStill_rad_s) return "a joint moves";
  return nullptr;
}

/// What a drive lacks in this cycle to be homed in it. One answer may be lost, so it is waited for. nullptr =
/// nothing.
const char* missing(const DriveNode& drive, ReferenceSource source) noexcept {
  if (!drive.link().samples().answered()) return kNoAnswer;
  if (source == ReferenceSource::kLink && !std::isfinite(drive.measured_link_position_rad()))
    return "no sample from an encoder card";
  const bool waits = source == ReferenceSource::kIndex && drive.index_answer() == IndexAnswer::kWaiting;
  return waits ? "a drive does not tell its count at the index" : nullptr;
}

}  // namespace

Homing::Homing(std::vector<DriveNode*> drives)
    : drives_(std::move(drives)), sources_(drives_.size(), ReferenceSource::kConfigured) {}

const char* Homing::begin(const OperatorCommand& command, std::int64_t time_us) noexcept {
  if (running_) return "homing is already under way";
  const char* refusal = choose(command);
  if (refusal != nullptr) return refusal;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (sources_[i] == ReferenceSource::kIndex) drives_[i]->ask_index();
  }
  begun_us_ = time_us;
  running_ = true;
  return nullptr;
}

const char* Homing::choose(const OperatorCommand& command) noexcept {
  const auto count = static_cast<int>(drives_.size());
  if (command.actuator >= count || command.actuator < -1) return "no such actuator";
  bool any = false;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    const bool wanted = command.actuator == -1 || command.actuator == static_cast<int>(i);
    const bool as_configured = command.reference_source == ReferenceSource::kConfigured;
    const ReferenceSource source = as_configured ? source_of(drives_[i]->actuator().reference.method)
                                                 : command.reference_source;
    sources_[i] = wanted ? source : ReferenceSource::kConfigured;
    if (sources_[i] == ReferenceSource::kConfigured) continue;
    any = true;
    const char* refusal = why_not(*drives_[i], source);
    if (refusal != nullptr) return refusal;
  }
  return any ? nullptr : "robot.yaml names no way to find this reference";
}

Homing::Result Homing::step(std::int64_t time_us, const char* refusal) noexcept {
  if (!running_) return Result::kNothing;
  reason_ = refusal;
  const char* lacks = nullptr;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    if (sources_[i] == ReferenceSource::kConfigured) continue;
    if (reason_ == nullptr) reason_ = why_not(*drives_[i], sources_[i]);
    if (lacks == nullptr) lacks = missing(*drives_[i], sources_[i]);
    if (sources_[i] == ReferenceSource::kIndex && drives_[i]->index_answer() == IndexAnswer::kFailed)
      reason_ = "a drive has seen no index pulse: turn the joint by hand, a motor turn or more";
  }
  if (reason_ == nullptr && time_us - begun_us_ > kHomingTimeout_us) reason_ = lacks;
  if (reason_ == nullptr && lacks != nullptr) return Result::kNothing;
  running_ = false;
  if (reason_ != nullptr) return Result::kFailed;
  for (std::size_t i = 0; i < drives_.size(); ++i) {
    double offset_rad = 0.0;
    if (find_offset(i, offset_rad)) drives_[i]->set_reference({offset_rad, true, sources_[i]});
  }
  return Result::kDone;
}

/// @return false when this drive is not homed now.
bool Homing::find_offset(std::size_t i, double& offset_rad) const noexcept {
  const DriveNode& drive = *drives_[i];
  const ReferenceConfig& reference = drive.actuator().reference;
  switch (sources_[i]) {
    case ReferenceSource::kLink:
      offset_rad = drive.measured_link_position_rad() - drive.encoder_position_rad();
      return true;
    case ReferenceSource::kJig:
      offset_rad = reference.jig_position_rad - drive.encoder_position_rad();
      return true;
    case ReferenceSource::kIndex: {
      // An index comes once a motor turn: the right one puts the actuator nearest to where it is believed to
      // be.
      const double turn_rad = kTurn_rad / drive.actuator().gear_ratio;
      const double first_rad = reference.index_position_rad - drive.index_position_rad();
      const double wanted_rad = guess_rad(drive) - drive.encoder_position_rad();
      offset_rad = first_rad + turn_rad * std::round((wanted_rad - first_rad) / turn_rad);
      return true;
    }
    case ReferenceSource::kConfigured:
      break;
  }
  return false;
}

double Homing::guess_rad(const DriveNode& drive) const noexcept {
  if (std::isfinite(drive.measured_link_position_rad())) return drive.measured_link_position_rad();
  return drive.actuator().reference.jig_position_rad;
}

}  // namespace sprung
